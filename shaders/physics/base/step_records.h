// Records of the step itself: its parameters, the features of its scene, its indirect dispatches, and its counts.
#ifndef SCREE_PHYSICS_STEP_RECORDS_H
#define SCREE_PHYSICS_STEP_RECORDS_H

#include "shaders/physics/base/body_records.h"

LAWS_BEGIN

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
    uint removed;      // 1: bodies were removed since the last step; sleepers that touched them wake
    uint copies;       // of the scene, at least 1 (copies.h)
    uint most_groups;  // workgroups of a dispatch along one axis
    uint bonds;
    uint bonded;  // bodies with smaller ids may have bonds
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
    // Periodic cell (periodic_cell.h); of an axis along which there is none 0, but half_period 1e30.
    vec3 period;  // m
    uint pad1;
    vec3 half_period;  // m
    uint pad2;
    vec3 inverse_period;  // 1/m
    uint pad3;
    vec3 cell_centre;  // m
    uint pad4;
    vec3 cell_rate;  // at which the cell stretches, 1/s
    uint pad5;
    vec4 attractor[4];  // MOST_ATTRACTORS. xyz: position, m; w: strength, m^3/s^2
    Grip grips[4];      // MOST_GRIPS
    // Where each table of words or quads begins in the buffer that it shares, in words or quads: in their order in
    // shaders/stages/lib/tables.h. Shaders call them <table>_offset, which the build generates.
    uvec4 table_offsets[12];
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
CONSTANT uint FEATURE_PERIODIC = 16384u;  // a periodic cell

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

LAWS_END

#endif
