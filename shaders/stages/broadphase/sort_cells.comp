// Broadphase: sorts the bodies of each bucket by id and copies their bounds.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_SORTS_TOGETHER
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/stages/lib/stage.glsl"

#define SORT_KEY(i) uvec2(0u, cell_entries.at[i].body)
#define SORT_SET(i, key) cell_entries.at[i].body = (key).y
#include "shaders/stages/lib/sort.glsl"

uvec2 entries_of(uint bucket) {
    uint first = bucket == 0u ? 0u : READ_WORD(cell_ends, bucket - 1u);
    return uvec2(first, READ_WORD(cell_ends, bucket) - first);
}

void copy_bounds(uint entry) {
    uint body = cell_entries.at[entry].body;
    Bounds around = READ(bounds, body);
    cell_entries.at[entry].lower = around.lower;
    cell_entries.at[entry].upper = around.upper;
    cell_entries.at[entry].level = level_of_entry(around.level, READ(properties, body));
}

void sort_bucket(uint bucket) {
    // After an overflow that memory holds contacts for the repetition (SCREE_SHARES).
    if (bucket >= buckets_in_all(PARAMETERS) || COUNTED.overflow != 0u) return;
    uvec2 own = entries_of(bucket);
    if (own.y > SHORT_RANGE) {
        note_long_range(bucket);
        return;
    }
    sort_range(own.x, own.y);
    if (own.y == 0u) return;
    uint k = own.x;
    do copy_bounds(k);
    while (++k < own.x + own.y);
}

void main() {
    begin_long_ranges();
    sort_bucket(thread());
    uint noted = long_ranges_noted();
    for (uint i = 0u; i < noted; ++i) {
        uvec2 own = entries_of(long_range[i]);
        sort_range_together(own.x, own.y);
#define SCREE_COPY(t) \
    if ((t) < own.y) copy_bounds(own.x + (t));
        FOR_FOUR(t, own.y, SCREE_COPY)
#undef SCREE_COPY
    }
}
