// Fracture: a wall, panes of glass, and bodies that fall into a pit.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/common_checks.h"
#include "demos/suite/joint_checks.h"

namespace scree::demos {

namespace {

Fracture breaking(float impulse, Cutting cutting, std::size_t pieces, std::uint32_t seed, std::size_t depth = 1) {
    Fracture fracture;
    fracture.impulse = impulse;
    fracture.cutting = cutting;
    fracture.pieces = pieces;
    fracture.seed = seed;
    fracture.depth = depth;
    return fracture;
}

double mass_of(const Scene& scene, const std::vector<BodyState>& states) {
    double sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (states[i].exists && scene.bodies[i].motion == Motion::dynamic)
            sum += static_cast<double>(mass_properties(scene.bodies[i].shape, scene.bodies[i].density).mass);
    return sum;
}
Claim mass_stays() {
    return close_to("mass at the end, of the start's", 1, 1e-5, "", "of the dynamic bodies that are there",
                    [](const Trace& trace) { return mass_of(trace.scene, trace.end) / mass_of(trace.scene, trace.start); });
}
// Counts bodies of the scene only, not fragments.
Claim broken_at_least(double part, Indices bodies) {
    return at_least("bodies that broke, of those that may", part, "", "at the end", [bodies](const Trace& trace) {
        const auto count = std::count_if(bodies.begin(), bodies.end(), [&](std::size_t i) { return !trace.end.at(i).exists; });
        return static_cast<double>(count) / static_cast<double>(bodies.size());
    });
}
Claim whole_and_in_place(double part, Indices bodies) {
    return at_least("bricks that stayed whole and in their place", part, "", "within 0.3 m of their start at the end",
                    [bodies](const Trace& trace) {
                        const auto count = std::count_if(bodies.begin(), bodies.end(), [&](std::size_t i) {
                            return trace.end.at(i).exists &&
                                   glm::length(trace.end[i].position - trace.start.at(i).position) < 0.3f;
                        });
                        return static_cast<double>(count) / static_cast<double>(bodies.size());
                    });
}

}  // namespace

namespace {

// Adds a tower crane to the right of the wall, whose jib ends above `hook`. Returns the jib's index.
std::size_t add_crane(Scene& scene, vec3 hook, float mast, float width) {
    const float top = hook.y + 0.25f, peak = top + 2.6f, tail = mast + 2.6f;
    const vec4 upright = turned({0, 1, 0}, 45 * degrees);
    scene.bodies.push_back(fixed_box({mast, 0.15f, hook.z}, {1.1f, 0.15f, 1.1f}));
    scene.bodies.push_back(fixed_box({mast, 0.5f * peak, hook.z}, {width, 0.5f * peak, width}, 0.6f, upright));
    scene.bodies.push_back(fixed_box({0.5f * (hook.x - 0.4f + tail), top, hook.z}, {0.5f * (tail - hook.x + 0.4f), 0.2f, 0.2f}));
    const std::size_t jib = scene.bodies.size() - 1;
    scene.bodies.push_back(fixed_box({tail - 0.6f, top - 0.75f, hook.z}, {0.5f, 0.6f, 0.6f}));
    for (const float end : {hook.x + 0.6f, tail - 0.3f}) {  // tie bars of the jib
        const vec3 from(mast, peak - 0.1f, hook.z), to(end, top + 0.1f, hook.z), along = to - from;
        scene.bodies.push_back(fixed_box(0.5f * (from + to), {0.5f * glm::length(along), 0.05f, 0.05f}, 0.6f,
                                         turned({0, 0, 1}, portable::atan2(along.y, along.x))));
    }
    return jib;
}

// Adds a steel ball on a steel chain, deflected from below the hook towards -z. Returns the ball's index.
std::size_t add_wrecker(Scene& scene, std::size_t jib, vec3 hook, float angle) {
    constexpr int links = 11;
    constexpr float length = 0.5f, radius = 0.7f;
    const vec3 down(0, -portable::cos(angle), -portable::sin(angle));
    Body link;
    link.shape = Capsule{0.09f, 0.5f * length - 0.09f};
    link.orientation = turned({1, 0, 0}, angle);
    link.density = 7800;
    std::size_t before = jib;
    vec3 end = hook;
    for (int i = 0; i < links; ++i) {
        link.position = end + down * (0.5f * length);
        scene.bodies.push_back(link);
        scene.joints.push_back(joint_at(scene, Ball{20}, before, scene.bodies.size() - 1, end));
        before = scene.bodies.size() - 1;
        end += down * length;
    }
    Body ball;
    ball.name = "ball";
    ball.shape = Sphere{radius};
    ball.density = 7800;
    ball.position = end + down * radius;
    ball.rolling_resistance = 0.1f;
    scene.bodies.push_back(ball);
    scene.joints.push_back(joint_at(scene, Ball{20}, before, scene.bodies.size() - 1, end));
    return scene.bodies.size() - 1;
}

}  // namespace

// A wall in running bond, and a ball on a chain that weighs as much as fifty bricks. The chain hangs before the wall
// and bends over its top once the ball is through.
DemoScene wrecking(const DemoOptions& options) {
    constexpr int rows = 12, columns = 16;
    const vec3 brick(0.4f, 0.2f, 0.2f), hook(-0.7f, 8.3f, -1.8f);
    Scene scene;
    scene.bodies.push_back(ground(0.8f));
    Random random(options.seed);
    Indices bricks;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float x = 2 * brick.x * (static_cast<float>(column) - 0.5f * columns + (row % 2 == 1 ? 0.75f : 0.25f));
            Body body = box_at({x, brick.y * static_cast<float>(2 * row + 1), random.between(-0.002f, 0.002f)},
                               brick - vec3(0.0005f, 0, 0));
            body.density = 1800;
            const std::uint32_t cut = 1 + random.bits() % 4;
            const Cutting cutting = random.unit() < 0.5f ? Cutting::boxes : Cutting::voronoi;
            // Higher thresholds lower down, where bricks carry the wall.
            body.fracture = breaking(800 + 140 * static_cast<float>(rows - row), cutting, 7, cut);
            bricks.push_back(scene.bodies.size());
            scene.bodies.push_back(body);
        }
    }
    const std::size_t jib = add_crane(scene, hook, 8, 0.3f);
    const std::size_t wrecker = add_wrecker(scene, jib, hook, 80 * degrees);
    const Indices all = every_body(scene);
    const vec3 low(-6.8f, 0, -5), high(10.6f, 10, 5);
    const char* blows = "moved by decimetres, blows open it by 0.2 to 0.5 mm";
    return {std::move(scene),
            view_of(low, high, 212, 12),
            low,
            high,
            10,
            Promise(broken_at_least(0.13, bricks), mass_stays(), whole_and_in_place(0.4, bricks),
                    at_least("how far the ball came", 2.5, "m", "beyond the wall's middle, at its farthest",
                             [wrecker](const Trace& trace) {
                                 double farthest = no_number;
                                 for (const Trace::Moment& moment : trace.moments) {
                                     const double z = moment.bodies.at(wrecker).position.z;
                                     if (!(z <= farthest)) farthest = z;
                                 }
                                 return farthest;
                             }),
                    because(gaps_below("of the chain", 0.0006), blows), none_torn())
                .watching(all)};
}

