// Joints: chains, a bridge, ragdolls and pendulums.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/joint_checks.h"

namespace scree::demos {

namespace {

constexpr float link = 0.5f;  // m, length of a chain link
constexpr int links = 20;

// Adds a chain that hangs from `top` at `angle` (rad) from the vertical, with a ball of `load` link masses at its
// end.
void add_chain(Scene& scene, vec3 top, float angle, float load) {
    const vec3 down(portable::sin(angle), -portable::cos(angle), 0);
    const vec4 turn = turned({0, 0, 1}, angle);
    std::size_t before = the_world;
    for (int i = 0; i < links; ++i) {
        Body body;
        body.shape = Capsule{0.06f, 0.5f * link - 0.06f};
        body.position = top + down * (link * (static_cast<float>(i) + 0.5f));
        body.orientation = turn;
        scene.bodies.push_back(body);
        const std::size_t now = scene.bodies.size() - 1;
        scene.joints.push_back(joint_at(scene, Ball{}, before, now, top + down * (link * static_cast<float>(i))));
        before = now;
    }
    if (load <= 0) return;
    Body ball;
    const float radius = 0.4f;
    ball.shape = Sphere{radius};
    ball.density = 1000;
    const float mass = mass_properties(scene.bodies[before].shape, 1000).mass;
    ball.density = 1000 * load * mass / mass_properties(ball.shape, 1000).mass;
    ball.position = top + down * (link * static_cast<float>(links) + radius);
    scene.bodies.push_back(ball);
    scene.joints.push_back(
        joint_at(scene, Ball{}, before, scene.bodies.size() - 1, top + down * (link * static_cast<float>(links))));
}

struct Part {
    vec3 at, half;  // m; pose of a standing figure with its feet at y = 0
    std::size_t to;
    vec3 anchor;
    JointKind kind;
};

// A ragdoll of eleven boxes and ten joints: cone-twist at shoulders, hips, neck and waist, hinges at elbows and
// knees.
std::vector<Part> figure() {
    const auto cone = [](float swing, float twist) { return ConeTwist{swing, {-twist, twist}, 2}; };
    const auto bends = [](float lower, float upper) {
        Hinge hinge;
        hinge.turn.limits = Limits{lower, upper};
        hinge.turn.friction = 2;
        return hinge;
    };
    std::vector<Part> parts = {{{0, 0.98f, 0}, {0.16f, 0.1f, 0.1f}, 0, {}, Ball{}},
                               {{0, 1.32f, 0}, {0.17f, 0.2f, 0.1f}, 0, {0, 1.1f, 0}, cone(0.5f, 0.4f)},
                               {{0, 1.68f, 0}, {0.09f, 0.12f, 0.1f}, 1, {0, 1.54f, 0}, cone(0.6f, 0.8f)}};
    for (const float side : {-1.0f, 1.0f}) {
        const std::size_t arm = parts.size();
        parts.push_back({{side * 0.34f, 1.42f, 0}, {0.14f, 0.05f, 0.05f}, 1, {side * 0.19f, 1.42f, 0}, cone(1.3f, 0.8f)});
        parts.push_back({{side * 0.63f, 1.42f, 0},
                         {0.13f, 0.045f, 0.045f},
                         arm,
                         {side * 0.49f, 1.42f, 0},
                         side < 0 ? bends(-2.3f, 0) : bends(0, 2.3f)});
        const std::size_t thigh = parts.size();
        parts.push_back({{side * 0.1f, 0.66f, 0}, {0.075f, 0.2f, 0.075f}, 0, {side * 0.1f, 0.87f, 0}, cone(1.0f, 0.4f)});
        parts.push_back({{side * 0.1f, 0.22f, 0}, {0.06f, 0.2f, 0.06f}, thigh, {side * 0.1f, 0.44f, 0}, bends(0, 2.3f)});
    }
    return parts;
}

void add_figure(Scene& scene, const std::vector<Part>& parts, vec3 position, vec4 turn) {
    const std::size_t first = scene.bodies.size();
    Scene alone;  // the figure at the origin, in whose frame the joints are defined
    for (const Part& part : parts) {
        Body body = box_at(part.at, part.half);
        body.density = 900;
        // Swings of cone-twist joints have no friction: without damping an arm over the edge of a step swings for minutes.
        body.linear_damping = body.angular_damping = 0.4f;
        alone.bodies.push_back(body);
    }
    for (std::size_t i = 1; i < parts.size(); ++i) {
        // Hinge axes: elbows about y, knees about x.
        const bool elbow = std::holds_alternative<Hinge>(parts[i].kind) && parts[i].at.y > 1;
        const bool cone = std::holds_alternative<ConeTwist>(parts[i].kind);
        const vec3 along = parts[i].at - parts[i].anchor;
        const vec3 axis = cone ? glm::normalize(along) : (elbow ? vec3(0, 1, 0) : vec3(1, 0, 0));
        Joint joint = joint_at(alone, parts[i].kind, parts[i].to, i, parts[i].anchor, axis);
        joint.a += first;
        joint.b += first;
        scene.joints.push_back(joint);
    }
    const glm::vec3 waist(0, 1, 0);
    for (Body& body : alone.bodies) {
        const vec3 arm = body.position - waist;
        const vec3 u(turn), t = 2.0f * glm::cross(u, arm);
        body.position = position + arm + turn.w * t + glm::cross(u, t);
        body.orientation = turn;
        scene.bodies.push_back(body);
    }
}

}  // namespace

DemoScene chain(const DemoOptions&) {
    Scene scene;
    add_chain(scene, {0, 11, -1.5f}, 60 * degrees, 0);
    add_chain(scene, {0, 11, 1.5f}, 60 * degrees, 100);
    const Indices all = every_body(scene);
    const vec3 low(-11, 0, -3), high(11, 11.5f, 3);
    return awake({std::move(scene), view_of(low, high, 35, 8), low, high, 20,
                  Promise(gaps_below("of two chains, one with a load of a hundred links", 0.0003 * link)).watching(all)});
}

DemoScene bridge(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    constexpr int planks = 24;
    const float width = 0.5f, half_span = 0.5f * width * planks, height = 4;
    scene.bodies.push_back(fixed_box({-half_span - 2, height / 2, 0}, {2, height / 2, 1.5f}));
    scene.bodies.push_back(fixed_box({half_span + 2, height / 2, 0}, {2, height / 2, 1.5f}));
    // The bridge is slightly longer than the gap, so it starts as a sagging arc.
    std::size_t before = 1;
    const auto edge = [&](int i) {
        const float x = -half_span + width * static_cast<float>(i);
        return vec3(x, height - 0.06f - 1.2f * (1 - (x / half_span) * (x / half_span)), 0);
    };
    for (int i = 0; i < planks; ++i) {
        const vec3 from = edge(i), to = edge(i + 1);
        const float length = glm::distance(from, to);
        scene.bodies.push_back(box_at((from + to) * 0.5f, {0.5f * length - 0.01f, 0.05f, 1.2f},
                                      turned({0, 0, 1}, portable::atan2(to.y - from.y, to.x - from.x))));
        scene.bodies.back().density = 600;
        const std::size_t now = scene.bodies.size() - 1;
        for (const float side : {-1.1f, 1.1f})
            scene.joints.push_back(joint_at(scene, Ball{}, before, now, from + vec3(0, 0, side), {0, 0, 1}));
        before = now;
    }
    for (const float side : {-1.1f, 1.1f})
        scene.joints.push_back(joint_at(scene, Ball{}, before, 2, edge(planks) + vec3(0, 0, side), {0, 0, 1}));
    Random random(options.seed);
    const std::size_t crates = scene.bodies.size();
    for (int i = 0; i < 12; ++i) {
        const float x = -4 + 0.7f * static_cast<float>(i);
        const vec4 turn = turned({0, 1, 0}, random.between(0, 90) * degrees);
        const float z = random.between(-0.6f, 0.6f);
        scene.bodies.push_back(box_at({x, 5 + 0.3f * static_cast<float>(i % 3), z}, vec3(0.25f), turn));
    }
    const Claim carried =
        at_most("crates that fell off", 0, "", "below the middle of the banks' height at the end", [crates](const Trace& trace) {
            double fallen = 0;
            for (std::size_t i = crates; i < trace.end.size(); ++i) fallen += trace.end[i].position.y < 2;
            return fallen;
        });
    const Indices all = every_body(scene);
    const vec3 low(-8, 1, -2), high(8, 6, 2);
    return {
        std::move(scene),
        view_of(low, high, 25, 14),
        low,
        high,
        15,
        Promise(because(gaps_below("between planks", 0.00032), "it differs by three times between seeds"), carried, none_torn())
            .watching(all)};
}

DemoScene ragdolls(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    const std::vector<Part> parts = figure();
    const auto count = std::max<std::size_t>(1, options.bodies / parts.size());
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count) / 4)));
    const float half = 0.5f * 2.0f * static_cast<float>(side) + 0.5f;
    // Steps for the ragdolls to fall on.
    for (int i = 0; i < 4; ++i) {
        const float part = static_cast<float>(i + 1) / 5;
        scene.bodies.push_back(
            fixed_box({0, 0.4f + 0.8f * static_cast<float>(i), 0}, {half * (1 - part), 0.4f, half * (1 - part)}));
    }
    Random random(options.seed);
    float top = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t layer = i / (side * side), row = i / side % side, column = i % side;
        const auto place = [&](std::size_t k) { return 2.0f * (static_cast<float>(k) - 0.5f * static_cast<float>(side - 1)); };
        const vec3 at(place(column), 6 + 2.4f * static_cast<float>(layer), place(row));
        const vec3 axis = glm::normalize(random.vector(-1, 1) + vec3(0.01f));
        add_figure(scene, parts, at, turned(axis, random.between(0, 180) * degrees));
        top = std::max(top, at.y + 1);
    }
    const Indices all = every_body(scene);
    const vec3 low(-half, 0, -half), high(half, std::min(top, 12.0f), half);
    const float far = 40 + half;
    return {std::move(scene),
            view_of(low, high, 30, 22),
            low,
            high,
            10,
            Promise(because(gaps_below("in any figure", 0.02), any_number), none_torn(),
                    all_within({-far, -0.5f, -far}, {far, top + 2, far}),
                    because(end_speed_below(2), "arms still swing: of 24 seeds 0.2 to 1.8 m/s"),
                    because(penetration_below(0.03), any_number))
                .watching(all, Span(4, 1))};
}

