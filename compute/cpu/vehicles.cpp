// Reference stage of vehicles.
#include <span>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/extra/vehicle.h"

namespace scree::reference {

void drive_vehicles(State& state, const Threads& threads, std::uint32_t) {
    const physics::Parameters& p = state.fixed();
    if (state.counted().overflow) return;
    const auto there = [&](physics::uint body) { return !physics::is_absent(state.traits[body].motion); };
    threads.for_each(p.vehicles, [&](std::size_t i) {
        physics::Vehicle& vehicle = state.vehicles[i];
        physics::Handling& handling = vehicle.handling;
        const physics::uint chassis = handling.chassis;
        if (!there(chassis)) return;
        if (!p.redo)
            handling = physics::driven(handling, {state.way_points.data()}, state.poses[chassis], state.velocities[chassis], p);
        const bool awake = physics::is_under_way(handling);
        if (awake) state.rests[chassis] = 0;
        const vec3 axle = physics::vehicle_axes(handling, state.poses[chassis].orientation).x;
        for (const physics::VehicleWheel& wheel : std::span(vehicle.wheel).first(handling.wheels)) {
            if (!there(wheel.body)) continue;
            if (awake) state.rests[wheel.body] = 0;
            if (p.redo) continue;
            physics::Joint& joint = state.joints[wheel.joint];
            const float spin = physics::dot3(axle, state.velocities[wheel.body].angular - state.velocities[chassis].angular);
            joint.axes[3] = physics::wheel_motor(joint.axes[3], handling, wheel, spin);
            if (joint.axes[3].mode == 0) {
                joint.rows[3].drive = 0;
                joint.pins = physics::with_pins(joint.pins, 3, 0);
            }
            if (wheel.steers) joint.axes[4].rest = physics::wheel_angle(handling, wheel);
        }
    });
}

}  // namespace scree::reference
