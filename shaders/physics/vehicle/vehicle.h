// Vehicles in one step: route following, steering, and the motors and brakes of wheels.
//
// A vehicle has no equations of its own: it sets the motors of its wheels' joints (joint.h), and tyre friction does the
// rest (tyre.h).
#ifndef SCREE_PHYSICS_VEHICLE_H
#define SCREE_PHYSICS_VEHICLE_H

#include "shaders/physics/base/records.h"
#include "shaders/physics/joint/joint_axis.h"

LAWS_BEGIN

// Pure pursuit looks ahead by LOOK_TIME at the present speed, at least LEAST_LOOK: nearer, and the vehicle weaves;
// farther, and it cuts corners.
CONSTANT float LOOK_TIME = 0.5f;      // s
CONSTANT float LEAST_LOOK = 4.0f;     // m
CONSTANT float THROTTLE_GAIN = 0.5f;  // throttle per m/s below the wanted speed
CONSTANT float BRAKE_GAIN = 0.25f;    // brake per m/s above the wanted speed
CONSTANT float BRAKE_FROM = 0.5f;     // m/s above the wanted speed, where braking begins

LAW Axes vehicle_axes(VehicleDynamics v, vec4 orientation) {
    return axes_of(compose(orientation, v.frame));
}

// The greatest curvature that may be steered at the present speed, 1/m.
LAW float tightest_now(VehicleDynamics v) {
    return smaller(v.tightest, v.lateral * reciprocal(larger(v.speed * v.speed, 0.01f)));
}

// Access to the table of way points: in C++ a pointer; on a device the table is bound.
#ifdef __cplusplus
struct Routes {
    const WayPoint* points;
};
LAW WayPoint way_point_at(Routes routes, uint place) {
    return routes.points[place];
}
#else
struct Routes {
    uint bound;
};
WayPoint way_point_at(Routes routes, uint place);  // shaders/stages/bodies/drive_vehicles.comp
#endif

LAW vec4 way_point(Routes routes, VehicleDynamics v, uint k) {
    WayPoint point = way_point_at(routes, v.route + k);
    return vec4(point.position.x, point.position.y, point.position.z, point.speed);
}
LAW bool has_arrived(VehicleDynamics v) {
    return v.next >= v.points;
}
LAW uint behind_point(VehicleDynamics v, uint k) {
    return k + 1u < v.points ? k + 1u : (v.loops != 0u ? 0u : k);
}
// Parameter of a point's projection onto the leg between two way points, 0 to 1 and beyond.
LAW float part_of_leg(vec4 from, vec4 to, vec3 place) {
    vec3 leg = xyz(to) - xyz(from);
    return dot3(place - xyz(from), leg) * reciprocal(larger(dot3(leg, leg), 1.0e-6f));
}

LAW VehicleDynamics parked(VehicleDynamics v) {
    v.throttle = 0.0f;
    v.steer = 0.0f;
    v.brake = 0.5f;
    v.hand_brake = 1.0f;
    return v;
}

// Controls by the route: steers along the circle through a point ahead on the route (pure pursuit: Coulter,
// CMU-RI-TR-92-01, 1992), at the route's speed.
LAW VehicleDynamics by_route(VehicleDynamics v, Routes routes, Axes axes, vec3 place) {
    if (has_arrived(v)) return parked(v);
    vec4 from = way_point(routes, v, v.next == 0u ? v.points - 1u : v.next - 1u);
    vec4 to = way_point(routes, v, v.next);
    float along = part_of_leg(from, to, place);
    if (along >= 1.0f) {
        v.passed = v.passed + 1u;
        v.next = v.loops == 0u && v.next + 1u == v.points ? v.points : behind_point(v, v.next);
        if (has_arrived(v)) return parked(v);
        from = to;
        to = way_point(routes, v, v.next);
        along = part_of_leg(from, to, place);
    }
    along = clamped(along, 0.0f, 1.0f);
    vec3 leg = xyz(to) - xyz(from);
    float left = length3(leg) * (1.0f - along);
    float look = larger(LEAST_LOOK, LOOK_TIME * abs(v.speed));
    vec3 aim = xyz(from) + leg * along;
    if (look < left) {
        aim = aim + unit3(leg, axes.z) * look;
    } else {
        vec3 after = xyz(way_point(routes, v, behind_point(v, v.next))) - xyz(to);
        aim = xyz(to) + unit3(after, unit3(leg, axes.z)) * smaller(look - left, larger(length3(after), LEAST_LOOK));
    }
    vec3 away = aim - place;
    float ahead = dot3(axes.z, away), aside = dot3(axes.x, away);
    float curvature = 2.0f * aside * reciprocal(larger(ahead * ahead + aside * aside, 0.01f));
    if (ahead < 0.0f) curvature = aside < 0.0f ? -v.tightest : v.tightest;
    v.steer = clamped(curvature * reciprocal(tightest_now(v)), -1.0f, 1.0f);
    float wanted = (from.w + (to.w - from.w) * along) - v.speed;
    v.throttle = clamped(wanted * THROTTLE_GAIN, 0.0f, 1.0f);
    v.brake = clamped((-wanted - BRAKE_FROM) * BRAKE_GAIN, 0.0f, 1.0f);
    v.hand_brake = 0.0f;
    return v;
}

