// Broadphase: a hashed uniform grid of several levels.
//
// Cells of level l are cell * 2^l wide. A body is in the single cell of its AABB's centre, on the lowest level whose
// cells are at least as wide as its AABB. So any body whose AABB overlaps has its centre at most half a cell outside
// the AABB: in two or three cells along each axis, on its own level and on each coarser one. A row of cells along x is
// a run of buckets, hence one range of the sorted list. Planes and rare large bodies are in one more bucket, which
// every body searches. Copies of a scene (copies.h) have the same coordinates: their cells differ in the number of the
// copy, which is in the upper bits of the level, and each copy has a bucket of large bodies.
#ifndef SCREE_PHYSICS_GRID_H
#define SCREE_PHYSICS_GRID_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/copies.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/periodic_cell.h"
#include "shaders/physics/body/sweep.h"
#include "shaders/physics/collide/contact_margin.h"
#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

CONSTANT uint LEVELS = 32u;

// Of the level in bounds and entries: the level, its flags (below), and the copy of the scene above them. The functions
// that compare two bodies' levels are for bodies of one copy.
CONSTANT uint LEVEL_BITS = 0x1Fu;
CONSTANT uint COPY_SHIFT = 10u;
CONSTANT uint COPY_BITS = 0xFFFFFC00u;
CONSTANT uint MOST_COPIES = 0x400000u;

// The lowest level whose cells are 1% wider than `extent`: the margin covers rounding of positions up to 80,000 cells
// away.
LAW uint level_of(float extent, float inverse_cell) {
    float cells = extent * inverse_cell * 1.01f;
    uint bits = floatBitsToUint(cells);
    uint level = (bits >> 23) - 127u + choose((bits & 0x7FFFFFu) != 0u, 1u, 0u);
    level = choose(level < LEVELS - 1u, level, LEVELS - 1u);
    return choose(cells <= 1.0f, 0u, level);
}

LAW float inverse_width_at(uint level, float inverse_cell) {
    return inverse_cell * uintBitsToFloat((127u - level) << 23);  // times 2^-level
}
LAW ivec3 cell_at(vec3 point, uint level, float inverse_cell) {
    vec3 scaled = point * inverse_width_at(level, inverse_cell);
    vec3 far = vec3(1.0e9f);  // far away bodies share a cell, whose index must fit an int
    scaled = larger3(smaller3(scaled, far), -far);
    return ivec3(whole(scaled.x), whole(scaled.y), whole(scaled.z));
}
LAW ivec3 cell_of(vec3 lower, vec3 upper, uint level, float inverse_cell) {
    return cell_at((lower + upper) * 0.5f, level, inverse_cell);
}
// The hash bucket of a cell: consecutive along x; rows by a multiplicative hash (Teschner et al. 2003, with other
// primes and one more mix). `level`: with the copy.
LAW uint bucket_of(ivec3 cell, uint level, uint buckets) {
    uint row = uint(cell.y) * 0x9E3779B1u ^ uint(cell.z) * 0x85EBCA77u ^ level * 0xC2B2AE3Du;
    row = (row ^ (row >> 15)) * 0x2C1B3C6Du;
    return (uint(cell.x) + (row ^ (row >> 13))) & (buckets - 1u);
}

LAW bool is_large(BodyProperties properties) {
    return (properties.flags & ROW_LARGE) != 0u;
}
// Rows that collide with nothing are in no bucket.
LAW bool is_apart(BodyProperties properties) {
    return (properties.flags & ROW_APART) != 0u;
}

// Level of rows that are not in the grid: bodies whose parts alone collide, and absent bodies.
CONSTANT uint NOT_IN_GRID = 0x40u;

