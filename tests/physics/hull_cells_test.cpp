// Direction cells of hulls: lookups find the same supports and faces as exhaustive search. The ball about a hull.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "compute/scene.h"
#include "compute/scene/meshes/hull.h"
#include "compute/tables/state.h"
#include "shaders/physics/collide/separating_axis.h"
#include "tests/physics/chance.h"

using namespace scree;
using tests::between;

namespace {

using Chance = std::mt19937;

vec3 any_direction(Chance& chance) {
    vec3 v(0);
    while (glm::length(v) < 0.1f || glm::length(v) > 1)
        v = {between(chance, -1, 1), between(chance, -1, 1), between(chance, -1, 1)};
    return glm::normalize(v);
}

struct LoadedScene {
    State state;
    physics::ConvexShape solid;
};
LoadedScene subject_of(const Hull& hull) {
    Scene scene;
    scene.bodies.resize(1);
    scene.bodies[0].shape = hull;
    State state(checked(scene), {}, 128, true);
    const physics::ConvexShape solid = physics::convex_shape_of(state.properties[0], vec4(0, 0, 0, 1), state.hull_table());
    return {std::move(state), solid};
}

// A hull with vertices on an ellipsoid.
LoadedScene hull_of(int corners, vec3 half, Chance& chance) {
    Hull hull;
    for (int k = 0; k < corners; ++k) hull.points.push_back(half * any_direction(chance));
    return subject_of(hull);
}
// A bevelled disc: two broad faces, and many narrow ones around the rim.
Hull bevelled_disc() {
    Hull disc;
    for (int k = 0; k < 12; ++k) {
        for (int j = -2; j <= 2; ++j) {
            const float radius = 1 - 0.02f * static_cast<float>(j * j), angle = static_cast<float>(k) * 0.5235988f;
            disc.points.emplace_back(radius * std::cos(angle), 0.1f * static_cast<float>(j), radius * std::sin(angle));
        }
    }
    return disc;
}

// Test directions: random, along an edge or through a vertex of the cells' cube, or one with two equal supports.
vec3 telling_direction(const LoadedScene& hull, int k, Chance& chance) {
    if (k % 3 == 0) return any_direction(chance);
    if (k % 3 == 1) {
        const float steps[] = {-1, -0.5f, 0, 0.5f, 1};
        vec3 v(0);
        while (v == vec3(0)) v = {steps[chance() % 5], steps[chance() % 5], steps[chance() % 5]};
        return v;
    }
    const auto corner = [&] {
        return physics::hull_vertex(hull.state.hull_table(), hull.solid.hull,
                                    static_cast<physics::uint>(chance() % hull.solid.head.vertices));
    };
    const vec3 way = corner() - corner();
    const vec3 across = glm::cross(way, any_direction(chance));
    return glm::length(across) > 1e-3f ? across : any_direction(chance);
}

vec3 farthest_of_all(const LoadedScene& hull, vec3 direction) {
    vec3 farthest(0);
    float reach = -1e30f;
    for (physics::uint k = 0; k < hull.solid.head.vertices; ++k) {
        const vec3 vertex = physics::hull_vertex(hull.state.hull_table(), hull.solid.hull, k);
        if (physics::dot3(vertex, direction) > reach) {
            reach = physics::dot3(vertex, direction);
            farthest = vertex;
        }
    }
    return farthest;
}

// Hulls of each number of corners, round and long, flat and broad.
template <class Check>
void for_each_hull(std::initializer_list<int> corners, Chance& chance, const Check& check) {
    for (const int count : corners) {
        for (const vec3 form : {vec3(0.5f), vec3(2, 0.2f, 0.5f), vec3(0.1f, 1, 0.1f), vec3(3, 2, 0.4f)}) {
            CAPTURE(count, form.x, form.y, form.z);
            check(hull_of(count, form, chance));
        }
    }
}

}  // namespace

TEST_CASE("by its cells a hull finds the very corner that looking at all of them finds") {
    Chance chance(3);
    for_each_hull({6, 8, 9, 14, 19, 20, 32, 64}, chance, [&](const LoadedScene& hull) {
        REQUIRE((hull.solid.head.across > 0) == (hull.solid.head.vertices >= 9));
        for (int k = 0; k < 3000; ++k) {
            const vec3 direction = telling_direction(hull, k, chance);
            const vec3 found = physics::farthest_vertex(hull.solid, direction, hull.state.hull_table());
            if (found != farthest_of_all(hull, direction))
                FAIL("direction " << direction.x << ", " << direction.y << ", " << direction.z);
        }
    });
}

