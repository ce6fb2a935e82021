// Triangle worlds: hills of a height field, and a staircase over a bowl from a mesh file.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random_bodies.h"
#include "demos/scenes/scene_builder.h"
#include "host/files/mesh_file.h"

extern const char* const scree_staircase;

namespace scree::demos {

namespace {

// Adds bodies of every shape in a lattice with its lowest centre at `lowest`.
void add_bodies(Scene& scene, std::size_t count, std::size_t side, vec3 lowest, float friction, float smallest, float largest,
                Random& random) {
    for (std::size_t i = 0; i < count; ++i) {
        Body body = random_assorted(random.between(smallest, largest), random);
        body.position = lowest + 2.05f * largest *
                                     vec3(static_cast<float>(i % side) - 0.5f * static_cast<float>(side - 1),
                                          static_cast<float>(i / (side * side)),
                                          static_cast<float>(i / side % side) - 0.5f * static_cast<float>(side - 1));
        body.density = 2600;
        body.friction = friction;
        scene.bodies.push_back(body);
    }
}

Claim none_falls_through(const std::string& what, double (*surface)(const Trace&, vec3)) {
    return at_least("lowest centre over " + what, 0, "m", "of any dynamic body at the end", [surface](const Trace& trace) {
        double least = 1e9;
        for (std::size_t i = 0; i < trace.end.size(); ++i) {
            if (trace.scene.bodies[i].motion != Motion::dynamic) continue;
            const vec3 at = trace.end[i].position;
            least = std::min(least, static_cast<double>(at.y) - surface(trace, at));
        }
        return least;
    });
}

// ---- hills
constexpr float valley_radius = 30;  // m
constexpr std::uint32_t side_points = 61;

// Height of the terrain, m: a bowl with hills, higher on one side.
float hill(float x, float z) {
    const float r = std::sqrt(x * x + z * z) / valley_radius;
    const float waves = portable::sin(0.45f * x + 0.6f) * portable::cos(0.38f * z) + 0.5f * portable::sin(0.9f * z + 0.7f * x);
    return 13 * r * r - 0.22f * x + 0.9f * waves * std::min(1.0f, 2 * r);
}

double height_at(const Trace& trace, vec3 at) {
    const auto& field = std::get<HeightField>(trace.scene.bodies[0].shape);
    const float u = at.x / field.spacing + 0.5f * static_cast<float>(field.columns - 1);
    const float v = at.z / field.spacing + 0.5f * static_cast<float>(field.rows - 1);
    const auto column = static_cast<std::uint32_t>(std::clamp(u, 0.0f, static_cast<float>(field.columns - 2)));
    const auto row = static_cast<std::uint32_t>(std::clamp(v, 0.0f, static_cast<float>(field.rows - 2)));
    const float s = u - static_cast<float>(column), t = v - static_cast<float>(row);
    const auto height = [&](std::uint32_t i, std::uint32_t k) { return field.heights[(row + k) * field.columns + column + i]; };
    // Each cell is two triangles, split along the diagonal (1, 0) to (0, 1).
    if (s + t <= 1) return height(0, 0) + s * (height(1, 0) - height(0, 0)) + t * (height(0, 1) - height(0, 0));
    return height(1, 1) + (1 - s) * (height(0, 1) - height(1, 1)) + (1 - t) * (height(1, 0) - height(1, 1));
}

// ---- the bowl under the staircase, of demos/scenes/staircase
double bowl_at(const Trace&, vec3 at) {
    const double r = std::min(4.0, portable::hypot(static_cast<double>(at.x), static_cast<double>(at.z)));
    return 1.6 * (r / 4) * (r / 4) - 0.05;  // tolerance for the triangulation of the paraboloid
}

Claim come_into_the_bowl(double part) {
    return at_least("bodies in the bowl, of all", part, "", "whose centre is less than 4 m from its axis at the end",
                    [](const Trace& trace) {
                        double inside = 0, all = 0;
                        for (std::size_t i = 0; i < trace.end.size(); ++i) {
                            if (trace.scene.bodies[i].motion != Motion::dynamic) continue;
                            all += 1;
                            inside += portable::hypot(trace.end[i].position.x, trace.end[i].position.z) < 4;
                        }
                        return all > 0 ? inside / all : 0;
                    });
}

}  // namespace

DemoScene terrain(const DemoOptions& options) {
    HeightField field{
        .columns = side_points, .rows = side_points, .spacing = 2 * valley_radius / static_cast<float>(side_points - 1)};
    for (std::uint32_t row = 0; row < side_points; ++row)
        for (std::uint32_t column = 0; column < side_points; ++column)
            field.heights.push_back(
                hill(field.spacing * (static_cast<float>(column) - 0.5f * static_cast<float>(side_points - 1)),
                     field.spacing * (static_cast<float>(row) - 0.5f * static_cast<float>(side_points - 1))));
    Scene scene;
    scene.bodies.push_back({.name = "hills", .motion = Motion::fixed, .shape = std::move(field), .friction = 0.4f});
    Random random(options.seed);
    const auto side =
        std::max<std::size_t>(4, static_cast<std::size_t>(portable::cbrt(2.0 * static_cast<double>(options.bodies))));
    constexpr float largest = 0.6f;
    // Place the lattice above the highest terrain below it.
    const float half = 1.025f * largest * static_cast<float>(side);
    vec3 place(-16, 0, 0);
    for (float x = -half; x <= half; x += 0.5f)
        for (float z = -half; z <= half; z += 0.5f) place.y = std::max(place.y, hill(place.x + x, z) + 2 * largest);
    add_bodies(scene, options.bodies, side, place, 0.4f, 0.3f, largest, random);
    const float far = valley_radius;
    const vec3 low(-22, -1, -14), high(16, 13, 14);
    return {std::move(scene),
            view_of(low, high, 40, 30),
            {-far, -3, -far},
            {far, 25, far},
            16,
            Promise(all_within({-far, -5, -far}, {far, 200, far}),
                    because(none_falls_through("the hills", height_at), "0 is the surface itself"),
                    because(penetration_below(0.1), any_number), energy_never_rises(0.001))
                .watching_energy()};
}

DemoScene mesh(const DemoOptions& options) {
    const host::MeshFile file = host::mesh_of(scree_staircase, "staircase.obj");
    Scene scene;
    scene.bodies.push_back(ground());
    scene.bodies[0].shape = Plane{{0, 1, 0}, -1};
    scene.bodies.push_back({.name = "staircase",
                            .motion = Motion::fixed,
                            .shape = Mesh{.vertices = file.vertices, .triangles = file.triangles},
                            .friction = 0.15f});
    Random random(options.seed);
    add_bodies(scene, options.bodies, 6, {-11.4f, 7.2f, 0}, 0.15f, 0.13f, 0.24f, random);
    const vec3 low(-13.2f, -1, -4), high(4, 7.5f, 4);
    return {std::move(scene),
            view_of(low, high, 35, 35),
            low,
            {4, 12, 4},
            14,
            Promise(all_within({-14, 0, -4.2f}, {4.2f, 60, 4.2f}),
                    because(none_falls_through("the bowl", bowl_at), "0 is the surface itself"), come_into_the_bowl(0.6),
                    because(penetration_below(0.05), any_number))};
}

}  // namespace scree::demos
