// Broadphase: sorts the bodies of each bucket by id and copies their bounds.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/stages/lib/stage.glsl"

#define SORT_GET(i) cell_entries.at[i].body
#define SORT_SET(i, value) cell_entries.at[i].body = value
#include "shaders/stages/lib/sort.glsl"

void main() {
    uint i = thread();
    // After an overflow that memory holds contacts for the repetition (SCREE_SHARES).
    if (i >= buckets_in_all(PARAMETERS) || COUNTED.overflow != 0u) return;
    uint first = i == 0u ? 0u : READ_WORD(cell_ends, i - 1u);
    uint last = READ_WORD(cell_ends, i);
    sort_range(first, last - first);
    for (uint k = first; k < last; ++k) {
        uint body = cell_entries.at[k].body;
        Bounds around = READ(bounds, body);
        cell_entries.at[k].lower = around.lower;
        cell_entries.at[k].upper = around.upper;
        cell_entries.at[k].level = level_of_entry(around.level, READ(properties, body));
    }
}
