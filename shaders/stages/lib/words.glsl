// The tables of words (tables.h) in one buffer: WORD(table, i) to write, READ_WORD(table, i) of a table that the stage
// does not write, or that only its own thread writes afterwards; likewise for floats.
#ifndef SCREE_STAGES_WORDS_GLSL
#define SCREE_STAGES_WORDS_GLSL

#include "shaders/stages/lib/record_readers.glsl"

#define WORD(table, i) words.at[PARAMETERS.table##_offset + (i)]
#define SET_FLOAT(table, i, value) WORD(table, i) = floatBitsToUint(value)

// A fused stage reads what its own threads write, so not through texels.
#if defined(SCREE_TEXELS) && !defined(SCREE_FUSED_LISTS)
#define READ_WORD(table, i) texelFetch(words_texels, int(PARAMETERS.table##_offset + (i))).x
#else
#define READ_WORD(table, i) WORD(table, i)
#endif
#define READ_FLOAT(table, i) uintBitsToFloat(READ_WORD(table, i))

#endif
