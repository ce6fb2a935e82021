// The records of a step, laid out alike on the CPU and by std430: bodies, contacts, joints, vehicles, parameters,
// counts.
#ifndef SCREE_PHYSICS_RECORDS_H
#define SCREE_PHYSICS_RECORDS_H

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
CONSTANT uint ROW_ELSEWHERE = 16u;     // one of the latter that is not near either, so no ghost: it is in no cell
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
    vec3 position;  // from the body's centre of mass, body axes, m
    float pad0;
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
    vec3 velocity_before;  // m/s, with ACTION_CHANGES_VELOCITY
    float pad8;
    vec3 angular_velocity_before;  // rad/s
    float pad9;
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

// ---- manifolds
// Contact manifold of up to four points, speculative ones included.
struct Manifold {
    vec3 normal;     // unit, world, from A to B
    uint features;   // four 8-bit feature ids, point k in bits 8k to 8k + 7
    vec4 points[4];  // xyz: from A's centre to the point midway between the surfaces, world, m; w: separation, m
};
struct ManifoldBuffer {
    Manifold manifold;
    uint count;  // points, 0 to 4; unused points are zero
    uint pad0, pad1, pad2;
};

// ---- continuous collision
struct Sweep {      // motion of a body through the step
    vec3 position;  // at the start, m
    float pad0;
    vec4 orientation;  // at the start
    uint stops[2];     // float bits of the fraction of the step at which it is clamped, or NO_HIT; CCD rounds alternate
    uint marks;        // STRUCK, DRIVEN, UNSOUND (sweep.h)
    uint pad1;
};

// ---- broadphase
struct Bounds {   // swept AABB of a body over the step, with its margin
    vec3 lower;   // m
    uint level;   // grid level, whose cells are cell * 2^l wide; with INACTIVE and the copy (grid.h)
    vec3 upper;   // m
    uint bucket;  // hash bucket of its centre's cell; one behind all others for a large body
    Sweep sweep;
};
struct CellEntry {  // a body's bounds, sorted by bucket, then by body
    vec3 lower;     // m
    uint body;
    vec3 upper;  // m
    uint level;
};
struct Candidate {
    uint owner;  // the body whose search found the pair
    uint other;
};
// Pair types. The first four shapes in ascending order give 0 to 8 (plane-plane has none); general convex shapes share
// collide_convex, but for planes, triangles and hull-hull. PAIR_PERSISTENT keeps its manifold (persistence.h),
// PAIR_INACTIVE is a pair of inactive bodies.
CONSTANT uint PAIR_BOX_BOX = 7u;
CONSTANT uint PAIR_BOX_PLANE = 8u;
CONSTANT uint PAIR_PLANE_CONVEX = 9u;
CONSTANT uint PAIR_CONVEX = 10u;
CONSTANT uint PAIR_HULL_HULL = 11u;
CONSTANT uint PAIR_SPHERE_TRIANGLE = 12u;
CONSTANT uint PAIR_CONVEX_TRIANGLE = 13u;
CONSTANT uint PAIR_PERSISTENT = 14u;
CONSTANT uint PAIR_INACTIVE = 15u;
struct Pair {
    uint a, b;       // rows of bodies or parts, the lower id first
    uint pair_type;  // PAIR_*
    uint previous;   // its contact in the last step, NONE: new
};

