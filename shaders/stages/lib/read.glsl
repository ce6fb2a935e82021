// READ(table, i): record i of a table that the stage does not write, or that only its own thread writes afterwards.
//
// With SCREE_TEXELS it comes from a texel buffer over the same memory. lavapipe reads each member of a record in a
// storage buffer thread by thread, but fetches the 16 bytes of a texel at once: a fifth of the time.
#ifndef SCREE_STAGES_READ_GLSL
#define SCREE_STAGES_READ_GLSL

// Place of quad k of record i, of records one after the other.
#define SCREE_IN_TURN(quads, i, k) (quads) * (i) + (k)

#ifndef SCREE_TEXELS
#define READ(table, i) table.at[i]
#else
#define READ(table, i) read_##table(i)

#define SCREE_COUNT(index, name, block, record, length) +1
const int BUFFERS = 0 SCREE_BUFFERS(SCREE_COUNT);
// After the bindings of the buffers themselves.
#define SCREE_DECLARE_TEXELS(index, name, block, record, length) \
    layout(set = 0, binding = BUFFERS + index) uniform usamplerBuffer name##_texels;
SCREE_BUFFERS(SCREE_DECLARE_TEXELS)

#define SCREE_TEXEL(table, i) texelFetch(table##_texels, int(i))

// Readers that assemble each record from texels, generated from records.h at build.
#include "shaders/stages/lib/record_readers.glsl"

#define SCREE_READ(table, record) SCREE_READER_##record(table, SCREE_TEXEL, SCREE_IN_TURN)
// Tables that the threads of a fused stage write for each other.
#ifdef SCREE_FUSED_SOLVER
#include "shaders/stages/lib/read_coherent.glsl"
#define SCREE_READ_OF_SOLVER(table, record) SCREE_READER_##record(table, SCREE_COHERENT_TEXEL, SCREE_IN_TURN)
#else
#define SCREE_READ_OF_SOLVER SCREE_READ
#endif
#ifdef SCREE_FUSED_LISTS
#define SCREE_READ_OF_LISTS(table, record) \
    record read_##table(uint i) {          \
        return table.at[i];                \
    }
#else
#define SCREE_READ_OF_LISTS SCREE_READ
#endif
SCREE_READ_OF_LISTS(counts, Counts)
SCREE_READ(properties, BodyProperties)
SCREE_READ_OF_SOLVER(poses, Pose)
SCREE_READ_OF_SOLVER(velocities, Velocity)
SCREE_READ_OF_SOLVER(masses, BodyMass)
SCREE_READ_OF_SOLVER(forces, BodyForces)
SCREE_READ(bounds, Bounds)
SCREE_READ(cell_entries, CellEntry)
SCREE_READ(pairs, Pair)
SCREE_READ(manifolds, Manifold)
SCREE_READ(contacts, Contact)
SCREE_READ(contacts_before, Contact)
SCREE_READ_OF_SOLVER(slots, VelocityDelta)
SCREE_READ(candidates, Candidate)
#endif

#endif
