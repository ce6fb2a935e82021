// Resets the counts of a step, sets every body's gravity, and wakes all bodies on request.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/motion.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/copies.glsl"

void main() {
    uint i = thread();
    if (i <= buckets_in_all(PARAMETERS)) WORD(cell_counts, i) = 0u;
    if (COPIES && i < PARAMETERS.copies) WORD(copy_states, i) = 0u;
    if (i <= PARAMETERS.bodies) {
        WORD(pair_counts, i) = 0u;
        WORD(slot_counts, i) = 0u;
    }
    if (i < PARAMETERS.bodies) {
        BodyProperties body = READ(properties, i);
        if (GRAVITIES)
            WRITE(forces, i, gravity_forces(body, parameters_of(body.owner)));
        else
            WRITE(forces, i, gravity_forces(body, PARAMETERS));
        // No branch on wake_all: lavapipe would compile the shader anew in each step, specialised for its value.
        uint state = WORD(sleep_states, i);
        WORD(sleep_states, i) = choose(PARAMETERS.wake_all != 0u, roused(state, PARAMETERS.sleep_steps), state);
    }
    // Rows by different threads: a software device repeats what a single thread does for every vector of threads.
    Counts empty = emptied(COUNTS, PARAMETERS);
    if (i < PAIR_TYPES + 1u) COUNTS.pair_type_first[i] = 0u;
    if (i < WORKS) COUNTS.arguments[i] = empty_work(i, PARAMETERS);
    if (i > 0u) return;
    COUNTS.pairs = empty.pairs;
    COUNTS.contacts = empty.contacts;
    COUNTS.levels = empty.levels;
    COUNTS.levels_stirring = empty.levels_stirring;
    COUNTS.large_stirring = empty.large_stirring;
    COUNTS.sleepers = empty.sleepers;
    COUNTS.solver_contacts = empty.solver_contacts;
    COUNTS.pairs_coarse = empty.pairs_coarse;
    COUNTS.fast = empty.fast;
    COUNTS.broken = empty.broken;
}
