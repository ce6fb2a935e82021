// Records of pairs and contacts: sweeps and bounds, manifolds, what a contact keeps from step to step, and what the solver
// computes with.
#ifndef SCREE_PHYSICS_CONTACT_RECORDS_H
#define SCREE_PHYSICS_CONTACT_RECORDS_H

#include "shaders/physics/base/dialect.h"

LAWS_BEGIN

// ---- manifolds
// Flag in the table of point counts: the pair has no points because its bodies hide them (seam.h). It counts as a contact where
// times of impact are found.
CONSTANT uint POINTS_HIDDEN = 0x40000000u;
LAW bool has_points(uint counts) {
    return (counts & ~POINTS_HIDDEN) != 0u;
}
// Contact manifold of up to four points, speculative ones included.
struct Manifold {
    vec3 normal;     // unit, world, from A to B
    uint features;   // four 8-bit feature ids, point k in bits 8k to 8k + 7
    vec4 points[4];  // xyz: from A's centre to the point midway between the surfaces, world, m; w: separation, m
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

// ---- contacts: solver data of this step
CONSTANT uint CONSTRAINT_POINTS = 7u;  // mask of the number of points
// The body to which the points are fixed while both move through the substeps of a step; without either flag, A.
CONSTANT uint CONSTRAINT_ON_B = 8u;
CONSTANT uint CONSTRAINT_ROUND = 16u;       // neither: the single point of two round bodies follows both
CONSTANT uint CONSTRAINT_ROLLS_ONLY = 32u;  // the rolling resistance does not resist spinning
CONSTANT uint CONSTRAINT_FOLLOWS = 64u;     // its block has a contact before it (contact_block.h)
CONSTANT uint CONSTRAINT_LEADS = 128u;      // its block has a contact behind it
CONSTANT uint CONSTRAINT_ON_JOINTS = 256u;  // it moves a body that is on joints
// In a periodic cell, B is met at its image one period further along x, or one back; likewise along y and z, each 2 bits on.
CONSTANT uint CONSTRAINT_IMAGE_ON = 512u;
CONSTANT uint CONSTRAINT_IMAGE_BACK = 1024u;

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

LAWS_END

#endif