// Swept AABB over the step: the shape, half the speculative distance (a pair's margin has the smaller of two), and the
// unobstructed motion, gravity and forces included. `bend`: curvature of a part's path (bend_of_way); 0 for bodies.
LAW Bounds bounds_of(BodyProperties properties, float bend, Pose pose, Velocity velocity, BodyForces load,
                     Parameters parameters) {
    vec3 half_size = half_extents_of(properties, pose.orientation);
    bool plane = properties.shape == SHAPE_PLANE, moves = in_motion(velocity);
    bool turns = moves && !plane && properties.shape != SHAPE_SPHERE;
    if (!none(turns)) {
        float reach = bounding_radius(properties);
        // Rotation extends the AABB by at most the arc, and never beyond the bounding sphere.
        float arc = length3(velocity.angular) * parameters.dt * reach;
        half_size = choose(turns, smaller3(half_size + vec3(arc), larger3(half_size, vec3(reach))), half_size);
    }
    half_size = choose(plane, vec3(1.0e30f), half_size) + vec3(0.5f * speculative_of(properties, parameters));
    half_size = choose(moves && is_part(properties), half_size + vec3(bend), half_size);
    vec3 way = velocity.linear * parameters.dt;
    Bounds bounds;
    bounds.lower = pose.position - half_size + smaller3(way, vec3(0.0f));
    bounds.upper = pose.position + half_size + larger3(way, vec3(0.0f));
    vec3 fall = way + shortened(load.acceleration * (parameters.dt * parameters.dt), length3(way));
    bounds.lower = smaller3(bounds.lower, pose.position - half_size + fall);
    bounds.upper = larger3(bounds.upper, pose.position + half_size + fall);
    // A fast body may rebound within the step, and one that did in the last substep has not returned all of its impact
    // (restitution.h) to what is behind it.
    bool fast = will_be_fast(properties, velocity, parameters);
    if (!none(fast)) {
        vec3 back = velocity.linear * larger(parameters.h, properties.restitution * parameters.dt);
        bounds.lower = choose(fast, smaller3(bounds.lower, pose.position - half_size - back), bounds.lower);
        bounds.upper = choose(fast, larger3(bounds.upper, pose.position + half_size - back), bounds.upper);
    }
    bounds.level = 0u;
    bounds.bucket = parameters.buckets;
    bounds.sweep = sweep_of(pose);
    bool listed = !is_large(properties);
    if (!none(listed)) {
        vec3 extent = bounds.upper - bounds.lower;
        uint level = level_of(larger(extent.x, larger(extent.y, extent.z)), parameters.inverse_cell);
        uint bucket = bucket_of(cell_of(bounds.lower, bounds.upper, level, parameters.inverse_cell), level, parameters.buckets);
        bounds.level = choose(listed, level, bounds.level);
        bounds.bucket = choose(listed, bucket, bounds.bucket);
    }
    bounds.level = choose(properties.shape == SHAPE_NONE, NOT_IN_GRID, bounds.level);
    return bounds;
}

#ifndef SCREE_LANES  // the rest has branches

LAW float power_of_two(int exponent) {
    return uintBitsToFloat(uint(exponent + 127) << 23);
}
// The cells in which a body of that level can have its centre if its AABB overlaps this one: half a cell outside at
// most.
struct CellRange {
    ivec3 first;
    ivec3 last;
};
LAW CellRange cells_in_reach(vec3 lower, vec3 upper, uint level, Parameters parameters) {
    vec3 reach = vec3(0.5f * parameters.cell * power_of_two(int(level)));
    CellRange range;
    range.first = cell_at(lower - reach, level, parameters.inverse_cell);
    range.last = cell_at(upper + reach, level, parameters.inverse_cell);
    return range;
}

// The images of a body in a periodic cell whose bounds may overlap those of bodies of that level: periods along each axis. The
// centres of bodies are within the periodic cell, those of parts at most a quarter of the period from their body's
// (compute/scene/validation/periodic_validation.cpp), and bounds reach from there by the width of a grid cell of their level.
struct ImageRange {
    ivec3 first;
    ivec3 last;
};
LAW ImageRange images_in_reach(vec3 lower, vec3 upper, uint level, Parameters parameters) {
    vec3 reach = vec3(parameters.cell * power_of_two(int(level)));
    reach = reach + absolute3(parameters.period * parameters.cell_rate) * parameters.dt;
    if (parameters.first_part < parameters.bodies) reach = reach + parameters.half_period * 0.5f;
    vec3 low = (parameters.cell_centre - parameters.half_period) + reach,
         high = (parameters.cell_centre + parameters.half_period) - reach;
    ImageRange range;
    range.first = ivec3(upper.x >= high.x ? -1 : 0, upper.y >= high.y ? -1 : 0, upper.z >= high.z ? -1 : 0);
    range.last = ivec3(lower.x <= low.x ? 1 : 0, lower.y <= low.y ? 1 : 0, lower.z <= low.z ? 1 : 0);
    return range;
}
LAW ivec3 next_image(ivec3 at, ImageRange images) {
    ++at.x;
    if (at.x <= images.last.x) return at;
    at.x = images.first.x;
    ++at.y;
    if (at.y <= images.last.y) return at;
    at.y = images.first.y;
    ++at.z;
    return at;
}
// Bounds at an image, with its way in the step.
LAW vec3 lower_at_image(vec3 lower, Image image, Parameters parameters) {
    return lower + image.shift + smaller3(image.velocity * parameters.dt, vec3(0.0f));
}
LAW vec3 upper_at_image(vec3 upper, Image image, Parameters parameters) {
    return upper + image.shift + larger3(image.velocity * parameters.dt, vec3(0.0f));
}
LAW vec3 middle_of(vec3 lower, vec3 upper) {
    return (lower + upper) * 0.5f;
}
// Whether the image of a body at those periods is its nearest to another, whose bounds' middle is `apart` from the body's own: of
// wide bodies several images may overlap, of which one counts.
LAW bool is_nearest_image(vec3 periods, vec3 apart, Parameters parameters) {
    vec3 nearest = -periods_to_nearest(apart, parameters);
    return nearest.x == periods.x && nearest.y == periods.y && nearest.z == periods.z;
}

