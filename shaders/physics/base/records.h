// The records of a step, in memory alike for the CPU and for std430: what a body is, and what a contact is.
#ifndef SCREE_PHYSICS_RECORDS_H
#define SCREE_PHYSICS_RECORDS_H

#include "shaders/physics/base/dialect.h"
#include "shaders/physics/collide/shapes.h"

LAWS_BEGIN

CONSTANT uint MOTION_DYNAMIC = 0u;
CONSTANT uint MOTION_FIXED = 1u;
CONSTANT uint MOTION_KINEMATIC = 2u;
CONSTANT uint MOTION_PENDING = 3u;  // a piece of a body that is still whole: it is nowhere
CONSTANT uint MOTION_BROKEN = 4u;   // its pieces are there in its place
// With one of these: a part of a body that moves so, a row of its own that the solver never moves (compound.h).
CONSTANT uint MOTION_OF_PART = 8u;

CONSTANT uint NONE = 0xFFFFFFFFu;

// ---- bodies, written when the scene is described; when one breaks, its motion and that of its pieces change
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
    uint large;       // 1: kept out of the grid, in the short list of large bodies
    uint owner;       // the body that this row is a part of; itself for a body
    uint fracture;    // in the table of fractures; NONE: it does not break
    uint joints;      // where the list of its joints begins; NONE: it has none
    uint shape_data;  // the record that completes its shape (shape_data.h: hull_of, tyre_of)
};
// Where a part lies in its body, or a piece in the body that breaks into it.
struct PoseInBody {
    vec3 position;  // from the body's centre of mass, along its axes, m
    float pad0;
    vec4 orientation;  // unit quaternion, from the part's axes to the body's
};
// How a body breaks (fracture.h).
struct Fracturing {
    float threshold;   // N s
    uint of_momentum;  // 1: the body's own; 0: an impulse
    uint first_row;    // of its pieces, which follow each other
    uint count;        // of its pieces
    uint first_pose;   // in the table of pieces, where equal bodies have the same
    uint pad0, pad1, pad2;
};
// Rubber on a wheel (tyre.h).
struct Tyre {
    float best_slip;  // at which it holds best
    float sliding;    // part of the friction that is left when it slides
    float pad0, pad1;
};

// ---- bodies, state
// Positions use compensated summation (Kahan 1965): a substep moves a body by so little that rounding, always to the same side,
// would otherwise change its speed by 1e-4, and the angular momentum with it. The low-order term is stored in the vec3 padding.
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

