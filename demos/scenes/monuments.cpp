// Large scenes in the manner of those with which others time their solvers on GPUs (Giles, Diaz, Yuksel, Augmented Vertex Block
// Descent, SIGGRAPH 2025, and its replicas): a round wall of bricks, a field of gables, a net of joined bodies.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/joint_checks.h"

namespace scree::demos {

namespace {

const vec3 brick(0.5f, 0.25f, 0.25f);  // m, half extents
constexpr float head_joint = 0.001f;   // m, between the bricks of a course

std::size_t at_least_one(float count) {
    return static_cast<std::size_t>(std::max(1.0f, std::round(count)));
}

}  // namespace

// A round wall in running bond, eleven times as many bricks around as courses high: 110,332 bodies make it 100 courses of 1,103.
DemoScene ring(const DemoOptions& options) {
    const std::size_t courses = at_least_one(std::sqrt(static_cast<float>(options.bodies) / 11));
    const std::size_t around = std::max<std::size_t>(8, options.bodies / courses);
    const float step = 360 * degrees / static_cast<float>(around);
    // The inner edges of neighbours are a head joint apart.
    const float radius = (brick.x + 0.5f * head_joint) / portable::tan(0.5f * step) + brick.z;
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    for (std::size_t course = 0; course < courses; ++course) {
        const float y = brick.y * static_cast<float>(2 * course + 1);
        for (std::size_t k = 0; k < around; ++k) {
            const float angle = step * (static_cast<float>(k) + (course % 2 == 1 ? 0.5f : 0.0f));
            const float out = radius + random.between(0, 0.002f);
            scene.bodies.push_back(
                box_at({out * portable::sin(angle), y, out * portable::cos(angle)}, brick, turned({0, 1, 0}, angle)));
        }
    }
    const float outer = radius + 2 * brick.z, height = 2 * brick.y * static_cast<float>(courses);
    const vec3 low(-outer, 0, -outer), high(outer, height, outer);
    return awake({std::move(scene), view_of(low, high, 25, 24), low, high, 20,
                  Promise(drift_below(0.003), end_speed_below(), sway_below(), penetration_below(0.00065))});
}

// Triangular walls of 496 bricks, 31 courses high, side by side: 505,920 bodies make 1,020 of them.
DemoScene gables(const DemoOptions& options) {
    constexpr int base = 31;
    constexpr std::size_t bricks = base * (base + 1) / 2;
    const std::size_t count = std::max<std::size_t>(1, options.bodies / bricks);
    const std::size_t rows = at_least_one(std::sqrt(static_cast<float>(count) * 4));  // a wall is eight times as wide as a gap
    const std::size_t columns = (count + rows - 1) / rows;
    constexpr float width = 2 * base * 0.5f + 2, gap = 4;
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    for (std::size_t gable = 0; gable < count; ++gable) {
        const vec3 middle(width * (static_cast<float>(gable % columns) - 0.5f * static_cast<float>(columns - 1)), 0,
                          gap * (static_cast<float>(gable / columns) - 0.5f * static_cast<float>(rows - 1)));
        for (int row = 0; row < base; ++row)
            for (int column = 0; column < base - row; ++column) {
                const float x =
                    (2 * brick.x + head_joint) * (static_cast<float>(column) - 0.5f * static_cast<float>(base - row - 1));
                const vec3 at(x, brick.y * static_cast<float>(2 * row + 1), random.between(-0.002f, 0.002f));
                scene.bodies.push_back(box_at(middle + at, brick));
            }
    }
    const vec3 high(0.5f * width * static_cast<float>(columns), 2 * brick.y * base, 0.5f * gap * static_cast<float>(rows));
    const vec3 low(-high.x, 0, -high.z);
    return awake({std::move(scene), view_of(low - vec3(0, 1.2f, 0), high, 30, 18), low, high, 20,
                  Promise(drift_below(0.04), end_speed_below(), sway_below(0.00018), penetration_below(0.0028))});
}

// A square net of balls, each on a ball joint to its neighbours, falls over a post with a round head. 34,000 bodies have 67,000
// joints.
DemoScene net(const DemoOptions& options) {
    const std::size_t side = std::max<std::size_t>(4, at_least_one(std::sqrt(static_cast<float>(options.bodies))));
    constexpr float pitch = 0.3f, radius = 0.1f;
    const float half = 0.5f * pitch * static_cast<float>(side - 1), head = 0.4f * half, height = 1.2f * half;
    Scene scene;
    scene.bodies.push_back(ground());
    Body post;
    post.shape = Capsule{head, 0.5f * height};
    post.position = {0, height - head - 0.5f * height, 0};
    post.motion = Motion::fixed;
    scene.bodies.push_back(post);
    const std::size_t first = scene.bodies.size();
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t k = 0; k < side; ++k)
            add_body(scene, Sphere{radius},
                     {pitch * static_cast<float>(k) - half, height + 2 * radius, pitch * static_cast<float>(i) - half});
    const auto join = [&](std::size_t a, std::size_t b) {
        const vec3 middle = 0.5f * (scene.bodies[a].position + scene.bodies[b].position);
        scene.joints.push_back(joint_at(scene, Ball{}, a, b, middle));
    };
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t k = 0; k < side; ++k) {
            const std::size_t here = first + i * side + k;
            if (k + 1 < side) join(here, here + 1);
            if (i + 1 < side) join(here, here + side);
        }
    const Indices all = every_body(scene);
    const vec3 low(-0.65f * half, 0, -0.65f * half), high(0.65f * half, height + 0.3f, 0.65f * half);
    return awake({std::move(scene), view_of(low, high, 25, 24), low, high, 6,
                  Promise(gaps_below("of the net", 0.025), none_torn()).watching(all)});
}

}  // namespace scree::demos
