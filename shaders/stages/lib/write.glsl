// WRITE(table, i, record): record i of a table, whole. SCREE_STORE(table, place, quad): 16 bytes of a table in groups.
//
// With SCREE_TEXELS in words of 64 bits, of the same memory: lavapipe writes a storage buffer thread by thread and word by word.
#ifndef SCREE_STAGES_WRITE_GLSL
#define SCREE_STAGES_WRITE_GLSL

const uint EVERY_MEMBER = 0xFFFFFFFFu;

#ifndef SCREE_TEXELS
#define WRITE(table, i, record) table.at[i] = record
#define SCREE_STORE(table, place, quad) table.at[place] = quad
#else
#extension GL_ARB_gpu_shader_int64 : require
#define WRITE(table, i, record) write_##table(i, record, EVERY_MEMBER)

#ifdef SCREE_BDA
#define SCREE_DECLARE_LONG(index, name, block, record, length)                                     \
    layout(std430, buffer_reference, buffer_reference_align = 16) SCREE_SHARED buffer name##Long { \
        u64vec2 at[];                                                                              \
    };
#define SCREE_LONG(table) table##Long(table)
#else
#define SCREE_DECLARE_LONG(index, name, block, record, length)                 \
    layout(std430, set = 0, binding = index) SCREE_SHARED buffer block##Long { \
        u64vec2 at[];                                                          \
    }                                                                          \
    name##_long;
#define SCREE_LONG(table) table##_long
#endif
SCREE_WIDE_TABLES(SCREE_DECLARE_LONG)

u64vec2 long_words(uvec4 quad) {
    return u64vec2(packUint2x32(uvec2(quad.x, quad.y)), packUint2x32(uvec2(quad.z, quad.w)));
}
#define SCREE_STORE(table, place, quad) SCREE_LONG(table).at[place] = long_words(quad)

// Writers that take each record apart, generated from records.h at build.
#include "shaders/stages/lib/record_readers.glsl"

// clang-format off
SCREE_WRITER_Pose(poses, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_Velocity(velocities, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_BodyMass(masses, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_BodyForces(forces, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_Bounds(bounds, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_Pair(pairs, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_Manifold(manifolds, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_Contact(contacts, SCREE_STORE, SCREE_IN_TURN)
SCREE_WRITER_VelocityDelta(slots, SCREE_STORE, SCREE_IN_TURN)
// clang-format on
#endif

#endif
