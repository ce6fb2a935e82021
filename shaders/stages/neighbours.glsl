// The bodies whose bounds overlap those of one body and whose pairs it owns; each is handed to found(), which the stage defines.
#ifndef SCREE_STAGES_NEIGHBOURS_GLSL
#define SCREE_STAGES_NEIGHBOURS_GLSL

#include "shaders/physics/grid.h"

void look_through_large(uint body, Traits own, Bounds around) {
    for (uint k = cells[PARAMETERS.buckets - 1u]; k < cells[PARAMETERS.buckets]; ++k) {
        uint other = cell_entries[k].body;
        if (own.large != 0u && other <= body) continue;
        Traits theirs = traits[other];
        if (!can_touch(own, theirs)) continue;
        CellEntry entry = cell_entries[k];
        bool near;
        if (theirs.shape == SHAPE_PLANE)
            near = reaches_plane(around.lower, around.upper, theirs.size, poses[other].position);
        else if (own.shape == SHAPE_PLANE)
            near = reaches_plane(entry.lower, entry.upper, own.size, poses[body].position);
        else
            near = boxes_overlap(around.lower, around.upper, entry.lower, entry.upper);
        if (near) found(other);
    }
}

// Three cells along x are one run of buckets, which may wrap round the end of the grid's entries.
void look_through_row(uint body, Traits own, Bounds around, ivec3 middle, uint level) {
    uint low = bucket_of(middle - ivec3(1, 0, 0), level, PARAMETERS.buckets);
    uint high = bucket_of(middle + ivec3(1, 0, 0), level, PARAMETERS.buckets);
    uint end = cells[PARAMETERS.buckets - 1u];
    uint first = low == 0u ? 0u : cells[low - 1u];
    uint entries = low <= high ? cells[high] - first : end - first + cells[high];
    for (uint k = 0u; k < entries; ++k) {
        uint place = first + k < end ? first + k : first + k - end;
        CellEntry entry = cell_entries[place];
        if (entry.level != level || !owns_pair(body, around.level, entry.body, level)) continue;
        if (!boxes_overlap(around.lower, around.upper, entry.lower, entry.upper)) continue;
        ivec3 cell = cell_of(entry.lower, entry.upper, level, PARAMETERS.inverse_cell);
        if (cell.y != middle.y || cell.z != middle.z) continue;  // another row whose buckets happen to be the same
        if (can_touch(own, traits[entry.body])) found(entry.body);
    }
}

void look_around(uint body) {
    Traits own = traits[body];
    Bounds around = bounds[body];
    look_through_large(body, own, around);
    if (own.large != 0u) return;
    for (uint level = around.level; level < LEVELS && (COUNTS.levels >> level) != 0u; ++level) {
        if (((COUNTS.levels >> level) & 1u) == 0u) continue;
        ivec3 cell = cell_of(around.lower, around.upper, level, PARAMETERS.inverse_cell);
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y) look_through_row(body, own, around, cell + ivec3(0, y, z), level);
    }
}

#endif