TEST_CASE("a hull's cell lists what reaches farthest in directions near it, and the faces that look that way") {
    Chance chance(4);
    std::size_t listed = 0, asked = 0;
    for_each_hull({9, 16, 32, 64}, chance, [&](const LoadedScene& hull) {
        const physics::Hulls table = hull.state.hull_table();
        for (int k = 0; k < 1000; ++k) {
            const vec3 direction = glm::normalize(telling_direction(hull, k, chance));
            const physics::Corners corners = physics::corners_towards(hull.solid, direction, table);
            std::set<physics::uint> numbers;
            for (physics::uint i = 0; i < corners.count; ++i) numbers.insert(physics::corner_in(corners, i));
            listed += numbers.size();
            ++asked;
            const vec3 aside = glm::cross(direction, any_direction(chance));
            if (glm::length(aside) < 0.1f) continue;
            const vec3 near = direction + 0.0305f * glm::normalize(aside);  // 1.75 degrees
            const vec3 farthest = farthest_of_all(hull, near);
            const bool has = std::any_of(numbers.begin(), numbers.end(), [&](physics::uint i) {
                return physics::hull_vertex(table, hull.solid.hull, i) == farthest;
            });
            if (!has) FAIL("direction " << near.x << ", " << near.y << ", " << near.z);

            const physics::Faces faces = physics::faces_towards(hull.solid, direction, table);
            std::set<physics::uint> shown;
            for (physics::uint i = 0; i < faces.count; ++i) shown.insert(physics::face_at(faces, i));
            for (physics::uint i = 0; i < hull.solid.head.faces; ++i) {
                const vec4 plane = physics::hull_plane(table, hull.solid.hull, hull.solid.head, i);
                if (!shown.contains(i) && glm::dot(vec3(plane), direction) > faces.beyond)
                    FAIL("face " << i << " looks more that way than the cell says");
            }
        }
    });
    CHECK(static_cast<double>(listed) / static_cast<double>(asked) < 9);  // else cells would not save work
}

TEST_CASE("the best of two hulls' faces is the best of all of them, however deep they overlap") {
    Chance chance(5);
    Hull long_one, both;
    for (int k = 0; k < 40; ++k) both.points.push_back(vec3(1, 0.2f, 1) * any_direction(chance));
    for (int k = 0; k < 32; ++k) long_one.points.push_back(vec3(0.1f, 1, 0.1f) * any_direction(chance));
    const Hull hulls[] = {bevelled_disc(), both, long_one};
    for (const Hull& first : hulls) {
        for (const Hull& second : hulls) {
            Scene scene;
            scene.bodies.resize(2);
            scene.bodies[0].shape = first;
            scene.bodies[1].shape = second;
            const State state(checked(scene), {}, 128, true);
            const physics::Hulls table = state.hull_table();
            for (int k = 0; k < 1500; ++k) {
                const auto any_turn = [&] {
                    const vec3 axis = any_direction(chance);
                    return glm::normalize(vec4(axis, 0.1f + between(chance, -1, 1)));
                };
                const physics::ConvexShape solids[] = {physics::convex_shape_of(state.properties[0], any_turn(), table),
                                                       physics::convex_shape_of(state.properties[1], any_turn(), table)};
                const float apart = between(chance, 0, 1.5f);
                const vec3 d = apart * any_direction(chance);
                double best = -1e30;
                for (int side = 0; side < 2; ++side) {
                    const physics::ConvexShape &own = solids[side], &other = solids[1 - side];
                    for (physics::uint i = 0; i < own.head.faces; ++i) {
                        const vec4 plane = physics::plane_of(own, i, table);
                        double least = 1e30;
                        for (physics::uint v = 0; v < other.head.vertices; ++v) {
                            const vec3 corner =
                                (side == 0 ? d : -d) + physics::in_world(other.axes, physics::hull_vertex(table, other.hull, v));
                            least = std::min(least, static_cast<double>(glm::dot(vec3(plane), corner) - plane.w));
                        }
                        best = std::max(best, least);
                    }
                }
                const physics::Separation s = physics::separation_by_faces(solids[0], solids[1], d, 1e30f, table);
                if (std::abs(s.distance - best) > 5e-6) FAIL("pose " << k << ": " << s.distance << " of " << best);
            }
        }
    }
}

TEST_CASE("the ball about a hull holds its vertices, and is little larger than they ask for") {
    Chance chance(5);
    for_each_hull({6, 8, 9, 14, 19, 20, 32, 64}, chance, [](const LoadedScene& hull) {
        float farthest = 0;
        for (physics::uint k = 0; k < hull.solid.head.vertices; ++k)
            farthest = std::max(farthest, glm::length(physics::hull_vertex(hull.state.hull_table(), hull.solid.hull, k)));
        const float radius = physics::bounding_radius(hull.state.properties[0]);
        CHECK(radius >= farthest);
        CHECK(radius <= farthest + glm::length(hull.state.properties[0].size) / 15);
    });
}
