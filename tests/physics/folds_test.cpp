// Contacts over the folds of a mesh: every shape, pressed in along a known way by less than its half thickness, has one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compute/tables/state.h"
#include "shaders/physics/collide/collide_triangle.h"
#include "tests/physics/chance.h"

using namespace scree;
using tests::any_turn;
using tests::between;

namespace {

using Chance = std::mt19937;

vec3 any_direction(Chance& chance) {
    std::normal_distribution<float> normal;
    return glm::normalize(vec3(normal(chance), normal(chance), normal(chance)));
}

const char* const kinds[] = {"sphere", "capsule", "box", "cylinder", "cone", "hull"};
Shape any_shape(std::size_t kind, Chance& chance) {
    const auto size = [&](float low, float high) { return between(chance, low, high); };
    if (kind == 0) return Sphere{size(0.2f, 0.6f)};
    if (kind == 1) return Capsule{size(0.1f, 0.4f), size(0.1f, 0.6f)};
    if (kind == 2) return Box{{size(0.1f, 0.6f), size(0.2f, 0.6f), size(0.2f, 0.6f)}};
    if (kind == 3) return Cylinder{size(0.2f, 0.6f), size(0.1f, 0.6f)};
    if (kind == 4) return Cone{size(0.3f, 0.6f), size(0.5f, 1.2f)};
    Hull hull;
    for (int k = 0; k < 12; ++k) hull.points.push_back(any_direction(chance) * size(0.25f, 0.5f));
    return hull;
}

// Ground under y, and the way in which a body is pressed into it from the place.
struct Ground {
    Shape shape;
    vec3 from, way;
};
Ground hills(Chance& chance) {
    HeightField field{.columns = 7, .rows = 7, .spacing = 1};
    for (int k = 0; k < 49; ++k) field.heights.push_back(between(chance, -0.15f, 0.15f));
    return {field, {between(chance, -0.6f, 0.6f), 2, between(chance, -0.6f, 0.6f)}, {0, -1, 0}};
}
// A valley or a ridge.
Ground fold(Chance& chance) {
    HeightField field{.columns = 7, .rows = 7, .spacing = 1};
    const float slope = between(chance, -0.8f, 0.8f);
    for (int k = 0; k < 49; ++k) field.heights.push_back(slope * std::abs(static_cast<float>(k % 7 - 3)));
    return {field, {between(chance, -0.6f, 0.6f), 3, between(chance, -0.6f, 0.6f)}, {0, -1, 0}};
}
// A step's front, pressed in from before it.
Ground step(Chance& chance) {
    Mesh mesh;
    const float width = between(chance, 0.2f, 0.8f);
    for (std::uint32_t i = 0; i < 9; ++i) {
        const float z = (static_cast<float>(i) - 4) * width;
        for (const vec3 corner : {vec3(0, -1.5f, z), vec3(0, 0, z), vec3(2, 0, z)}) mesh.vertices.push_back(corner);
        const std::uint32_t a = 3 * i, b = a + 3;
        if (i == 8) break;
        for (const glm::uvec3& t : {glm::uvec3(a, b, a + 1), glm::uvec3(a + 1, b, b + 1), glm::uvec3(a + 1, b + 1, a + 2),
                                    glm::uvec3(a + 2, b + 1, b + 2)})
            mesh.triangles.push_back(t);
    }
    return {mesh, {-2, between(chance, -0.5f, 0.1f), between(chance, -0.4f, 0.4f)}, {1, 0, 0}};
}

struct Pair {
    State state;
    float scale;  // m
    explicit Pair(const Scene& scene)
        : state(scene, {}, 128, true),
          scale(physics::convex_shape_of(state.properties[0], state.poses[0].orientation, state.hull_table()).scale) {}

