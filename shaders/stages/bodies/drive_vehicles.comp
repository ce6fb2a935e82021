// Drives each vehicle: route following, steering, and wheel motors. Once, also if the step is repeated.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/joint/joint_axis.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/physics/vehicle/vehicle.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

WayPoint way_point_at(Routes routes, uint place) {
    return READ_QUADS(way_points, place);
}

void rouse(uint body) {
    WORD(sleep_states, body) = roused(WORD(sleep_states, body), PARAMETERS.sleep_steps);
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.vehicles || COUNTED.overflow != 0u) return;
    VehicleDynamics v = vehicles.at[i].dynamics;
    BodyProperties chassis = READ(properties, v.chassis);
    if (is_absent(chassis.motion) || is_foreign(chassis)) return;
    if (PARAMETERS.redo == 0u) {
        v = driven(v, Routes(0u), READ(poses, v.chassis), READ(velocities, v.chassis), PARAMETERS);
        vehicles.at[i].dynamics = v;
    }
    bool awake = is_under_way(v);
    if (awake) rouse(v.chassis);
    vec3 axle = vehicle_axes(v, READ(poses, v.chassis).orientation).x;
    vec3 turning = READ(velocities, v.chassis).angular;
    for (uint k = 0u; k < v.wheels; ++k) {
        VehicleWheel wheel = vehicles.at[i].wheel[k];
        if (is_absent(READ(properties, wheel.body).motion)) continue;
        if (awake) rouse(wheel.body);
        if (PARAMETERS.redo != 0u) continue;
        float spin = dot3(axle, READ(velocities, wheel.body).angular - turning);
        JointAxis motor = wheel_motor(joints.at[wheel.joint].axes[3], v, wheel, spin);
        joints.at[wheel.joint].axes[3] = motor;
        if ((motor.mode & AXIS_MOTOR) == 0u) {
            joints.at[wheel.joint].rotors[3] =
                rotor_without_motor(joints.at[wheel.joint].rotors[3], joints.at[wheel.joint].rows[3]);
            joints.at[wheel.joint].rows[3].motor_impulse = 0.0f;
            joints.at[wheel.joint].active_set = with_active_set(joints.at[wheel.joint].active_set, 3u, 0u);
        }
        if (wheel.steers != 0u) joints.at[wheel.joint].axes[4].rest = wheel_angle(v, wheel);
    }
}
