// The tables of words (tables.h), which share one buffer: WORD(table, i) to be changed, READ_WORD(table, i) of a table that the
// stage does not write, or of its own thread before it writes it; likewise of floats.
#ifndef SCREE_STAGES_WORDS_GLSL
#define SCREE_STAGES_WORDS_GLSL

// What a list is before it is what its table's name says (SCREE_VIEWS).
#define cell_counts_offset cell_ends_offset
#define cell_starts_offset cell_ends_offset
#define pair_counts_offset pair_starts_offset
#define slot_counts_offset slot_ends_offset
#define slot_starts_offset slot_ends_offset
#define pair_type_counts_offset pair_type_starts_offset

#define WORD(table, i) words.at[PARAMETERS.table##_offset + (i)]
#define SET_FLOAT(table, i, value) WORD(table, i) = floatBitsToUint(value)

// A fused stage reads what its threads write for each other.
#if defined(SCREE_TEXELS) && !defined(SCREE_FUSED_LISTS)
#define READ_WORD(table, i) texelFetch(words_texels, int(PARAMETERS.table##_offset + (i))).x
#else
#define READ_WORD(table, i) WORD(table, i)
#endif
#define READ_FLOAT(table, i) uintBitsToFloat(READ_WORD(table, i))

#endif
