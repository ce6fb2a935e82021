// Gives each contact a slot with each of its bodies that can be moved, and lists those that have one, in any order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts || !any_stirs(COUNTED)) return;
    Pair pair = READ(pairs, READ(constraints, i).pair);
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    bool moves_a = is_movable(READ(traits, of_a).motion, READ(rests, of_a), PARAMETERS.sleep_steps);
    bool moves_b = is_movable(READ(traits, of_b).motion, READ(rests, of_b), PARAMETERS.sleep_steps);
    if (moves_a) slot_sides.at[atomicAdd(slot_ends.at[of_a], 1u)] = 2u * i;
    if (moves_b) slot_sides.at[atomicAdd(slot_ends.at[of_b], 1u)] = 2u * i + 1u;
    if (!moves_a && !moves_b) return;
    uint place = atomicAdd(COUNTS.solved, 1u);
    binned.at[place] = i;
    uint group = place >> PARAMETERS.group_shift;
    if ((place & (PARAMETERS.group_size - 1u)) == 0u) atomicMax(COUNTS.arguments[WORK_SOLVED].x, group + 1u);
}
