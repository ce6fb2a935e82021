// READ(table, i): record i of a table that the stage does not write, or of its own thread before it writes it.
//
// With SCREE_TEXELS it comes from a texel buffer over the same memory. lavapipe walks through the threads of a vector one by one
// for each member of a record in a storage buffer, and takes 16 bytes of a texel at once: a fifth of the time.
#ifndef SCREE_STAGES_READ_GLSL
#define SCREE_STAGES_READ_GLSL

#include "shaders/physics/base/arithmetic.h"

#ifndef SCREE_TEXELS
#define READ(table, i) table.at[i]
#else
#define READ(table, i) read_##table(i)

#define SCREE_COUNT(index, name, block, record, length) +1
const int BUFFERS = 0 SCREE_BUFFERS(SCREE_COUNT);
// After the bindings of the tables themselves.
#define SCREE_DECLARE_TEXELS(index, name, block, record, length) \
    layout(set = 0, binding = BUFFERS + index) uniform usamplerBuffer name##_texels;
SCREE_BUFFERS(SCREE_DECLARE_TEXELS)

vec4 floats_at(usamplerBuffer texels, uint i) {
    return uintBitsToFloat(texelFetch(texels, int(i)));
}

Traits traits_in(usamplerBuffer texels, uint i) {
    vec4 size = floats_at(texels, 5u * i);
    vec4 inertia = floats_at(texels, 5u * i + 1u);
    vec4 material = floats_at(texels, 5u * i + 2u);
    uvec4 motion = texelFetch(texels, int(5u * i + 3u));
    uvec4 relations = texelFetch(texels, int(5u * i + 4u));
    return Traits(xyz(size), floatBitsToUint(size.w), xyz(inertia), inertia.w, material.x, material.y, material.z, material.w,
                  uintBitsToFloat(motion.x), uintBitsToFloat(motion.y), motion.z, motion.w, relations.x, relations.y, relations.z,
                  relations.w);
}
Pose pose_in(usamplerBuffer texels, uint i) {
    vec4 position = floats_at(texels, 2u * i);
    return Pose(xyz(position), position.w, floats_at(texels, 2u * i + 1u));
}
Velocity velocity_in(usamplerBuffer texels, uint i) {
    vec4 linear = floats_at(texels, 2u * i), angular = floats_at(texels, 2u * i + 1u);
    return Velocity(xyz(linear), linear.w, xyz(angular), angular.w);
}
Mass mass_in(usamplerBuffer texels, uint i) {
    vec4 first = floats_at(texels, 2u * i), second = floats_at(texels, 2u * i + 1u);
    return Mass(first.x, first.y, first.z, first.w, second.x, second.y, second.z, second.w);
}
Load load_in(usamplerBuffer texels, uint i) {
    vec4 linear = floats_at(texels, 2u * i), angular = floats_at(texels, 2u * i + 1u);
    return Load(xyz(linear), linear.w, xyz(angular), angular.w);
}
Bounds bounds_in(usamplerBuffer texels, uint i) {
    vec4 lower = floats_at(texels, 5u * i), upper = floats_at(texels, 5u * i + 1u);
    vec4 position = floats_at(texels, 5u * i + 2u), orientation = floats_at(texels, 5u * i + 3u);
    uvec4 stops = texelFetch(texels, int(5u * i + 4u));
    return Bounds(xyz(lower), floatBitsToUint(lower.w), xyz(upper), floatBitsToUint(upper.w),
                  Flight(xyz(position), position.w, orientation, uint[2](stops.x, stops.y), stops.z, stops.w));
}
CellEntry cell_entry_in(usamplerBuffer texels, uint i) {
    vec4 lower = floats_at(texels, 2u * i), upper = floats_at(texels, 2u * i + 1u);
    return CellEntry(xyz(lower), floatBitsToUint(lower.w), xyz(upper), floatBitsToUint(upper.w));
}
Candidate candidate_in(usamplerBuffer texels, uint i) {
    uvec4 both = texelFetch(texels, int(i));
    return Candidate(both.x, both.y);
}
Pair pair_in(usamplerBuffer texels, uint i) {
    uvec4 pair = texelFetch(texels, int(i));
    return Pair(pair.x, pair.y, pair.z, pair.w);
}
Manifold manifold_in(usamplerBuffer texels, uint i) {
    vec4 normal = floats_at(texels, 5u * i);
    return Manifold(xyz(normal), floatBitsToUint(normal.w),
                    vec4[4](floats_at(texels, 5u * i + 1u), floats_at(texels, 5u * i + 2u), floats_at(texels, 5u * i + 3u),
                            floats_at(texels, 5u * i + 4u)));
}
Contact contact_in(usamplerBuffer texels, uint i) {
    uvec4 sides = texelFetch(texels, int(9u * i));
    vec4 normal = floats_at(texels, 9u * i + 1u), d = floats_at(texels, 9u * i + 2u);
    return Contact(sides.x, sides.y, sides.z, sides.w, xyz(normal), floatBitsToUint(normal.w), xyz(d), d.w,
                   vec4[4](floats_at(texels, 9u * i + 3u), floats_at(texels, 9u * i + 4u), floats_at(texels, 9u * i + 5u),
                           floats_at(texels, 9u * i + 6u)),
                   floats_at(texels, 9u * i + 7u), floats_at(texels, 9u * i + 8u));
}
Impulse impulse_in(usamplerBuffer texels, uint i) {
    vec4 friction = floats_at(texels, 6u * i + 3u), rolling = floats_at(texels, 6u * i + 4u), d = floats_at(texels, 6u * i + 5u);
    return Impulse(floats_at(texels, 6u * i), floats_at(texels, 6u * i + 1u), floats_at(texels, 6u * i + 2u), xyz(friction),
                   friction.w, xyz(rolling), rolling.w, xyz(d), d.w);
}
Constraint constraint_in(usamplerBuffer texels, uint i) {
    uvec4 sides = texelFetch(texels, int(9u * i)), last = texelFetch(texels, int(9u * i + 8u));
    vec4 normal = floats_at(texels, 9u * i + 1u), centre = floats_at(texels, 9u * i + 6u);
    uvec4 pair = texelFetch(texels, int(9u * i + 7u));
    return Constraint(sides.x, sides.y, sides.z, sides.w, xyz(normal), normal.w,
                      vec4[4](floats_at(texels, 9u * i + 2u), floats_at(texels, 9u * i + 3u), floats_at(texels, 9u * i + 4u),
                              floats_at(texels, 9u * i + 5u)),
                      xyz(centre), centre.w, uintBitsToFloat(pair.x), uintBitsToFloat(pair.y), pair.z, pair.w,
                      uintBitsToFloat(last.x), uintBitsToFloat(last.y), last.z, uintBitsToFloat(last.w));
}
Slot slot_in(usamplerBuffer texels, uint i) {
    vec4 linear = floats_at(texels, 2u * i), angular = floats_at(texels, 2u * i + 1u);
    return Slot(xyz(linear), linear.w, xyz(angular), angular.w);
}
Counts counts_in(usamplerBuffer texels, uint i) {
    uvec4 a = texelFetch(texels, 0), b = texelFetch(texels, 1), c = texelFetch(texels, 2), d = texelFetch(texels, 8);
    Counts counts;
    counts.pairs = a.x;
    counts.contacts = a.y;
    counts.levels = a.z;
    counts.overflow = a.w;
    counts.required_pairs = b.x;
    counts.required_contacts = b.y;
    counts.steps = b.z;
    counts.pairs_coarse = b.w;
    counts.levels_stirring = c.x;
    counts.large_stirring = c.y;
    counts.sleepers = c.z;
    counts.solved = c.w;
    for (int k = 0; k < 5; ++k) {
        uvec4 four = texelFetch(texels, 3 + k);
        counts.kind_first[4 * k] = four.x;
        counts.kind_first[4 * k + 1] = four.y;
        counts.kind_first[4 * k + 2] = four.z;
        counts.kind_first[4 * k + 3] = four.w;
    }
    counts.fast = d.x;
    counts.broken = d.y;
    return counts;
}

