// The records of a step, in memory alike for the CPU and for std430: what a body is, and what a contact is.
#ifndef SCREE_PHYSICS_RECORDS_H
#define SCREE_PHYSICS_RECORDS_H

#include "shaders/physics/language.h"

LAWS_BEGIN

CONSTANT uint SHAPE_SPHERE = 0u;   // size: radius, -, -                     m
CONSTANT uint SHAPE_CAPSULE = 1u;  // size: radius, half height, - (along y) m
CONSTANT uint SHAPE_BOX = 2u;      // size: half extents                     m
CONSTANT uint SHAPE_PLANE = 3u;    // size: unit normal; the pose's position is a point of it

CONSTANT uint MOTION_DYNAMIC = 0u;
CONSTANT uint MOTION_FIXED = 1u;
CONSTANT uint MOTION_KINEMATIC = 2u;

CONSTANT uint NONE = 0xFFFFFFFFu;

// ---- bodies, written when the scene is described ------------------------------------------------------------------------------
struct Traits {
    vec3 size;  // see SHAPE_*, m
    uint shape;
    vec3 inverse_inertia;  // principal, body frame, 1/(kg m^2); 0 if not dynamic
    float inverse_mass;    // 1/kg; 0 if not dynamic
    float friction;        // Coulomb coefficient; a pair takes the geometric mean
    float restitution;     // 0 to 1; a pair takes the larger
    float rolling_resistance;  // m, lever arm of the normal force that resists rolling; a pair takes the larger
    float gravity_scale;
    float linear_damping;   // 1/s
    float angular_damping;  // 1/s
    uint motion;
    uint large;  // 1: kept out of the grid, in the short list of large bodies
};

// ---- bodies, state ------------------------------------------------------------------------------------------------------------
struct Pose {
    vec3 position;  // of the centre of mass, m
    float pad;
    vec4 orientation;  // unit quaternion, body to world
};
struct Velocity {
    vec3 linear;  // of the centre of mass, m/s
    float pad0;
    vec3 angular;  // world axes, rad/s
    float pad1;
};

// What a body's velocity does not remember: the inertia of its present orientation, and what pushes it in this step.
struct Mass {
    float xx, xy, xz, yy;  // world inverse inertia tensor, symmetric, 1/(kg m^2)
    float yz, zz;
    float inverse_mass;  // 1/kg
    float split;         // s = max(1, contacts / 1.5): the body's mass is shared by that many blocks
};
struct Load {
    vec3 acceleration;  // gravity and forces, m/s^2, over the whole step
    float pad0;
    vec3 angular_acceleration;  // rad/s^2
    float pad1;
    vec3 kick;  // velocity change at the start of the step (impulses), m/s
    float pad2;
    vec3 angular_kick;  // rad/s
    float pad3;
};

// What the user asks of one body for one step; at most one record a body (the host adds up).
CONSTANT uint ACTION_SETS_VELOCITY = 1u;
struct Action {
    uint body;
    uint flags;  // ACTION_*
    float pad0, pad1;
    vec3 force;  // N, at the centre of mass
    float pad2;
    vec3 torque;  // N m
    float pad3;
    vec3 impulse;  // N s
    float pad4;
    vec3 angular_impulse;  // N m s
    float pad5;
    vec3 velocity;  // m/s, with ACTION_SETS_VELOCITY
    float pad6;
    vec3 angular_velocity;  // rad/s
    float pad7;
};

// ---- what touches -------------------------------------------------------------------------------------------------------------
// Up to four points in which two bodies touch or are about to.
struct Manifold {
    vec3 normal;     // unit, world, from A to B
    uint features;   // four 8-bit feature ids, point k in bits 8k to 8k + 7
    vec4 points[4];  // xyz: from A's centre to the point midway between the surfaces, world axes, m; w: separation, m, < 0 inside
};
struct Touch {
    Manifold manifold;
    uint count;  // points, 0 to 4; unused points are zero
    uint pad0, pad1, pad2;
};

LAWS_END

#endif
