// Adds to a body's velocity what its bonds change of it. A body with a bond that holds does not fall asleep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/bond/bond.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/ids.glsl"

vec3 three_of(uint first) {
    return vec3(READ_FLOAT(bond_changes, first), READ_FLOAT(bond_changes, first + 1u), READ_FLOAT(bond_changes, first + 2u));
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.first_part || COUNTED.overflow != 0u) return;
    if (!is_movable(READ(properties, i).motion, READ_WORD(sleep_states, i), PARAMETERS.sleep_steps)) return;
    uint id = id_of(i);
    if (id >= PARAMETERS.bonded) return;
    uint first = 0u, last = READ_WORD(bond_ends, id);
    if (id > 0u) first = READ_WORD(bond_ends, id - 1u);
    if (first >= last) return;
    vec3 linear = vec3(0.0f), angular = vec3(0.0f);
    float holding = 0.0f;
    for (uint k = first; k < last; ++k) {
        linear = linear + three_of(BOND_WORDS * k);
        angular = angular + three_of(BOND_WORDS * k + 3u);
        holding = holding + READ_FLOAT(bond_changes, BOND_WORDS * k + 6u);
    }
    Velocity velocity = READ(velocities, i);
    velocity.linear = flush_tiny(velocity.linear + linear);
    velocity.angular = flush_tiny(velocity.angular + angular);
    WRITE(velocities, i, velocity);
    if (holding > 0.0f) WORD(sleep_states, i) = 0u;
}
