// World: vehicles, their controls, state, and resetting them upright.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>
#include <string>

#include "compute/world/world_impl.h"
#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {
constexpr float lift_of_a_righted_vehicle = 0.5f;  // m; with less, the wheels would overlap what it lies on
}

void World::Impl::require_vehicle(std::size_t vehicle) const {
    if (vehicle < scene.vehicles.size()) return;
    throw std::out_of_range("vehicle " + std::to_string(vehicle) + " of " + std::to_string(scene.vehicles.size()));
}

void World::Impl::tell(std::size_t vehicle, const Controls& controls, bool by_route) {
    const TableRange range{Table::vehicles, vehicle, 1};
    runner->download({range});
    physics::VehicleDynamics& told = state.vehicles[vehicle].dynamics;
    told.throttle = controls.throttle;
    told.brake = controls.brake;
    told.steer = controls.steer;
    told.hand_brake = controls.hand_brake;
    told.by_route = by_route;
    runner->upload({range});
    action_on(scene.vehicles[vehicle].chassis, vec3(0), vec3(0));  // wakes the vehicle through its joints
}

void World::Impl::require_no_wheel(std::size_t joint) const {
    for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
        const Vehicle& vehicle = scene.vehicles[v];
        if (std::none_of(vehicle.wheels.begin(), vehicle.wheels.end(), [&](const Wheel& wheel) { return wheel.joint == joint; }))
            continue;
        throw std::invalid_argument("joint " + std::to_string(joint) + ": vehicle " + std::to_string(v) + " (\"" + vehicle.name +
                                    "\") has a wheel on it, which cannot be taken away");
    }
}

VehicleState World::Impl::vehicle_state(std::size_t index) const {
    const physics::VehicleDynamics& now = state.vehicles[index].dynamics;
    VehicleState found;
    found.controls = {now.throttle, now.brake, now.steer, now.hand_brake};
    found.speed = now.speed;
    found.curvature = now.curvature;
    found.by_route = now.by_route != 0;
    found.passed = now.passed;
    found.next = now.next;
    found.arrived = now.points != 0 && now.next >= now.points;
    return found;
}

void World::Impl::keep_vehicles(Scene& snapshot, const std::vector<std::size_t>& bodies,
                                const std::vector<std::size_t>& joints) const {
    bring(vehicle_ranges);
    std::vector<Vehicle> kept;
    for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
        Vehicle vehicle = scene.vehicles[i];
        const VehicleState now = vehicle_state(i);
        vehicle.controls = now.controls;
        vehicle.by_route = now.by_route;
        vehicle.next = now.next;
        vehicle.chassis = bodies[vehicle.chassis];
        for (Wheel& wheel : vehicle.wheels) wheel.joint = joints[wheel.joint];
        std::erase_if(vehicle.wheels, [](const Wheel& wheel) { return wheel.joint == no_body; });
        if (vehicle.chassis != no_body && !vehicle.wheels.empty()) kept.push_back(std::move(vehicle));
    }
    snapshot.vehicles = std::move(kept);
}

void World::drive(std::size_t vehicle, const Controls& controls) {
    whole().require_vehicle(vehicle);
    const auto within = [](float value, float low) { return value >= low && value <= 1; };
    if (!within(controls.throttle, -1) || !within(controls.steer, -1) || !within(controls.brake, 0) ||
        !within(controls.hand_brake, 0))
        throw std::invalid_argument("vehicle " + std::to_string(vehicle) +
                                    ": throttle and steer must be between -1 and 1, brake and hand_brake between 0 and 1");
    whole().tell(vehicle, controls, false);
}

void World::drive_by_route(std::size_t vehicle) {
    whole().require_vehicle(vehicle);
    if (whole().scene.vehicles[vehicle].route.empty())
        throw std::invalid_argument("vehicle " + std::to_string(vehicle) + " has no route");
    whole().tell(vehicle, {}, true);
}

VehicleState World::vehicle(std::size_t index) const {
    whole().require_vehicle(index);
    whole().bring(vehicle_ranges);
    return whole().vehicle_state(index);
}

std::vector<VehicleState> World::vehicles() const {
    whole().bring(vehicle_ranges);
    std::vector<VehicleState> all;
    for (std::size_t i = 0; i < whole().scene.vehicles.size(); ++i) all.push_back(whole().vehicle_state(i));
    return all;
}

// Wheels get their initial poses relative to the chassis.
void World::reset_upright(std::size_t vehicle) {
    Impl& in = whole();
    in.require_vehicle(vehicle);
    const Vehicle& v = in.scene.vehicles[vehicle];
    in.runner->download(row_ranges(in.state, in.state.row_of(v.chassis)));
    const vec4 frame = in.state.vehicles[vehicle].dynamics.frame;
    const physics::Pose before = in.state.poses[in.state.row_of(v.chassis)];
    const vec3 gravity = in.gravity_of(in.copy_of(v.chassis));
    const float pull = glm::length(gravity);
    const vec3 up = pull > 1e-6f ? -gravity / pull : vec3(0, 1, 0);
    const vec4 now = physics::compose(before.orientation, frame);
    vec3 left = physics::rotate(now, vec3(1, 0, 0)), ahead = physics::rotate(now, vec3(0, 0, 1));
    ahead -= up * glm::dot(ahead, up);
    // A vehicle on its nose or tail has no heading but that of its left side.
    if (glm::length(ahead) < 0.1f) ahead = glm::cross(left - up * glm::dot(left, up), up);
    ahead = glm::length(ahead) > 1e-3f ? glm::normalize(ahead) : physics::tangent(up);
    left = glm::normalize(glm::cross(up, ahead));
    const glm::quat turn = glm::normalize(glm::quat_cast(glm::mat3(left, up, ahead)));
    const vec4 upright =
        physics::unit_quaternion(physics::compose(vec4(turn.x, turn.y, turn.z, turn.w), physics::conjugate(frame)));
    const Body& first = in.scene.bodies[v.chassis];
    const vec3 place = before.position + up * lift_of_a_righted_vehicle;
    TableRanges changed;
    const auto put = [&](std::size_t body, vec3 position, vec4 orientation) {
        const std::uint32_t row = in.state.row_of(body);
        in.state.poses[row] = {position, 0, orientation};
        in.state.velocities[row] = {};
        in.state.sleep_states[row] = physics::RESTARTS;
        append(changed, {{Table::poses, row, 1}, {Table::velocities, row, 1}, {Table::sleep_states, row, 1}});
    };
    put(v.chassis, place, upright);
    for (const Wheel& wheel : v.wheels) {
        const std::size_t body = in.scene.joints[wheel.joint].b;
        const Body& b = in.scene.bodies[body];
        const vec3 offset = physics::rotate_back(first.orientation, b.position - first.position);
        const vec4 turned = physics::compose(physics::conjugate(first.orientation), b.orientation);
        put(body, place + physics::rotate(upright, offset), physics::unit_quaternion(physics::compose(upright, turned)));
    }
    in.runner->upload(changed);
    ++in.changes;
    in.action_on(v.chassis, vec3(0), vec3(0));
}

}  // namespace scree