// Panes standing in grooves. The impulse at each pane is limited by its threshold, so the ball hardly slows down.
DemoScene glass(const DemoOptions& options) {
    constexpr int panes = 7;
    const vec3 half(1, 1, 0.02f);
    constexpr float gap = 1.6f, rail = 0.05f, foot = 0.06f;
    Scene scene;
    scene.bodies.push_back(ground());
    Indices thin;
    std::size_t thick = 0;
    for (int k = 0; k < panes; ++k) {
        const float z = gap * static_cast<float>(k);
        const bool last = k == panes - 1;
        const float depth = last ? 0.1f : half.z;
        for (const float side : {-1.0f, 1.0f})
            scene.bodies.push_back(fixed_box({0, foot, z + side * (depth + rail + 0.001f)}, {half.x + 0.1f, foot, rail}));
        Body pane = box_at({0, half.y, z}, {half.x, half.y, depth});
        pane.name = last ? "armoured pane" : "pane";
        pane.density = 2500;
        pane.friction = 0.4f;
        pane.fracture = breaking(last ? 30000.0f : 260.0f, Cutting::splinters, 24,
                                 static_cast<std::uint32_t>(options.seed) + static_cast<std::uint32_t>(k));
        (last ? thick : thin.emplace_back()) = scene.bodies.size();
        scene.bodies.push_back(pane);
    }
    Body ball;
    ball.name = "ball";
    constexpr float radius = 0.4f;
    ball.shape = Sphere{radius};
    ball.density = 7800;
    ball.position = {0.1f, 0.9f, -2};
    ball.velocity = {0, 2.5f, 12};
    const std::size_t shot = scene.bodies.size();
    scene.bodies.push_back(ball);
    const vec3 low(-1.6f, 0, -1), high(1.6f, 2.1f, gap * (panes - 1) + 0.5f);
    Promise promise(broken_at_least(1, thin),
                    at_most("armoured panes that broke", 0, "", "at the end",
                            [thick](const Trace& trace) { return trace.end.at(thick).exists ? 0.0 : 1.0; }),
                    between("how far the ball got", gap * (panes - 2), gap * (panes - 1), "m",
                            "its front, at any time: behind the sixth pane",
                            [](const Trace& trace) {
                                double farthest = no_number;
                                for (const Trace::Moment& moment : trace.moments)
                                    farthest =
                                        std::fmax(farthest, static_cast<double>(moment.bodies.front().position.z + radius));
                                return farthest;
                            }),
                    mass_stays());
    return {std::move(scene), view_of(low, high, 65, 14), low, high, 6, std::move(promise).watching({shot})};
}

