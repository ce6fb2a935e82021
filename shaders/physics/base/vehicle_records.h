// Records of vehicles and their routes.
#ifndef SCREE_PHYSICS_VEHICLE_RECORDS_H
#define SCREE_PHYSICS_VEHICLE_RECORDS_H

#include "shaders/physics/base/dialect.h"

LAWS_BEGIN

struct VehicleWheel {  // vehicle.h
    uint joint;        // record of its joint
    uint body;
    float radius;      // m
    float ahead;       // distance ahead of the turning axis, m; 0 for a wheel that is not steered
    float aside;       // offset to the left of the vehicle's centre line, m
    float torque;      // engine torque at full throttle, N m
    float power;       // engine power at full throttle, W
    float drag;        // engine drag without throttle, N m
    float brake;       // N m
    float hand_brake;  // N m
    float skid;        // skid steering: part of the steering added to its throttle, -1 to 1
    uint steers;       // 1: steered by its joint
};
// A point of a route.
struct WayPoint {
    vec3 position;  // m
    float speed;    // target speed, m/s
};
// A vehicle without its wheels: dynamics, controls and the route's state.
struct VehicleDynamics {
    uint chassis;
    uint wheels;
    uint route;           // first way point of its route in the table of way points
    uint points;          // way points of the route; 0: no route
    vec4 frame;           // vehicle axes (x left, y up, z ahead) to chassis frame
    float top_speed;      // m/s
    float reverse_speed;  // top speed backwards, m/s
    float tightest;       // curvature at full lock, 1/m
    float turning;        // greatest rate of change of curvature, 1/(m s)
    float lateral;        // greatest lateral acceleration, limits curvature at speed, m/s^2
    uint loops;           // 1: the route is closed
    float speed;          // state: forward speed, m/s
    float curvature;      // state: curvature steered at present, 1/m, > 0: left
    // User controls.
    float throttle, brake, steer, hand_brake;  // as in scree::Controls
    uint by_route;                             // 1: follow the route
    uint next;                                 // state: next way point; `points`: arrived
    uint passed;                               // state: way points passed so far
    uint pad0;
};
CONSTANT uint MOST_WHEELS = 8u;
struct Vehicle {
    VehicleDynamics dynamics;
    VehicleWheel wheel[8];  // MOST_WHEELS
};

LAWS_END

#endif
