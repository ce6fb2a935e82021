// Records of joints, and of the blocks of joints that are solved together.
#ifndef SCREE_PHYSICS_JOINT_RECORDS_H
#define SCREE_PHYSICS_JOINT_RECORDS_H

#include "shaders/physics/base/body_records.h"

LAWS_BEGIN

// A joint has six axes: translation along x, y and z of its frame in A, the twist about x, and the swing about y and z.
// An axis's coordinate is the position of B relative to A along or about it. Where B turns about one axis alone, that is x.
CONSTANT uint AXIS_LOCKED = 1u;
CONSTANT uint AXIS_LIMITED = 2u;
CONSTANT uint AXIS_MOTOR = 4u;     // velocity motor; friction is a motor of speed 0
CONSTANT uint AXIS_SPRING = 8u;    // spring, damper or both
CONSTANT uint AXIS_ROTOR = 16u;    // armature: the inertia of a rotor
CONSTANT uint AXIS_CUT = 32u;      // of a joint with JOINT_CUT, where it is not free
CONSTANT uint AXIS_COUPLED = 64u;  // a coupling acts on it: its row is placed even if it is free
// Of a coupling's axis: the power of two that is its largest factor, 0 to 20.
CONSTANT uint AXIS_REACH = 0x1F00u;
struct JointAxis {
    uint mode;           // AXIS_*
    float lower, upper;  // limits of the coordinate, m or rad
    float stiffness;     // N/m or N m/rad
    float damping;       // N s/m or N m s/rad
    float rest;          // the spring's equilibrium coordinate, m or rad
    float speed;         // target of a motor, m/s or rad/s
    float most;          // force limit of a motor or spring, N or N m
};
// A joint's Jacobian row in this pass, and its accumulated impulses.
struct JointRow {
    vec3 direction;    // unit, world; a positive impulse acts along or about it on B
    float coordinate;  // m or rad
    vec3 angular_a;    // angular part for A: lever arm x direction, m, or the direction itself
    float drift;       // second derivative of the coordinate times half a substep, m/s or rad/s
    vec3 angular_b;
    float inverse_effective_mass;  // of the split bodies, 1/kg or 1/(kg m^2)
    float motor_impulse,
        limit_impulse;   // of a substep: of lock, motor or spring; of the limit (> 0: the lower), N s or N m s
    float motor_change;  // in this pass
    float limit_change;
};
// The rotor of a motor as it turns with an axis (armature): its inertia adds to that of the axis alone.
struct JointRotor {
    float inertia;  // kg m^2 (kg along an axis), as felt at the joint; 0: none
    float speed;    // of the axis, rad/s or m/s, by its own momentum
    float impulse;  // all that acts on the axis in a substep, the row's own included, N m s or N s
    float change;   // of it in this pass
};

CONSTANT uint JOINT_RADIAL = 1u;    // axis x points from A's anchor to B's; its coordinate is their distance
CONSTANT uint JOINT_CONE = 2u;      // swing axis y is the one B has swung about, with the whole swing as coordinate
CONSTANT uint JOINT_COLLIDES = 4u;  // the two bodies collide with each other
CONSTANT uint JOINT_SPINS = 8u;     // B spins about its x axis, so swing axes exclude its twist
CONSTANT uint JOINT_SWINGS = 16u;   // B may swing half a turn about any axis, where its twist is anything: no turns are counted
CONSTANT uint JOINT_CUT = 32u;      // of a graph cut into blocks that share several bodies (compute/compile/joint_blocks.h)
CONSTANT uint JOINT_COUPLES = 64u;  // no joint of two bodies but a coupling of the axes of others (joint_coupling.h)
CONSTANT uint JOINT_CURVED = 128u;  // of a coupling: its last term is a polynomial
// The active set: each axis has four bits of Joint.active_set.
CONSTANT uint MOTOR_AT_MIN = 1u;  // the motor is at its limit, negative
CONSTANT uint MOTOR_AT_MAX = 2u;  // positive
CONSTANT uint LIMIT_LOWER = 4u;   // the lower limit is active
CONSTANT uint LIMIT_UPPER = 8u;

// The joints of a block are contiguous, in elimination order (compute/compile/joint_blocks.h).
struct Joint {
    uint a, b;                        // bodies; NONE: the world
    uint block_body_a, block_body_b;  // their BlockBody; NONE: not dynamic
    vec3 anchor_a;                    // in A's frame, m
    uint flags;                       // JOINT_*
    vec3 anchor_b;
    uint next_a;   // next joint in body A's list; NONE: last
    vec4 frame_a;  // joint frame in A's frame
    vec4 frame_b;
    JointAxis axes[6];
    float break_force, break_torque;  // N, N m
    uint next_b;
    uint fill_in;        // number of entries in fill_in_of
    uint fill_in_of[8];  // later joints of the block whose equations its elimination changes, ascending
    // ---- state
    uint active_set;   // per axis
    uint broken;       // 1: the joint has broken
    uint solved_axes;  // bit per axis that is an unknown of the pass's equations
    float twist;       // rad, whole turns included (joint_turns.h)
    vec3 force;        // on B: sum of impulses in a step, N s; then the mean, N
    float max_force;
    vec3 torque;  // as force, N m
    float max_torque;
    JointRotor rotors[6];
    JointRow rows[6];
};
// Joints that are solved together, and their dynamic bodies.
struct JointBlock {
    uint first_joint, joints;  // in the table of joints
    uint first_body, bodies;   // in the table of block bodies
    uint restless;             // 1: one of its bodies is restless in this step
    uint unsettled;            // 1: an active set changed in the last round of the pass
    uint couplings;            // of its joints, the last ones
    uint pad0;
};
CONSTANT uint MAX_BLOCK_JOINTS = 128u;
// A small block: on a device 16 KiB hold its bodies, rows and equations, whatever their fill-in.
CONSTANT uint SMALL_BLOCK_JOINTS = 11u;
// A dynamic body in a block; one of several if blocks share the body.
struct BlockBody {
    uint body;
    uint slot;                 // of its VelocityDelta; NONE: it does not move in this step
    uint blocks;               // number of blocks that share the body
    float normal_sum;          // impulses of the block's joints on it in the last pass, N s
    Mass mass;                 // split in this pass
    Velocity velocity;         // of the split body; at the end of a pass, the whole body's change
    Velocity velocity_before;  // as a round of the pass begins
};
CONSTANT uint MAX_FILL_IN = 8u;
// The equations of a joint within a pass.
struct JointEquations {
    float solution[8];  // right-hand sides, then solutions; 6 in use
    float tiles[324];   // 6 x 6 entries of its own, and per fill-in entry 6 rows of the later joint x 6 of this one
    float rows[92];     // per row: direction, angular parts and what they do to both bodies, 15; 90 in use
};
CONSTANT uint OF_JOINT = 0x80000000u;  // flag in slot_sides: the rest is the index of a BlockBody

LAWS_END

#endif