// ---- contacts: persistent state
struct Contact {
    uint a, b;      // rows of bodies or parts, the lower id first; all else refers to the bodies that own them
    uint count;     // points, 1 to 4
    uint features;  // as in Manifold
    vec3 normal;    // unit, world, from A to B, when the contact was made
    float pad0;
    vec3 center_offset;  // centre of B minus centre of A when made, m
    float load;          // normal impulse in a substep when both bodies were last awake, N s
    vec4 points[4];      // as in Manifold, when made
    vec4 orientation_a;  // of A when made
    vec4 orientation_b;  // of B when made
};
// Impulses of a contact and what they depend on, but for impacts.
struct ContactImpulse {
    vec4 normal;           // per point, N s, >= 0; the next substep starts with these
    vec4 separation;       // per point, m
    vec3 friction;         // in the tangent plane, world, on B, N s
    float twist;           // about the normal, N m s
    vec3 rolling;          // world, on B, N m s
    float slide_distance;  // slide of B along A's surface in this step, m
    vec3 center_offset;    // centre of B minus centre of A at present, m: both bodies feel an impulse at one point
    float normal_sum;      // sum of `normal` as the substep began, N s
    vec3 stretch;          // way of B over A since the patch sticks (friction.h), in the tangent plane, world, m
    float turn;            // turn of B on A since, about the normal, rad
};
CONSTANT uint CONTACT_IMPULSE_QUADS = 6u;  // of 16 bytes
// The impact with restitution of a contact (restitution.h); all 0: none.
struct ContactImpact {
    vec4 impact;           // per point: impulse in the last pass, N s
    float rebound_energy;  // that the impact has yet to return, less half the last pass's work so far as it is known, J
    float impact_energy;   // that the impact had to return as it began, J; 0: it does not last
    float impact_weight;   // of the contact among the impacts of its bodies: the impulse it will exchange, N s
    float flight_energy;   // that gravity adds to the rebound of its bodies in this substep, J
    // Of an impact on joints that lasts.
    float speed_before_push;  // along its mode before its last push, m/s, != 0; between substeps
    float response;           // change of that speed by an impulse of 1, 1/kg, from that push; within a substep
    float pad0, pad1;
};
// Both, as the solver computes with them (contact_impulse.h); tables have them apart, because most scenes have no restitution.
struct Impulse {
    vec4 normal, separation;
    vec4 impact;
    float rebound_energy, impact_energy, impact_weight, flight_energy;
    vec3 friction;
    float twist;
    vec3 rolling;
    float slide_distance;
    vec3 center_offset;
    float normal_sum;
    vec3 stretch;
    float turn;
    float speed_before_push, response, pad0, pad1;
};

// ---- contacts: solver data of this step
CONSTANT uint CONSTRAINT_POINTS = 7u;  // mask of the number of points
// The body to which the points are fixed while both move through the substeps of a step; without either flag, A.
CONSTANT uint CONSTRAINT_ON_B = 8u;
CONSTANT uint CONSTRAINT_ROUND = 16u;       // neither: the single point of two round bodies follows both
CONSTANT uint CONSTRAINT_ROLLS_ONLY = 32u;  // the rolling resistance does not resist spinning
CONSTANT uint CONSTRAINT_FOLLOWS = 64u;     // its block has a contact before it (contact_block.h)
CONSTANT uint CONSTRAINT_LEADS = 128u;      // its block has a contact behind it
CONSTANT uint CONSTRAINT_ON_JOINTS = 256u;  // it moves a body that is on joints

struct Constraint {
    uint a, b;            // rows of bodies, never of parts
    uint slot_a, slot_b;  // slots of their VelocityDelta; NONE for a body that contacts do not move
    vec3 normal;          // unit, world, from A to B
    float friction;       // Coulomb coefficient of the pair
    // The points in the plane of the patch, from `centre`, m: along tangent(normal) and cross3(normal, tangent(normal)).
    // CONSTRAINT_ROUND: x, y and z of points_u are A's centre of curvature, from its centre.
    vec4 points_u, points_v;
    // Slip of B's surface over A's while the bodies stand still, along both tangents of the normal, m/s (surface.h).
    float drive1, drive2;
    float static_friction;        // coefficient, or 0: the dynamic one
    float restitution_threshold;  // speed of the slowest impacts, m/s, or 0: the setting's
    vec3 centre;      // of the patch, from the anchor body's, m (CONSTRAINT_ROUND: from B's centre to its centre of curvature)
    float twist_arm;  // of torsional friction, m: mean distance of the patch from its centre
    float rolling_resistance;  // of the pair, m
    float restitution;         // of the pair
    uint flags;                // CONSTRAINT_*, with the number of points
    float tyre_slip;           // speed of slip up to which a tyre's friction rises, m/s, or 0: no tyre rolls
    float radius_a, radius_b;  // CONSTRAINT_ROUND: of curvature, m
    uint links;                // next_of_block()
    float slide_limit;         // slide after which the points have left the body they slide over, m
};
struct VelocityDelta {  // velocity change of one body by one contact; summed in the order of slots
    vec3 linear;        // m/s
    float weight;       // in the mass splitting that follows: of active contacts, of impacts after the biased pass
    vec3 angular;       // rad/s
    float passed_on;    // to the pass that follows: normal impulse, N s; impact_debt() after the biased pass, J
};