// Once per step: controls by the route, if any, and the curvature steered at present.
LAW VehicleDynamics driven(VehicleDynamics v, Routes routes, Pose pose, Velocity velocity, Parameters parameters) {
    Axes axes = vehicle_axes(v, pose.orientation);
    v.speed = dot3(axes.z, velocity.linear);
    if (v.by_route != 0u && v.points != 0u) v = by_route(v, routes, axes, pose.position);
    float wanted = v.steer * tightest_now(v), most = v.turning * parameters.dt;
    v.curvature = v.curvature + clamped(wanted - v.curvature, -most, most);
    return v;
}

// Ackermann steering: every axle points to the centre of the curve, tan(angle) = ahead / (radius - aside).
LAW float wheel_angle(VehicleDynamics v, VehicleWheel wheel) {
    float rise = wheel.ahead * v.curvature;
    float angle = angle_of(abs(rise), larger(1.0f - wheel.aside * v.curvature, 0.05f));
    return choose(rise < 0.0f, -angle, angle);
}

LAW float wheel_throttle(VehicleDynamics v, VehicleWheel wheel) {
    return clamped(v.throttle + wheel.skid * v.steer, -1.0f, 1.0f);
}
// The motor of a wheel's joint. `spin`: of the wheel relative to the chassis, rad/s.
LAW JointAxis wheel_motor(JointAxis axis, VehicleDynamics v, VehicleWheel wheel, float spin) {
    float braking = wheel.brake * v.brake + wheel.hand_brake * v.hand_brake;
    float throttle = wheel_throttle(v, wheel);
    axis.speed = 0.0f;
    axis.most = larger(wheel.drag, braking);
    bool is_track = wheel.skid != 0.0f && (v.throttle != 0.0f || v.steer != 0.0f);
    if (braking <= 0.0f && (throttle != 0.0f || is_track)) {
        float fastest = (throttle < 0.0f ? -v.reverse_speed : v.top_speed) * reciprocal(wheel.radius);
        float torque = smaller(wheel.torque, wheel.power * reciprocal(larger(abs(spin), 0.1f)));
        // The throttle scales a car's torque, but a tracked vehicle's speed, one side of which may have to stand.
        axis.speed = is_track ? fastest * abs(throttle) : fastest;
        axis.most = is_track ? torque : torque * abs(throttle);
    }
    axis.mode = (axis.mode & AXIS_ROTOR) | (axis.most > 0.0f ? AXIS_MOTOR : 0u);
    return axis;
}

// Whether its wheels still turn towards what is steered.
LAW bool is_turning_wheels(VehicleDynamics v) {
    return v.curvature != v.steer * tightest_now(v);
}
// Whether the vehicle keeps its bodies awake.
LAW bool is_under_way(VehicleDynamics v) {
    if (is_turning_wheels(v)) return true;
    if (v.by_route != 0u && v.points != 0u) return !has_arrived(v);
    return v.throttle != 0.0f || (v.steer != 0.0f && v.brake <= 0.0f && v.hand_brake <= 0.0f);
}

LAWS_END

#endif
