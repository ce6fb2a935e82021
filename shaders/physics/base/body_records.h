// Records of bodies: what is constant, their state, user actions, and springs that hold them.
#ifndef SCREE_PHYSICS_BODY_RECORDS_H
#define SCREE_PHYSICS_BODY_RECORDS_H

#include "shaders/physics/base/dialect.h"
#include "shaders/physics/base/shapes.h"

LAWS_BEGIN

CONSTANT uint MOTION_DYNAMIC = 0u;
CONSTANT uint MOTION_FIXED = 1u;
CONSTANT uint MOTION_KINEMATIC = 2u;
CONSTANT uint MOTION_PENDING = 3u;  // an inactive fragment of a body that is still whole
CONSTANT uint MOTION_BROKEN = 4u;   // replaced by its fragments
// Its motion was no longer finite (quarantine.h): stands where it last was, collides with nothing, joints let it go.
CONSTANT uint MOTION_QUARANTINED = 5u;
// Flag, combined with the motion of the owner: the row is a part, which the solver never moves (compound.h).
CONSTANT uint MOTION_OF_PART = 8u;

// BodyProperties.flags.
CONSTANT uint ROW_LARGE = 1u;   // not in the grid but in the list of large bodies
CONSTANT uint ROW_APART = 2u;   // collides with nothing: only drawn, or a sensor
CONSTANT uint ROW_SENSOR = 4u;  // one of the latter that is a sensor
// On devices of ranks that share a world (compute/distributed), of bodies that another rank moves and of their parts.
CONSTANT uint ROW_FOREIGN = 8u;
CONSTANT uint ROW_ELSEWHERE = 16u;  // one of the latter that is not near either, so no ghost: it is in no cell
// Of a hull: its farthest vertex is nearer than the corner of its box by this many 16ths of the latter's distance.
CONSTANT uint ROW_REACH_SHIFT = 5u;
CONSTANT uint ROW_REACH_MOST = 7u;
CONSTANT uint ROW_SURFACE_SHIFT = 8u;  // above: index into the table of surfaces plus 1; 0: none

CONSTANT uint NONE = 0xFFFFFFFFu;

// ---- bodies: constant, but for the motion of a body that breaks and of its fragments
struct BodyProperties {
    vec3 size;  // see SHAPE_*, m
    uint shape;
    vec3 inverse_inertia;      // principal, body frame, 1/(kg m^2); 0 if not dynamic, and of a part
    float inverse_mass;        // 1/kg; 0 if not dynamic, and of a part
    float friction;            // Coulomb coefficient; a pair takes the geometric mean
    float restitution;         // 0 to 1; a pair takes the larger
    float rolling_resistance;  // m, lever arm of the normal force that resists rolling; a pair takes the larger
    float gravity_scale;
    float linear_damping;   // 1/s
    float angular_damping;  // 1/s
    uint motion;
    uint flags;       // ROW_*
    uint owner;       // row of the body that this part belongs to; itself for a body
    uint fracture;    // index into the table of fractures; NONE: unbreakable
    uint joints;      // head of its list of joints; NONE: no joints
    uint shape_data;  // index of the shape's record (shape_data.h: hull_of, tyre_of)
};
// Pose of a part, or of a fragment, in its body.
struct PoseInBody {
    vec3 position;     // from the body's centre of mass, body axes, m
    uint seams;        // of a part: index of its seams in the table of shape data plus 1; 0: none (seam.h)
    vec4 orientation;  // unit quaternion, part to body
};
// Fracture of a body (fracture.h).
struct Fracturing {
    float threshold;   // of an impulse or momentum, N s
    uint of_momentum;  // 1: threshold of the body's momentum; 0: of a contact's impulse
    uint first_row;    // row of its first fragment; all are contiguous
    uint count;        // of its fragments
    uint first_pose;   // of its fragments, in the table of pieces; shared by equal bodies
    uint pad0, pad1, pad2;
};
// What a material says beyond friction, restitution and rolling resistance (material.h).
struct Surface {
    vec3 velocity;                // over its body, body axes, m/s
    float static_friction;        // Coulomb coefficient of what sticks
    float spinning_resistance;    // m; < 0: as rolling
    float restitution_threshold;  // m/s; < 0: Parameters.restitution_threshold
    uint friction_rule;           // COMBINE_*
    uint restitution_rule;
    float cohesion;        // work of adhesion, J/m^2; 0: none (cohesion.h)
    float cohesion_range;  // m; < 0: the pair's
    float curvature;       // if cohesive, 1 over the radius of its body, 1/m; 0: flat, or of a ball, whose size tells it
    float pad0;
};
// How a value of two surfaces follows; of two rules the greater counts.
CONSTANT uint COMBINE_USUAL = 0u;
CONSTANT uint COMBINE_GEOMETRIC = 1u;
CONSTANT uint COMBINE_AVERAGE = 2u;
CONSTANT uint COMBINE_MINIMUM = 3u;
CONSTANT uint COMBINE_MULTIPLY = 4u;
CONSTANT uint COMBINE_MAXIMUM = 5u;
CONSTANT uint COMBINE_OVERRIDING_MINIMUM = 6u;
CONSTANT uint COMBINE_OVERRIDING_AVERAGE = 7u;
// How a body meets air and water (medium.h).
struct Immersion {
    vec3 half_extents;  // of a box, or of an ellipsoid, of the body's volume, body axes, m
    float volume;       // m^3
    vec3 centre;        // of the volume, from the centre of mass, body axes, m
    float drag;         // coefficient
    uint is_round;      // 1: an ellipsoid
    uint pad0, pad1, pad2;
};
CONSTANT uint MOST_ATTRACTORS = 4u;
// Tyre friction (tyre.h).
struct Tyre {
    float best_slip;  // slip of greatest friction
    float sliding;    // friction at slip 1, relative to the greatest
    float pad0, pad1;
};