// ---- joints
// A joint has six axes: translation along x, y and z of its frame in A, the twist about x, and the swing about y and z.
// An axis's coordinate is the position of B relative to A along or about it. Where B turns about one axis alone, that is x.
CONSTANT uint AXIS_LOCKED = 1u;
CONSTANT uint AXIS_LIMITED = 2u;
CONSTANT uint AXIS_MOTOR = 4u;   // velocity motor; friction is a motor of speed 0
CONSTANT uint AXIS_SPRING = 8u;  // spring, damper or both
CONSTANT uint AXIS_ROTOR = 16u;  // armature: the inertia of a rotor
CONSTANT uint AXIS_CUT = 32u;    // of a joint with JOINT_CUT, where it is not free
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
    uint pad0, pad1;
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

// ---- vehicles (vehicle.h)
struct VehicleWheel {
    uint joint;  // record of its joint
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

// ---- the step itself
struct Parameters {  // uniform over a step
    vec3 gravity;    // m/s^2
    float dt;        // of a step, s
    float h;         // of a substep, s
    float inverse_h;
    float bias_rate;  // soft contact, 1/s (Catto 2011)
    float mass_scale;
    float impulse_scale;
    float push_speed;             // m/s
    float inverse_relaxation;     // 1 / omega of the over-relaxed Jacobi iteration, 1 / 1.5
    float speculative;            // m
    float restitution_threshold;  // m/s
    float max_speed;              // m/s
    float max_spin;               // rad/s
    float cell;                   // width of the grid's finest cells, m
    float inverse_cell;
    uint bodies;   // rows of the bodies' tables, parts included
    uint buckets;  // hash buckets of the grid, a power of two; one more per copy holds its large bodies
    uint pair_capacity;
    uint contact_capacity;
    uint group_size;          // threads of a workgroup, a power of two
    uint group_shift;         // log2(group_size)
    uint actions;             // records in the list of actions
    uint redo;                // 1: repetition of a step after a buffer grew; impulses are already applied
    uint wake_all;            // 1: all bodies wake as the step begins
    uint sleep_steps;         // quiet steps after which a body sleeps, or NO_SLEEP (sleep.h)
    float sleep_speed;        // bodies slower than this are quiet, m/s
    float friction_factor;    // scales the friction of every pair
    float least_restitution;  // of any pair
    uint held;                // grab springs in use
    uint first_part;          // first row of parts
    uint joint_blocks;
    uint vehicles;
    // Offsets of the tables that share a buffer, in words or quads (shaders/stages/lib/tables.h).
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
    uint neighbours_quiet_offset;
    uint scan_sums_offset;
    uint hulls_offset;
    uint parts_offset;
    uint fractures_offset;
    uint pieces_offset;
    uint tyres_offset;
    uint way_points_offset;
    uint filters_offset;
    uint exclusions_offset;
    uint surfaces_offset;
    uint immersions_offset;
    uint removed;  // 1: bodies were removed since the last step; sleepers that touched them wake
    uint births_offset;
    uint copy_states_offset;
    uint gravities_offset;
    uint copies;  // of the scene, at least 1 (copies.h)
    uint contact_owners_offset;
    uint impact_debts_offset;
    uint manifold_places_offset;
    uint contact_pairs_offset;
    uint contact_slots_offset;
    uint most_groups;  // workgroups of a dispatch along one axis
    uint pad0;
    // Fields (medium.h).
    vec3 wind;               // m/s
    float air_density;       // kg/m^3; 0: no air
    vec3 water_normal;       // unit, up
    float water_offset;      // of its surface along the normal, m
    vec3 water_velocity;     // m/s
    float water_density;     // kg/m^3; 0: no water
    float water_damping;     // 1/s
    float attractor_radius;  // m
    uint attractors;         // number of them
    uint bodies_of_copy;     // copy w has the bodies with ids from w * bodies_of_copy on; 0: a scene without copies
    vec4 attractor[4];       // MOST_ATTRACTORS. xyz: position, m; w: strength, m^3/s^2
    Grip grips[4];           // MOST_GRIPS
};

// Features of a scene; shaders are specialised to leave out the others.
CONSTANT uint FEATURE_BOUNCES = 1u;  // restitution
CONSTANT uint FEATURE_ROLLS = 2u;    // rolling resistance
CONSTANT uint FEATURE_ROUND = 4u;    // spheres and capsules
CONSTANT uint FEATURE_TYRES = 8u;
CONSTANT uint FEATURE_PARTS = 16u;      // moving compounds
CONSTANT uint FEATURE_REORDERED = 32u;  // rows in an order other than that of ids
CONSTANT uint FEATURE_JOINTS = 64u;
CONSTANT uint FEATURE_SUMS = 128u;        // contact impulses are summed over the step: breakable bodies, events
CONSTANT uint FEATURE_FILTERS = 256u;     // collision filters, excluded pairs
CONSTANT uint FEATURE_SURFACES = 512u;    // materials with more than friction, restitution and rolling resistance
CONSTANT uint FEATURE_COPIES = 1024u;     // several copies of a scene
CONSTANT uint FEATURE_GRAVITIES = 2048u;  // whose gravity differs
CONSTANT uint FEATURE_BLOCKS = 4096u;     // compounds or meshes: pairs of bodies in several contacts
CONSTANT uint FEATURE_GHOSTS = 8192u;     // rows of other ranks are marked by ROW_FOREIGN

CONSTANT uint PAIR_TYPES = 16u;  // fourteen of shape pairs, persistent and inactive
CONSTANT uint PAIR_BLOCK = 16u;  // pairs that one thread bins by type
CONSTANT uint PAIR_BLOCK_SHIFT = 4u;
CONSTANT uint SCAN_ITEMS = 8u;  // items per thread of a scan
CONSTANT uint SCAN_SHIFT = 3u;

// Indirect dispatches: rows of Counts.arguments.
CONSTANT uint WORK_PAIRS = 0u;
CONSTANT uint WORK_PAIR_BLOCKS = 1u;
CONSTANT uint WORK_PAIR_TYPE_SCAN_BLOCKS = 2u;
CONSTANT uint WORK_PAIR_SCAN_BLOCKS = 3u;
CONSTANT uint WORK_CONTACTS = 4u;
CONSTANT uint WORK_PAIR_TYPE = 5u;  // and the PAIR_TYPES - 1 rows after it
CONSTANT uint WORK_SOLVER_CONTACTS = 21u;
CONSTANT uint WORK_WAKE = 22u;
CONSTANT uint WORK_CCD_PAIRS = 23u;  // all pairs if some body is fast, else 0
CONSTANT uint WORKS = 24u;
CONSTANT uint OVERFLOW_PAIRS = 1u;
CONSTANT uint OVERFLOW_CONTACTS = 2u;

struct Counts {            // counted on the device in a step
    uint pairs, contacts;  // until contacts are counted: pairs with points
    uint levels;           // bit l: some body is on grid level l
    uint overflow;         // OVERFLOW_*; stages leave the bodies unchanged while it is not 0
    uint required_pairs, required_contacts;
    uint steps;                // completed steps
    uint pairs_coarse;         // pairs / 256, rounded up per body: detects overflow of the 32-bit count
    uint levels_stirring;      // bit l: some active body is on level l
    uint large_stirring;       // bit 0: some large body is active; bit 1: some body that is in no grid is
    uint sleepers;             // 1: some body is asleep as the step begins
    uint solver_contacts;      // contacts that the solver processes, with at least one movable body
    uint pair_type_first[20];  // pairs of type k are [pair_type_first[k], pair_type_first[k + 1]) of pairs_by_type
    uint fast;                 // 1: some body is predicted to be fast (sweep.h)
    uint broken;               // number of bodies that break in this step
    uint spin_limited;         // bodies at the limit of rotation as a step ends, summed over the steps
    uint quarantined;          // bodies put into quarantine, summed over the steps
    uvec4 arguments[24];       // per WORK_*: workgroups x, y, z, and threads
};

// A pending fragment or a broken body: it has a row, but neither collides nor is drawn.
LAW bool is_absent(uint motion) {
    return motion == MOTION_PENDING || motion == MOTION_BROKEN;
}

LAWS_END

#endif