    template <class Visit>
    void each_triangle(Visit visit) const {
        for (std::size_t i = 1; i < state.properties.size(); ++i)
            if (state.properties[i].shape == physics::SHAPE_TRIANGLE) visit(i);
    }
    // Least distance of the body at a place to any triangle, m; below 0 if they overlap.
    float distance_at(vec3 place) const {
        float least = 1e9f;
        const auto body = physics::convex_shape_of(state.properties[0], state.poses[0].orientation, state.hull_table());
        each_triangle([&](std::size_t i) {
            const auto own = physics::convex_shape_of(state.properties[i], state.poses[i].orientation, state.hull_table());
            least = std::min(
                least, physics::separation_of(own, body, place - state.poses[i].position, 0.3f, state.hull_table()).distance);
        });
        return least;
    }
    // Depth of the deepest contact point, m; below 0 if no point is in the ground.
    float deepest_at(vec3 place) const {
        float deepest = -1e9f;
        physics::Pose pose = state.poses[0];
        pose.position = place;
        const auto law = state.properties[0].shape == physics::SHAPE_SPHERE ? physics::collide_sphere_triangle
                                                                            : physics::collide_convex_triangle;
        each_triangle([&](std::size_t i) {
            const auto touch = law(state.properties[0], pose, state.properties[i], state.poses[i], 0.01f, state.hull_table());
            if (touch.count > 0) deepest = std::max(deepest, -physics::deepest_of(touch));
        });
        return deepest;
    }
};

struct Tally {
    int cases = 0, lost = 0;
    float too_deep = -1e9f;  // m, relative to min_half_width
};
// Bodies pressed in by up to `deepest` of their min_half_width.
Tally press(Ground (*ground)(Chance&), std::size_t kind, float deepest) {
    Chance chance(static_cast<unsigned>(kind) + 1);
    Tally tally;
    for (int k = 0; k < 300; ++k) {
        const Ground below = ground(chance);
        Scene scene;
        scene.bodies.resize(2);
        scene.bodies[0].shape = any_shape(kind, chance);
        scene.bodies[0].orientation = any_turn(chance);
        scene.bodies[1].shape = below.shape;
        scene.bodies[1].motion = Motion::fixed;
        const Pair pair(checked(scene));
        // The first touch along the way, by steps of the distance.
        float gone = 0, gap = 1;
        while (gone < 4 && gap > 1e-4f) {
            gap = pair.distance_at(below.from + below.way * gone);
            gone += std::clamp(0.9f * gap, 2e-4f, 0.3f);
        }
        if (gone >= 4) continue;
        const float pressed = pair.scale * between(chance, 0.02f, deepest);
        const float found = pair.deepest_at(below.from + below.way * (gone + pressed));
        ++tally.cases;
        tally.lost += found <= 0;
        tally.too_deep = std::max(tally.too_deep, (found - pressed) / pair.scale);
    }
    return tally;
}

}  // namespace

// At most one of a hundred sharp tips close to a seam, and none of a round body, has no contact before the tip is deeper.
TEST_CASE("shapes pressed into a fold or a step of a mesh keep their contact, and none is lifted onto the step", "[collide]") {
    const struct {
        const char* name;
        Ground (*ground)(Chance&);
        float deepest;
    } grounds[] = {{"hills", hills, 0.5f}, {"fold", fold, 0.5f}, {"step", step, 0.1f}};
    int cases = 0, lost = 0;
    for (const auto& [name, ground, deepest] : grounds)
        for (std::size_t kind = 0; kind < std::size(kinds); ++kind) {
            const Tally tally = press(ground, kind, deepest);
            INFO(kinds[kind] << " on " << name << ": " << tally.cases << " cases, " << tally.lost << " lost, too deep by "
                             << tally.too_deep << " of the half width");
            cases += tally.cases;
            lost += tally.lost;
            CHECK(tally.cases > 250);
            CHECK(tally.lost <= (kind < 2 ? 0 : kind == 4 ? 4 : 1));
            CHECK(tally.too_deep < 0.3f);  // as the search for the axis errs; a body on the step would be 1 deep
        }
    INFO(lost << " lost of " << cases);
    CHECK(lost <= cases / 500);
}
