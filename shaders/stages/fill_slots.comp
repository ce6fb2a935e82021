// Gives each contact a slot with each of its bodies that can be moved, and lists those that have one, in any order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts || !any_stirs(COUNTS)) return;
    Pair pair = pairs.at[constraints.at[i].pair];
    bool moves_a = is_movable(traits.at[pair.a].motion, rests.at[pair.a], PARAMETERS.sleep_steps);
    bool moves_b = is_movable(traits.at[pair.b].motion, rests.at[pair.b], PARAMETERS.sleep_steps);
    if (moves_a) slot_sides.at[atomicAdd(slot_ends.at[pair.a], 1u)] = 2u * i;
    if (moves_b) slot_sides.at[atomicAdd(slot_ends.at[pair.b], 1u)] = 2u * i + 1u;
    if (!moves_a && !moves_b) return;
    uint place = atomicAdd(COUNTS.solved, 1u);
    binned.at[place] = i;
    uint group = place >> PARAMETERS.group_shift;
    if ((place & (PARAMETERS.group_size - 1u)) == 0u) atomicMax(COUNTS.arguments[WORK_SOLVED].x, group + 1u);
}