// Five fragments each: 2,000 bodies have 10,000.
DemoScene shatter(const DemoOptions& options) {
    const auto count = static_cast<float>(options.bodies);
    const float spacing = 1.25f, side = std::max(2.0f, std::ceil(portable::cbrt(count)));
    const float pit = 0.5f * spacing * side + 0.7f;
    Scene scene;
    scene.bodies.push_back(ground());
    add_pit(scene, vec3(pit, 0, pit), 0.5f, 0.6f);
    for (std::size_t k = 1; k < scene.bodies.size(); ++k) {
        auto& wall = std::get<Box>(scene.bodies[k].shape);
        wall.half_extents.y = 0.5f * (0.12f * side + 1.2f);
        scene.bodies[k].position.y = wall.half_extents.y;
    }
    Random random(options.seed);
    Indices all;
    for (std::size_t i = 0; i < options.bodies; ++i) {
        const auto cell = static_cast<float>(i);
        const float layer = std::floor(cell / (side * side)), in_layer = cell - layer * side * side;
        const float row = std::floor(in_layer / side), column = in_layer - row * side;
        Body body;
        const std::uint32_t kind = random.bits() % 8, seed = 1 + random.bits() % 3;
        Cutting cutting = Cutting::voronoi;
        if (kind < 3) {
            body.shape = Box{{0.3f, 0.25f, 0.35f}};
            if (kind > 0) cutting = Cutting::boxes;
        } else if (kind < 5) {
            body.shape = Box{{0.4f, 0.1f, 0.3f}};
            cutting = kind == 3 ? Cutting::boxes : Cutting::splinters;
        } else if (kind < 7) {
            body.shape = Sphere{0.32f};
        } else {
            body.shape = Cylinder{0.25f, 0.35f};
        }
        body.density = 800;
        vec3 stray = random.vector(-0.05f, 0.05f);
        stray.y = 4 + stray.y;
        body.position = vec3(column - 0.5f * (side - 1), layer, row - 0.5f * (side - 1)) * spacing + stray;
        body.orientation = random.orientation();
        body.fracture = breaking(250, cutting, 5, seed);
        all.push_back(scene.bodies.size());
        scene.bodies.push_back(body);
    }
    const vec3 low(-pit, 0, -pit), high(pit, 4 + spacing * side, pit);
    // From all that falls to the pit where it bursts.
    Viewpoint view = view_of(low, high, 30, 20);
    const Viewpoint near = view_of(low - vec3(0, 0.3f * pit, 0), vec3(pit, 0.3f * pit, pit), 30, 24);
    view.path = {{0.5f, view.eye, view.target, view.vertical_fov}, {2.5f, near.eye, near.target, near.vertical_fov}};
    return {std::move(scene),
            std::move(view),
            low,
            high,
            7,
            Promise(broken_at_least(0.5, all), mass_stays(), because(end_speed_below(3), any_number),
                    because(at_most("mean penetration", 0.005, "m", "over the points that penetrate, at the end",
                                    [](const Trace& trace) { return trace.statistics.penetration_mean; }),
                            any_number))};
}

}  // namespace scree::demos
