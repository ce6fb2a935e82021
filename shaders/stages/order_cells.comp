// Sorts the bodies of each bucket by id and copies their bounds beside them.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i > PARAMETERS.buckets) return;
    uint first = i == 0u ? 0u : cells[i - 1u];
    uint last = cells[i];
    for (uint k = first + 1u; k < last; ++k) {
        uint body = cell_entries[k].body;
        uint hole = k;
        for (; hole > first && cell_entries[hole - 1u].body > body; --hole)
            cell_entries[hole].body = cell_entries[hole - 1u].body;
        cell_entries[hole].body = body;
    }
    for (uint k = first; k < last; ++k) {
        Bounds around = bounds[cell_entries[k].body];
        cell_entries[k].lower = around.lower;
        cell_entries[k].upper = around.upper;
        cell_entries[k].level = around.level;
    }
}
