// What each bond changes of its bodies' velocities in a substep, and whether it breaks (shaders/physics/bond/bond.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/bond/bond.h"
#include "shaders/stages/lib/images.glsl"

void write_change(uint place, Velocity change, float holds) {
    uint first = BOND_WORDS * place;
    for (uint k = 0u; k < 3u; ++k) SET_FLOAT(bond_changes, first + k, change.linear[k]);
    for (uint k = 0u; k < 3u; ++k) SET_FLOAT(bond_changes, first + 3u + k, change.angular[k]);
    SET_FLOAT(bond_changes, first + 6u, holds);
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bonds || COUNTED.overflow != 0u) return;
    Bond bond = READ_QUADS(bonds, i);
    BondPull pull;
    pull.change.a = pull.change.b = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    float holds = 0.0f;
    if (READ_WORD(bond_states, i) == 0u) {
        VelocityPair v;
        v.a = READ(velocities, bond.a);
        v.b = READ(velocities, bond.b);
        Pose pose_b = READ(poses, bond.b);
        if (PERIODIC) {
            Image image = image_met(READ(properties, bond.a), bond.a, READ(properties, bond.b), bond.b);
            pose_b = at_image(pose_b, image);
            v.b = at_image(v.b, image);
        }
        BondPull found = pull_of_bond(bond, READ(poses, bond.a), pose_b, v, whole_mass(READ(masses, bond.a)),
                                      whole_mass(READ(masses, bond.b)), PARAMETERS);
        if (is_out_of_play(READ(properties, bond.a).motion) || is_out_of_play(READ(properties, bond.b).motion) ||
            bond_breaks(found, bond)) {
            WORD(bond_states, i) = 1u;
        } else {
            pull = found;
            holds = 1.0f;
        }
    }
    write_change(bond.place_a, pull.change.a, holds);
    write_change(bond.place_b, pull.change.b, holds);
}
