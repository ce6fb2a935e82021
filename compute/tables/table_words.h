// The tables of a step as words, by their names: for SIMD lanes, which have record types of their own.
#pragma once

#include <cstdint>

#include "shaders/stages/lib/tables.h"

namespace scree {

struct TableWords {
    using uint = std::uint32_t;
#define SCREE_WORDS(buffer, name, block, record, length) uint* name;
    SCREE_RECORD_TABLES(SCREE_WORDS)
    SCREE_GROUPED_TABLES(SCREE_WORDS)
    SCREE_QUAD_TABLES(SCREE_WORDS)
    SCREE_WORDS(0, parameters, ParametersTable, Parameters, one)
#undef SCREE_WORDS
#define SCREE_WORDS(buffer, name, block, record, length) record* name;
    SCREE_WORD_TABLES(SCREE_WORDS)
#undef SCREE_WORDS
};

}  // namespace scree
