// Reference stages of bonds: what they change of their bodies' velocities, and whether they break.
#include "shaders/physics/bond/bond.h"

#include "compute/cpu/images.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/body/quarantine.h"

namespace scree::reference {

namespace {

void write_bond_change(State& state, std::size_t place, const physics::Velocity& change, float holds) {
    float* const words = &state.bond_changes[physics::BOND_WORDS * place];
    for (int k = 0; k < 3; ++k) {
        words[k] = change.linear[k];
        words[3 + k] = change.angular[k];
    }
    words[6] = holds;
}

void pull_bond(State& state, std::size_t i) {
    const physics::Bond& bond = state.bonds[i];
    physics::VelocityPair change{};
    bool holds = state.bond_states[i] == 0;
    if (holds) {
        const MetBody b = as_met(state, bond.a, bond.b);
        const physics::BondPull found = physics::pull_of_bond(
            bond, state.poses[bond.a], b.pose, {state.velocities[bond.a], b.velocity}, physics::whole_mass(state.masses[bond.a]),
            physics::whole_mass(state.masses[bond.b]), state.fixed());
        holds = !physics::is_out_of_play(state.properties[bond.a].motion) &&
                !physics::is_out_of_play(state.properties[bond.b].motion) && !physics::bond_breaks(found, bond);
        if (holds)
            change = found.change;
        else
            state.bond_states[i] = 1;
    }
    write_bond_change(state, bond.place_a, change.a, holds ? 1.0f : 0.0f);
    write_bond_change(state, bond.place_b, change.b, holds ? 1.0f : 0.0f);
}

void take_changes(State& state, std::uint32_t row) {
    const std::uint32_t id = state.id_of(row);
    if (id >= state.fixed().bonded) return;
    const std::uint32_t first = id > 0 ? state.bond_ends[id - 1] : 0, last = state.bond_ends[id];
    if (first >= last) return;
    physics::vec3 linear(0), angular(0);
    float holding = 0;
    for (std::uint32_t k = first; k < last; ++k) {
        const float* const words = &state.bond_changes[physics::BOND_WORDS * k];
        linear += physics::vec3(words[0], words[1], words[2]);
        angular += physics::vec3(words[3], words[4], words[5]);
        holding += words[6];
    }
    physics::Velocity& velocity = state.velocities[row];
    velocity.linear = physics::flush_tiny(velocity.linear + linear);
    velocity.angular = physics::flush_tiny(velocity.angular + angular);
    if (holding > 0) state.sleep_states[row] = 0;
}

}  // namespace

void pull_bonds(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().bonds, [&](std::size_t i) { pull_bond(state, i); });
}

void take_bonds(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::vector<std::uint32_t>& bodies = state.scratch.movable_bodies;
    threads.for_each(bodies.size(), [&](std::size_t k) { take_changes(state, bodies[k]); });
}

}  // namespace scree::reference
