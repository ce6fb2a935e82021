// Reference stage of vehicles.
#include <span>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/joint/joint_axis.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/physics/vehicle/vehicle.h"

namespace scree::reference {

void drive_vehicles(State& state, const Threads& threads, std::uint32_t) {
    const physics::Parameters& p = state.fixed();
    if (state.counted().overflow) return;
    const auto there = [&](physics::uint body) { return !physics::is_absent(state.properties[body].motion); };
    const auto rouse = [&](physics::uint body) {
        state.sleep_states[body] = physics::roused(state.sleep_states[body], p.sleep_steps);
    };
    threads.for_each(p.vehicles, [&](std::size_t i) {
        physics::Vehicle& vehicle = state.vehicles[i];
        physics::VehicleDynamics& dynamics = vehicle.dynamics;
        const physics::uint chassis = dynamics.chassis;
        if (!there(chassis) || !state.is_stepped(chassis)) return;
        if (!p.redo)
            dynamics = physics::driven(dynamics, {state.way_points.data()}, state.poses[chassis], state.velocities[chassis], p);
        const bool awake = physics::is_under_way(dynamics);
        if (awake) rouse(chassis);
        const vec3 axle = physics::vehicle_axes(dynamics, state.poses[chassis].orientation).x;
        for (const physics::VehicleWheel& wheel : std::span(vehicle.wheel).first(dynamics.wheels)) {
            if (!there(wheel.body)) continue;
            if (awake) rouse(wheel.body);
            if (p.redo) continue;
            physics::Joint& joint = state.joints[wheel.joint];
            const float spin = physics::dot3(axle, state.velocities[wheel.body].angular - state.velocities[chassis].angular);
            joint.axes[3] = physics::wheel_motor(joint.axes[3], dynamics, wheel, spin);
            if ((joint.axes[3].mode & physics::AXIS_MOTOR) == 0) {
                joint.rotors[3] = physics::rotor_without_motor(joint.rotors[3], joint.rows[3]);
                joint.rows[3].motor_impulse = 0;
                joint.active_set = physics::with_active_set(joint.active_set, 3, 0);
            }
            if (wheel.steers) joint.axes[4].rest = physics::wheel_angle(dynamics, wheel);
        }
    });
}

}  // namespace scree::reference