// Bounds of an absent body: in no bucket.
LAW Bounds no_bounds(Pose pose) {
    Bounds bounds;
    bounds.lower = pose.position;
    bounds.upper = pose.position;
    bounds.level = NOT_IN_GRID;
    bounds.bucket = NONE;
    bounds.sweep = sweep_of(pose);
    return bounds;
}

LAW bool boxes_overlap(vec3 lower_a, vec3 upper_a, vec3 lower_b, vec3 upper_b) {
    return lower_a.x <= upper_b.x && lower_b.x <= upper_a.x && lower_a.y <= upper_b.y && lower_b.y <= upper_a.y &&
           lower_a.z <= upper_b.z && lower_b.z <= upper_a.z;
}

// Whether an AABB reaches a plane: its deepest corner is not in front of the plane.
LAW bool reaches_plane(vec3 lower, vec3 upper, vec3 normal, vec3 point) {
    vec3 corner =
        vec3(normal.x > 0.0f ? lower.x : upper.x, normal.y > 0.0f ? lower.y : upper.y, normal.z > 0.0f ? lower.z : upper.z);
    return dot3(corner - point, normal) <= 0.0f;
}

// The bounds of a body in a copy of the scene: of a row that is in a bucket.
LAW Bounds of_copy(Bounds bounds, uint copy, Parameters parameters) {
    uint level = bounds.level & LEVEL_BITS;
    bounds.level = bounds.level | (copy << COPY_SHIFT);
    bounds.bucket = bounds.bucket == parameters.buckets
                        ? parameters.buckets + copy
                        : bucket_of(cell_of(bounds.lower, bounds.upper, level, parameters.inverse_cell),
                                    level | (copy << COPY_SHIFT), parameters.buckets);
    return bounds;
}

// The owner of a pair of grid bodies: the one on the finer level, on equal levels the lower id. `body` and `other` are
// ids, because rows in memory may be permuted.
LAW bool owns_pair(uint body, uint level, uint other, uint other_level) {
    return level < other_level || (level == other_level && body < other);
}

// Flag in the level of a body's bounds: the body is inactive in this step (sleep.h).
CONSTANT uint INACTIVE = 0x100u;

// Flag in the level of a cell's entry: the body is dynamic, or a part of one that is.
CONSTANT uint MOVES = 0x200u;
LAW uint level_of_entry(uint level, BodyProperties properties) {
    return motion_of(properties) == MOTION_DYNAMIC ? level | MOVES : level;
}

// Ownership when one body may be inactive: an active body finds inactive ones on its own and coarser levels; an
// inactive body finds active ones on coarser levels, because no body searches finer levels. Pairs of inactive bodies
// are not searched for.
LAW bool finds(uint body, uint level, uint other, uint other_level) {
    bool still = (level & INACTIVE) != 0u, other_still = (other_level & INACTIVE) != 0u;
    if (still) return !other_still && level - INACTIVE < other_level;
    return other_still ? level <= other_level - INACTIVE : owns_pair(body, level, other, other_level);
}
// The same for the list of large bodies.
LAW bool finds_large(uint body, uint level, bool large, uint other, uint other_level) {
    bool other_still = (other_level & INACTIVE) != 0u;
    if ((level & INACTIVE) != 0u) return !large && !other_still;
    return !large || other_still || body < other;
}
// Bit mask of the levels a body must search.
LAW uint levels_to_search(uint level, Counts counts) {
    if ((level & NOT_IN_GRID) != 0u) return 0u;
    uint own = level & LEVEL_BITS;
    if ((level & INACTIVE) != 0u) return counts.levels_stirring & ~((2u << own) - 1u);
    return counts.levels & ~((1u << own) - 1u);
}

LAW bool can_touch(BodyProperties a, BodyProperties b) {
    bool moves = motion_of(a) == MOTION_DYNAMIC || motion_of(b) == MOTION_DYNAMIC;
    return moves && (a.shape != SHAPE_PLANE || b.shape != SHAPE_PLANE) && a.owner != b.owner;
}

LAW uint pair_type_of(uint shape_a, uint shape_b) {
    uint low = shape_a < shape_b ? shape_a : shape_b;
    uint high = shape_a < shape_b ? shape_b : shape_a;
    if (high == SHAPE_TRIANGLE) return low == SHAPE_SPHERE ? PAIR_SPHERE_TRIANGLE : PAIR_CONVEX_TRIANGLE;
    if (low == SHAPE_HULL) return PAIR_HULL_HULL;
    if (is_general_convex(high)) return low == SHAPE_PLANE ? PAIR_PLANE_CONVEX : PAIR_CONVEX;
    return low == SHAPE_SPHERE ? high : (low == SHAPE_CAPSULE ? 3u + high : 5u + high);
}

#endif

LAWS_END

#endif