DemoScene pendulums(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    for (const float end : {-3.6f, 3.6f}) scene.bodies.push_back(fixed_box({0, 2.04f, end}, {0.08f, 2.04f, 0.08f}));
    scene.bodies.push_back(fixed_box({0, 4, 0}, {0.04f, 0.04f, 3.6f}));  // the beam that carries all pendulums
    const std::size_t beam = scene.bodies.size() - 1;
    std::vector<Swinging> all;
    const auto add = [&](Body body, float lever, float angle, float z, const JointKind& kind, bool rod) {
        const vec3 pivot(0, 4, z);
        const vec3 arm(portable::sin(angle), -portable::cos(angle), 0);
        body.position = pivot + arm * lever;
        body.orientation = turned({0, 0, 1}, angle);
        scene.bodies.push_back(body);
        const std::size_t index = scene.bodies.size() - 1;
        scene.joints.push_back(rod ? joint_between(scene, kind, beam, index, pivot, body.position)
                                   : joint_at(scene, kind, beam, index, pivot, {0, 0, 1}));
        const MassProperties m = mass_properties(body.shape, body.density);
        // A ball joint does not rotate the bob with the rod.
        const double own = rod ? 0.0 : static_cast<double>(m.inertia.z);
        const double l = lever;
        all.push_back({index, pivot, l, angle, own + static_cast<double>(m.mass) * l * l, m.mass});
    };
    Body ball, bar, plank;
    ball.shape = Sphere{0.15f};
    bar.shape = Capsule{0.05f, 0.7f};
    plank.shape = Box{{0.1f, 0.8f, 0.1f}};
    add(ball, 1, 20 * degrees, -3, Distance{1, 1, {}}, true);
    add(ball, 2, 45 * degrees, -2, Distance{2, 2, {}}, true);
    add(ball, 3, 90 * degrees, -1, Distance{0, 3, {}}, true);  // a rope: maximum distance only
    add(bar, 0.75f, 30 * degrees, 0, Ball{}, false);
    add(plank, 0.8f, 60 * degrees, 1, Hinge{}, false);
    add(plank, 1.5f, 120 * degrees, 2, Hinge{}, false);
    add(ball, 1.2f, 10 * degrees, 3, Hinge{}, false);
    const vec3 low(-3, 0, -3.6f), high(3, 5, 3.6f);
    const Indices watched = every_body(scene);
    return awake({std::move(scene), view_of(low, high, 40, 12), low, high, 60,
                  Promise(periods_as_theory(all, 0.0015), swings_keep_energy(all, 0.0035), gaps_below("", 3.5e-6))
                      .watching(watched, every_step)});
}

}  // namespace scree::demos
