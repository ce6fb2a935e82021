// A machine: a motor drives a gear train and a crank with a piston.
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/joint_checks.h"

namespace scree::demos {

namespace {

constexpr float thickness = 0.2f;  // m, half thickness of the gears
constexpr float motor_speed = 2;   // rad/s, speed of the motor
constexpr float stroke = 0.6f;     // m, radius of the crank

// Adds a hub on a hinge about z to the world, with teeth on fixed joints. Returns the hub's index.
std::size_t add_gear(Scene& scene, vec3 centre, float pitch_radius, int teeth, float phase, const Hinge& hinge) {
    const float hub = pitch_radius - 0.32f, tip = pitch_radius + 0.3f;
    Body body;
    body.shape = Cylinder{hub, thickness};
    body.position = centre;
    body.orientation = turned({1, 0, 0}, 90 * degrees);
    scene.bodies.push_back(body);
    const std::size_t middle = scene.bodies.size() - 1;
    scene.joints.push_back(joint_at(scene, hinge, the_world, middle, centre, {0, 0, 1}));
    for (int i = 0; i < teeth; ++i) {
        const float angle = phase + 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(teeth);
        const vec3 out(portable::cos(angle), portable::sin(angle), 0);
        scene.bodies.push_back(
            box_at(centre + out * (0.5f * (hub + tip)), {0.5f * (tip - hub), 0.14f, thickness}, turned({0, 0, 1}, angle)));
        scene.bodies.back().friction = 0.1f;
        scene.joints.push_back(joint_at(scene, Fixed{}, middle, scene.bodies.size() - 1, centre + out * hub));
    }
    return middle;
}

// Total rotation of a body about z, rad.
double turn_of(const Trace& trace, std::size_t slot) {
    double turn = 0;
    for (std::size_t i = 1; i < trace.moments.size(); ++i) {
        const vec4 p = trace.moments[i - 1].bodies.at(slot).orientation, q = trace.moments[i].bodies.at(slot).orientation;
        // The rotation q p* between two moments, about the world's z axis.
        const double z = static_cast<double>(q.z * p.w - q.w * p.z - q.x * p.y + q.y * p.x);
        const double w = static_cast<double>(q.w * p.w + q.x * p.x + q.y * p.y + q.z * p.z);
        turn += 2 * portable::atan2(w < 0 ? -z : z, std::abs(w));
    }
    return turn;
}

}  // namespace

DemoScene machine(const DemoOptions&) {
    Scene scene;
    const float small = 0.9f, large = 1.2f;  // pitch radii, in the ratio of their teeth, 6 and 8
    const vec3 first(0, 2, 0), second(small + large, 2, 0);
    Hinge driven, idle;
    driven.turn.motor = Motor{motor_speed, 1e6f};
    idle.turn.friction = 50;
    const std::size_t motor = add_gear(scene, first, small, 6, 0, driven);
    const std::size_t wheel = add_gear(scene, second, large, 8, std::numbers::pi_v<float> / 8, idle);

    // The crank pin is in front of the wheel, so that the rod clears the teeth.
    const vec3 pin = second + vec3(stroke, 0, 2.5f * thickness);
    const float length = 2;
    scene.bodies.push_back(box_at(pin + vec3(length / 2, 0, 0), {length / 2, 0.08f, 0.08f}));
    const std::size_t rod = scene.bodies.size() - 1;
    scene.joints.push_back(joint_at(scene, Hinge{}, wheel, rod, pin, {0, 0, 1}));
    scene.bodies.push_back(box_at(pin + vec3(length + 0.3f, 0, 0), {0.3f, 0.25f, 0.25f}));
    const std::size_t piston = scene.bodies.size() - 1;
    scene.joints.push_back(joint_at(scene, Hinge{}, rod, piston, pin + vec3(length, 0, 0), {0, 0, 1}));
    scene.joints.push_back(joint_at(scene, Slider{}, the_world, piston, scene.bodies[piston].position, {1, 0, 0}));

    const float seconds = 30;
    const Claim motor_turns = close_to(
        "speed of the motor", motor_speed, 0.01 * motor_speed, "rad/s", "mean over the run",
        [=](const Trace& trace) { return turn_of(trace, motor) / (trace.moments.back().time - trace.moments.front().time); });
    const Claim ratio = close_to("turns of the wheel for one of the motor", -0.75, 0.0075, "", "6 teeth drive 8",
                                 [=](const Trace& trace) { return turn_of(trace, wheel) / turn_of(trace, motor); });
    const Claim way =
        close_to("stroke of the piston", 2 * stroke, 0.02 * stroke, "m", "twice the crank's radius", [=](const Trace& trace) {
            double low = 1e30, high = -1e30;
            for (const Trace::Moment& moment : trace.moments) {
                low = std::min(low, static_cast<double>(moment.bodies.at(piston).position.x));
                high = std::max(high, static_cast<double>(moment.bodies.at(piston).position.x));
            }
            return high - low;
        });
    const Indices all = every_body(scene);
    const vec3 low(-1.5f, 0.4f, -0.6f), high(6, 3.6f, 1);
    return awake({std::move(scene), view_of(low, high, 15, 12), low, high, seconds,
                  Promise(motor_turns, ratio, way, gaps_below("in any joint", 0.0006), none_torn()).watching(all, every_step)});
}

}  // namespace scree::demos
