// Driving a vehicle by keys, and the chase camera.
#include <algorithm>
#include <cmath>

#include "demos/play/interaction.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float standing = 0.5f;    // m/s: below this the key of the opposite direction drives instead of braking
constexpr float chase_ways = 2.2f;  // distance of the eye in vehicle lengths

bool is_of(const Scene& scene, const Vehicle& vehicle, std::size_t body) {
    return vehicle.chassis == body || std::any_of(vehicle.wheels.begin(), vehicle.wheels.end(),
                                                  [&](const Wheel& wheel) { return scene.joints[wheel.joint].b == body; });
}

}  // namespace

std::optional<std::size_t> Interaction::vehicle() const {
    const Scene& scene = session_.subject().scene;
    if (scene.vehicles.empty()) return std::nullopt;
    for (std::size_t i = 0; selected_ && i < scene.vehicles.size(); ++i)
        if (is_of(scene, scene.vehicles[i], *selected_)) return i;
    return 0;
}

bool Interaction::is_driving_key(host::Key pressed) const {
    using enum host::Key;
    const std::array<host::Key, 9> keys{
        up, down, left, right, space, host::key_of('W'), host::key_of('S'), host::key_of('A'), host::key_of('D')};
    return vehicle() && std::find(keys.begin(), keys.end(), pressed) != keys.end();
}

void Interaction::drive() {
    if (!told_) return;
    using enum host::Key;
    const auto held = [&](host::Key one, char other) {
        return held_keys_.count(one) + held_keys_.count(host::key_of(other)) != 0;
    };
    const std::size_t driven = *vehicle();
    const bool forward = held(up, 'W'), back = held(down, 'S');
    Controls controls;
    if (forward != back) {
        const float speed = session_.world().vehicle(driven).speed;
        const bool brakes = forward ? speed < -standing : speed > standing;
        if (brakes)
            controls.brake = 1;
        else
            controls.throttle = forward ? 1.0f : -1.0f;
    }
    controls.steer = (held(left, 'A') ? 1.0f : 0.0f) - (held(right, 'D') ? 1.0f : 0.0f);
    controls.hand_brake = held_keys_.count(space) != 0 ? 1.0f : 0.0f;
    if (controls == *told_ && driven == told_vehicle_ && !session_.world().vehicle(driven).by_route) return;
    perform(Drive{driven, controls});
    told_ = controls;
    told_vehicle_ = driven;
}

void Interaction::reset_upright() {
    const std::optional<std::size_t> which = vehicle();
    if (which) perform(Righten{*which});
}

void Interaction::chase(double seconds) {
    const Scene& scene = session_.world().scene();
    const std::optional<std::size_t> which = vehicle();
    if (!which) return;
    const Vehicle& vehicle = scene.vehicles[*which];
    const BodyState chassis = session_.world().body(vehicle.chassis);
    const Joint& first = scene.joints[vehicle.wheels[0].joint];
    const vec3 ahead = physics::rotate(chassis.orientation, physics::rotate(first.frame_a, vec3(0, 0, 1)));
    float length = 1;
    for (const Wheel& wheel : vehicle.wheels) length = std::max(length, 3 * glm::length(scene.joints[wheel.joint].anchor_a));
    eye_.chase(chassis.position + vec3(0, 0.15f * length, 0), ahead, chase_ways * length, seconds);
}

}  // namespace scree::demos