// ---- bodies, state
// Positions use compensated summation (Kahan 1965): a substep moves a body by so little that rounding, always to the
// same side, would change its speed by 1e-4, and with it the angular momentum. The low-order term is stored in the vec3
// padding.
struct Pose {
    vec3 position;     // of the centre of mass, m
    float low_x;       // m
    vec4 orientation;  // unit quaternion, body to world
};
struct Velocity {
    vec3 linear;   // of the centre of mass, m/s
    float low_y;   // of the position, m
    vec3 angular;  // world axes, rad/s
    float low_z;   // of the position, m
};

// Inverse mass and world inverse inertia at the present orientation.
struct BodyMass {
    float xx, xy, xz, yy;  // world inverse inertia tensor, symmetric, 1/(kg m^2)
    float yz, zz;
    float inverse_mass;  // 1/kg
    float shares;        // of the mass among its contacts, packed (mass_splitting.h)
};
// The mass of a split body: 1/s of the body's.
struct Mass {
    float xx, xy, xz, yy;  // of the whole body, as in BodyMass
    float yz, zz;
    float inverse_mass;  // of the whole body, 1/kg
    float split;         // split factor s, at least 1
};
struct BodyForces {
    vec3 acceleration;          // gravity and forces, m/s^2, constant over the step
    float kept;                 // part of its contacts' impulses that it keeps: < 1 if it breaks (fracture.h)
    vec3 angular_acceleration;  // rad/s^2
    float impact_weight;        // of its contacts in an impact with restitution in this substep, N s
};

// User action on a body in one step; at most one record per body (the host sums).
CONSTANT uint ACTION_SETS_VELOCITY = 1u;
CONSTANT uint ACTION_CHANGES_VELOCITY = 2u;  // of a kinematic body, evenly over the step (driven.h)
struct Action {
    vec3 force;  // N, at the centre of mass
    uint body;
    vec3 torque;   // N m
    uint flags;    // ACTION_*
    vec3 impulse;  // N s
    float pad0;
    vec3 angular_impulse;  // N m s
    float pad1;
    vec3 velocity;  // m/s, with ACTION_SETS_VELOCITY
    float pad2;
    vec3 angular_velocity;  // rad/s
    float pad3;
    vec3 velocity_before;  // m/s, with ACTION_CHANGES_VELOCITY
    float pad4;
    vec3 angular_velocity_before;  // rad/s
    float pad5;
};

// A damped spring from an anchor on a body to a target, while the user holds the body (grab_spring.h).
CONSTANT uint MOST_GRIPS = 4u;  // springs in use at most
struct Grip {
    vec3 anchor;  // body frame, from the centre of mass, m
    uint body;
    vec3 target;      // target of the anchor, world, m
    float bias_rate;  // soft constraint, 1/s (Catto 2011)
    float mass_scale;
    float most;       // greatest change of the centre's velocity per substep, m/s
    float spin_kept;  // part of the angular velocity that remains after a substep
    float pad0;
};

// A pending fragment or a broken body: it has a row, but neither collides nor is drawn.
LAW bool is_absent(uint motion) {
    return motion == MOTION_PENDING || motion == MOTION_BROKEN;
}

LAWS_END

#endif