// What a body's velocity does not remember: the inertia of its present orientation, and what pushes it in this step.
struct Mass {
    float xx, xy, xz, yy;  // world inverse inertia tensor, symmetric, 1/(kg m^2)
    float yz, zz;
    float inverse_mass;  // 1/kg
    float split;  // of the mass lent to a contact: a part of 1/split. In the table: how crowded the body is (mass_splitting.h)
};
struct BodyForces {
    vec3 acceleration;  // gravity and forces, m/s^2, over the whole step
    float kept;  // part of their impulses that the body's contacts keep in this step: less than 1 if it breaks (fracture.h)
    vec3 angular_acceleration;  // rad/s^2
    float impacts;              // contacts that struck the body in this substep and throw it back
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

// A body held at a point and drawn to a place by a damped spring (grab_spring.h), for as long as the user holds it.
CONSTANT uint MOST_GRIPS = 4u;  // at once
struct Grip {
    vec3 anchor;  // where it is held, from the centre, in the body's frame, m
    uint body;
    vec3 target;      // where that point shall be, m
    float bias_rate;  // soft constraint, 1/s (Catto 2011)
    float mass_scale;
    float most;       // m/s in a substep: the greatest push, as a change of the centre's velocity
    float spin_kept;  // part of the spin that a substep leaves
    float pad0;
};

// ---- what touches
// Up to four points in which two bodies touch or are about to.
struct Manifold {
    vec3 normal;     // unit, world, from A to B
    uint features;   // four 8-bit feature ids, point k in bits 8k to 8k + 7
    vec4 points[4];  // xyz: from A's centre to the point midway between the surfaces, world axes, m; w: separation, m, < 0 inside
};
struct ManifoldBuffer {
    Manifold manifold;
    uint count;  // points, 0 to 4; unused points are zero
    uint pad0, pad1, pad2;
};

// ---- fast bodies
struct Sweep {      // of a body through the step
    vec3 position;  // at the start, m
    float pad0;
    vec4 orientation;  // at the start
    uint stops[2];     // bits of the fraction of the step at which it is stopped; NO_HIT for a body that is not. Rounds of search
                       // read one of them and write the other
    uint struck;       // 1: something will strike it in this step and change its course
    uint pad1;
};

// ---- who is near whom
struct Bounds {   // of a body over the coming step, with its margin
    vec3 lower;   // m
    uint level;   // of the grid; cells of level l are cell * 2^l wide; with INACTIVE (grid.h)
    vec3 upper;   // m
    uint bucket;  // of its centre's cell; the last one for a large body
    Sweep sweep;
};
struct CellEntry {  // the same, in the order of buckets, then of bodies
    vec3 lower;     // m
    uint body;
    vec3 upper;  // m
    uint level;
};
struct Candidate {
    uint owner;  // the body that found the pair
    uint other;
};
struct Pair {
    uint a, b;       // rows of bodies or parts, the lower id first
    uint pair_type;  // PAIR_*
    uint previous;   // its contact in the last step, or NONE
};

// ---- contacts: what lasts from step to step
struct Contact {
    uint a, b;      // rows of bodies or parts, the lower id first. All that follows speaks of the bodies that parts belong to
    uint count;     // points, 1 to 4
    uint features;  // as in Manifold
    vec3 normal;    // unit, world, from A to B, when the contact was made
    uint age;       // steps since it was made
    vec3 center_offset;  // centre of B minus centre of A when it was made, m
    float load;          // normal impulse of a substep when both bodies were last awake, N s
    vec4 points[4];      // as in Manifold, when it was made
    vec4 orientation_a;  // orientation of A when it was made
    vec4 orientation_b;  // orientation of B when it was made
};
struct Impulse {
    vec4 normal;           // per point, of one substep, N s, >= 0
    vec4 separation;       // per point, m
    vec4 impact_velocity;  // per point: normal velocity of an impact to be thrown back, m/s, < 0; else 0
    vec3 friction;         // in the tangent plane, world, on B, N s
    float twist;           // about the normal, N m s
    vec3 rolling;          // world, on B, N m s
    float slide_distance;  // way of B along A's surface in this step, m
    vec3 center_offset;    // centre of B minus centre of A now, m: where both bodies feel the same point
    float normal_sum;      // the sum of `normal` as the substep began, N s
};

// ---- contacts: what the solver needs in this step
// Which body a contact's points stay with while both move through the substeps of a step.
CONSTANT uint ANCHOR_A = 0u;
CONSTANT uint ANCHOR_B = 1u;
CONSTANT uint ANCHOR_ROUND = 2u;  // neither: the one point lies between two round bodies wherever they go

struct Constraint {
    uint a, b;            // bodies, never parts
    uint slot_a, slot_b;  // where their velocity changes go; NONE for a body that contacts do not move
    vec3 normal;          // unit, world, from A to B
    float friction;       // Coulomb coefficient of the pair
    vec4 arms[4];  // xyz: from the anchor's centre to the point, m (ANCHOR_ROUND: from A's centre to the centre of A's curvature)
    vec3 centre;   // of the friction patch, as the arms, m (ANCHOR_ROUND: of B's curvature, from B's centre)
    float twist_arm;           // lever arm of twisting friction, m: mean distance of the points from the patch's centre
    float rolling_resistance;  // of the pair, m
    float restitution;         // of the pair
    uint count;                // points
    uint anchor;               // ANCHOR_*
    float radius_a, radius_b;  // ANCHOR_ROUND: of curvature, m; else radius_a: slip at which a tyre holds best, m/s; 0: no tyre
    uint pair;                 // whose manifold it is
    float slide_limit;         // way after which the points have left the body that they slide over, m
};
struct VelocityDelta {  // what one contact did to one body; a body sums its slots in order
    vec3 linear;        // m/s
    float is_active;    // 1: the contact pushes, or will in the next substep; it counts in the split
    vec3 angular;       // rad/s
    float told;         // the normal impulse, N s; in the last pass what the other body tells of its rest (sleep.h), steps
};

// ---- joints
// What a joint may do along or about one of its six axes: along x, y and z of its frame in A, then the twist about x, and the
// swing about y and z. A place is how far B is from A there.
CONSTANT uint AXIS_LOCKED = 1u;
CONSTANT uint AXIS_LIMITED = 2u;
CONSTANT uint AXIS_MOTOR = 4u;   // driven to a speed; friction is a motor of speed 0
CONSTANT uint AXIS_SPRING = 8u;  // drawn to a place, or damped
struct JointAxis {
    uint mode;           // AXIS_*
    float lower, upper;  // of the place, m or rad
    float stiffness;     // N/m or N m/rad
    float damping;       // N s/m or N m s/rad
    float rest;          // the spring's place, m or rad
    float speed;         // of a motor, m/s or rad/s
    float most;          // of a motor or spring, N or N m
};
// An axis in the pass at hand, and its impulses, which last.
struct JointRow {
    vec3 direction;    // along or about which B is pushed and A pushed back, world, unit
    float coordinate;  // m or rad
    vec3 angular_a;    // what turns A: lever x direction, m, or the direction itself
    float drift;       // what the place's second derivative adds to its speed until the middle of the substep, m/s or rad/s
    vec3 angular_b;
    float inverse_effective_mass;  // speed that an impulse of 1 brings about in the lent bodies, 1/kg or 1/(kg m^2)
    float motor_impulse,
        limit_impulse;   // impulses of a substep: of lock, motor or spring; of the limit (> 0: of the lower), N s or N m s
    float motor_change;  // in this pass
    float limit_change;
};

CONSTANT uint JOINT_RADIAL = 1u;    // axis x points from A's anchor to B's, and its place is their distance
CONSTANT uint JOINT_CONE = 2u;      // axis y of the swing is the one that B has swung about, and its place the whole swing
CONSTANT uint JOINT_COLLIDES = 4u;  // the two bodies may touch
CONSTANT uint JOINT_SPINS = 8u;  // B spins about its x axis: with its swing's axes as they are at rest, swinging would stop that
// Each axis has four bits of Joint.pins.
CONSTANT uint MOTOR_AT_MIN = 1u;  // the drive pushes as hard as it may, down
CONSTANT uint MOTOR_AT_MAX = 2u;  // and up
CONSTANT uint LIMIT_LOWER = 4u;   // the lower limit acts
CONSTANT uint LIMIT_UPPER = 8u;

// A record holds the i-th joint of a block of joints and the i-th body of it; there are as many as the more numerous has. Joints
// are in the order in which they are eliminated (compute/step/joint_blocks.h).
struct Joint {
    uint a, b;                        // bodies; NONE: the world
    uint block_body_a, block_body_b;  // records where the block has them; NONE for what is not dynamic
    vec3 anchor_a;                    // in A's frame, m
    uint flags;                       // JOINT_*
    vec3 anchor_b;
    uint next_a;   // joint of body A after this one in its list; NONE: the last
    vec4 frame_a;  // from the joint's axes to A's
    vec4 frame_b;
    JointAxis axes[6];
    float break_force, break_torque;  // N, N m
    uint next_b;
    uint fill_in;        // how many
    uint fill_in_of[8];  // joints of the block behind this one that its elimination changes, in rising order (MOST_LINKS)
    // ---- of the block, in its first record
    uint block_joints, block_bodies;
    uint first_of_block;  // in record i: where the i-th block begins
    uint restless;        // 1: a body of it is, in this step
    // ---- state
    uint active_set;   // per axis
    uint broken;       // 1: it has torn
    uint solved_axes;  // bit per axis that is in the pass's system of equations
    uint unsettled;    // of the block, in its first record. 1: in the last round of the pass bounds turned out to act otherwise
    vec3 force;        // on B, N: sums of impulses within a step, their mean at its end
    float max_force;
    vec3 torque;  // N m
    float max_torque;
    // ---- the body of this record
    uint block_body;  // NONE: none
    uint slot;
    float normal_sum;          // N s
    uint blocks;               // that have the body
    Mass mass;                 // lent
    Velocity velocity;         // lent
    Velocity velocity_before;  // as each round of the pass begins
    // ---- the pass's equations
    JointRow rows[6];
    float solution[8];    // 6 are in use
    float diagonal[36];   // 6 rows of 6
    float coupling[288];  // per link, 6 rows of the later joint by 6 of this one
};
CONSTANT uint MAX_FILL_IN = 8u;
CONSTANT uint OF_JOINT = 0x80000000u;  // in the list of slots' sides: of the block's body in this record

// ---- vehicles (vehicle.h)
struct VehicleWheel {
    uint joint;  // its record
    uint body;
    float radius;      // m
    float ahead;       // of the axis that it turns about when the vehicle turns, m; 0 for a wheel that is not steered
    float aside;       // of the vehicle's middle, to the left, m
    float torque;      // N m, at full throttle
    float power;       // W, at full throttle
    float drag;        // N m, without throttle
    float brake;       // N m
    float hand_brake;  // N m
    float skid;        // part of the steering that is added to its throttle, -1 to 1
    uint steers;       // 1: its joint is turned
};
// A point of a route.
struct WayPoint {
    vec3 position;  // m
    float speed;    // there, m/s
};
// How a vehicle is driven: all of it but its wheels.
struct VehicleDynamics {
    uint chassis;
    uint wheels;
    uint route;           // where its route begins in the table of way points
    uint points;          // of the route; 0: it has none
    vec4 frame;           // from its axes (x to the left, y up, z ahead) to those of the chassis
    float top_speed;      // m/s
    float reverse_speed;  // m/s, backwards
    float tightest;       // curvature of the curve at full lock, 1/m
    float turning;        // greatest change of that, 1/(m s)
    float lateral;        // m/s^2, the most that a curve may need at the present speed
    uint loops;           // 1: the route begins again behind its last point
    float speed;          // state: ahead, m/s
    float curvature;      // state: of the curve that its wheels are steered to, 1/m, > 0: to the left
    // What it is told.
    float throttle, brake, steer, hand_brake;  // as in scree::Controls
    uint by_route;                             // 1: the driver follows the route
    uint next;                                 // state: way point that it drives to; `points`: it has arrived
    uint passed;                               // state: way points so far
    uint pad0;
};
CONSTANT uint MOST_WHEELS = 8u;
struct Vehicle {
    VehicleDynamics dynamics;
    VehicleWheel wheel[8];  // MOST_WHEELS
};

// ---- the step itself
struct Parameters {  // the same for every thread of a step
    vec3 gravity;    // m/s^2
    float dt;        // of a step, s
    float h;         // of a substep, s
    float inverse_h;
    float bias_rate;  // soft contact, 1/s (Catto 2011)
    float mass_scale;
    float impulse_scale;
    float push_speed;             // m/s
    float inverse_relaxation;     // 1 / 1.5
    float speculative;            // m
    float restitution_threshold;  // m/s
    float max_speed;              // m/s
    float max_spin;               // rad/s
    float cell;                   // width of the grid's finest cells, m
    float inverse_cell;
    uint bodies;   // rows of the bodies' tables, parts included
    uint buckets;  // of the grid, a power of two; one more holds the large bodies
    uint pair_capacity;
    uint contact_capacity;
    uint group_size;          // threads of a workgroup, a power of two
    uint group_shift;         // its logarithm
    uint actions;             // records in the list, for the coming step
    uint redo;                // 1: the step is done again after a buffer grew; impulses have been applied already
    uint wake_all;            // 1: all sleepers wake as the step begins
    uint sleep_steps;         // quiet steps after which a body sleeps; sleep.h's NO_SLEEP
    float sleep_speed;        // m/s, slower is quiet
    float friction_factor;    // on the friction of every pair
    float least_restitution;  // of every pair
    uint held;                // grips in use
    uint first_part;          // from this row on, rows are parts of bodies
    uint joint_blocks;
    uint vehicles;
    // Where each of the tables begins that share a buffer, in words and in quads of it (shaders/stages/lib/tables.h).
    uint cell_ends_offset;
    uint pair_starts_offset;
    uint slot_ends_offset;
    uint first_contacts_offset;
    uint sleep_states_offset;
    uint ids_offset;
    uint strains_offset;
    uint point_counts_offset;
    uint pairs_by_type_offset;
    uint contacts_to_solve_offset;
    uint pair_type_starts_offset;
    uint contact_starts_offset;
    uint carried_offset;
    uint slot_sides_offset;
    uint scan_sums_offset;
    uint hulls_offset;
    uint parts_offset;
    uint fractures_offset;
    uint pieces_offset;
    uint tyres_offset;
    uint way_points_offset;
    uint pad0;
    Grip grips[4];  // MOST_GRIPS
};

// What there may be in a scene; a device leaves out the rest.
CONSTANT uint FEATURE_BOUNCES = 1u;  // restitution
CONSTANT uint FEATURE_ROLLS = 2u;    // resistance to rolling
CONSTANT uint FEATURE_ROUND = 4u;    // round bodies
CONSTANT uint FEATURE_TYRES = 8u;
CONSTANT uint FEATURE_PARTS = 16u;      // bodies of several parts that move
CONSTANT uint FEATURE_REORDERED = 32u;  // bodies whose rows are in another order than their ids
CONSTANT uint FEATURE_JOINTS = 64u;
CONSTANT uint FEATURE_BREAKING = 128u;  // bodies that may break

CONSTANT uint PAIR_TYPES = 16u;  // of pairs: fourteen of shapes, those whose contact is kept, and those at rest
CONSTANT uint PAIR_BLOCK = 16u;  // pairs that one thread sorts by kind
CONSTANT uint PAIR_BLOCK_SHIFT = 4u;
CONSTANT uint SCAN_ITEMS = 8u;  // items that one thread of a scan adds up
CONSTANT uint SCAN_SHIFT = 3u;

// Work that the device counts itself: rows of Counts.arguments.
CONSTANT uint WORK_PAIRS = 0u;
CONSTANT uint WORK_PAIR_BLOCKS = 1u;
CONSTANT uint WORK_PAIR_TYPE_SCAN_BLOCKS = 2u;
CONSTANT uint WORK_PAIR_SCAN_BLOCKS = 3u;
CONSTANT uint WORK_CONTACTS = 4u;
CONSTANT uint WORK_PAIR_TYPE = 5u;  // and the PAIR_TYPES - 1 rows after it
CONSTANT uint WORK_SOLVER_CONTACTS = 21u;
CONSTANT uint WORK_WAKE = 22u;
CONSTANT uint WORK_CCD_PAIRS = 23u;  // all pairs if some body is fast, else none
CONSTANT uint WORKS = 24u;
CONSTANT uint OVERFLOW_PAIRS = 1u;
CONSTANT uint OVERFLOW_CONTACTS = 2u;

struct Counts {  // what the device counts in a step
    uint pairs, contacts;
    uint levels;    // bit l: some body is on level l of the grid
    uint overflow;  // OVERFLOW_*; while not 0 no stage changes the bodies
    uint required_pairs, required_contacts;
    uint steps;                // whole steps done
    uint pairs_coarse;         // pairs in units of 256, each body's rounded up: it does not wrap where their number does
    uint levels_stirring;      // bit l: some body that stirs is on level l
    uint large_stirring;       // 1: some large body stirs
    uint sleepers;             // 1: some body is asleep as the step begins
    uint solver_contacts;      // contacts that move somebody: those of the solver
    uint pair_type_first[20];  // pairs of kind k are [pair_type_first[k], pair_type_first[k + 1]) of pairs_by_type
    uint fast;                 // 1: some body will be fast in this step
    uint broken;               // bodies that break in this step
    uint pad0, pad1;
    uvec4 arguments[24];  // per WORK_*: workgroups x, y, z, and threads
};

// Not there at present: it touches nothing and is seen nowhere, only its row is kept.
LAW bool is_absent(uint motion) {
    return motion == MOTION_PENDING || motion == MOTION_BROKEN;
}

LAWS_END

#endif
