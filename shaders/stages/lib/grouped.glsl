// The tables in groups (shaders/physics/base/record_groups.h): READ_GROUPED(table, i) as READ; write_TABLE(i, record, members)
// writes the quads of a record that have one of the members, MEMBER_OF_Record_member or EVERY_MEMBER.
#ifndef SCREE_STAGES_GROUPED_GLSL
#define SCREE_STAGES_GROUPED_GLSL

#include "shaders/physics/base/record_groups.h"
// Readers and writers that assemble each record from quads, generated from records.h at build.
#include "shaders/stages/lib/record_readers.glsl"

#define SCREE_GROUPED(quads, i, k) place_in_groups(quads, i, k, GROUP_SHIFT)
#define READ_GROUPED(table, i) read_##table(i)

#ifdef SCREE_TEXELS
#define SCREE_GROUPED_QUAD SCREE_TEXEL
#else
#define SCREE_GROUPED_QUAD(table, i) table.at[i]
#endif
#if defined(SCREE_TEXELS) && defined(SCREE_FUSED_SOLVER)
#define SCREE_GROUPED_QUAD_OF_SOLVER SCREE_COHERENT_TEXEL
#else
#define SCREE_GROUPED_QUAD_OF_SOLVER SCREE_GROUPED_QUAD
#endif
// clang-format off
SCREE_READER_ContactImpulse(impulses, SCREE_GROUPED_QUAD_OF_SOLVER, SCREE_GROUPED)
SCREE_READER_ContactImpulse(impulses_before, SCREE_GROUPED_QUAD, SCREE_GROUPED)
SCREE_READER_ContactImpact(impacts, SCREE_GROUPED_QUAD_OF_SOLVER, SCREE_GROUPED)
SCREE_READER_ContactImpact(impacts_before, SCREE_GROUPED_QUAD, SCREE_GROUPED)
SCREE_READER_Constraint(constraints, SCREE_GROUPED_QUAD, SCREE_GROUPED)
SCREE_WRITER_ContactImpulse(impulses, SCREE_STORE, SCREE_GROUPED)
SCREE_WRITER_ContactImpact(impacts, SCREE_STORE, SCREE_GROUPED)
SCREE_WRITER_Constraint(constraints, SCREE_STORE, SCREE_GROUPED)
// clang-format on

#endif