#define SCREE_READ(table, record, reader) \
    record read_##table(uint i) {         \
        return reader(table##_texels, i); \
    }
// What the threads of a fused stage write for each other.
#ifdef SCREE_FUSED_SOLVER
#define SCREE_READ_OF_SOLVER(table, record, reader)
#include "shaders/stages/lib/read_coherent.glsl"
#else
#define SCREE_READ_OF_SOLVER SCREE_READ
#endif
#ifdef SCREE_FUSED_LISTS
#define SCREE_READ_OF_LISTS(table, record, reader) \
    record read_##table(uint i) {                  \
        return table.at[i];                        \
    }
#else
#define SCREE_READ_OF_LISTS SCREE_READ
#endif
SCREE_READ_OF_LISTS(counts, Counts, counts_in)
SCREE_READ(traits, Traits, traits_in)
SCREE_READ_OF_SOLVER(poses, Pose, pose_in)
SCREE_READ_OF_SOLVER(velocities, Velocity, velocity_in)
SCREE_READ_OF_SOLVER(masses, Mass, mass_in)
SCREE_READ_OF_SOLVER(loads, Load, load_in)
SCREE_READ(bounds, Bounds, bounds_in)
SCREE_READ(cell_entries, CellEntry, cell_entry_in)
SCREE_READ(pairs, Pair, pair_in)
SCREE_READ(manifolds, Manifold, manifold_in)
SCREE_READ(contacts_before, Contact, contact_in)
SCREE_READ_OF_SOLVER(impulses, Impulse, impulse_in)
SCREE_READ(impulses_before, Impulse, impulse_in)
SCREE_READ_OF_LISTS(constraints, Constraint, constraint_in)
SCREE_READ_OF_SOLVER(slots, Slot, slot_in)
SCREE_READ(candidates, Candidate, candidate_in)
#endif

#endif
