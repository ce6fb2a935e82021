// Reference stages of fracture.
#include "shaders/physics/fracture/fracture.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/copies.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

// Calls visit(contact, side) for each slot that a contact has with a body, in order.
template <typename Visit>
void for_each_slot(const State& state, std::size_t body, const Visit& visit) {
    const auto first = state.slot_sides.begin() + state.first_slot_of(body);
    const auto last = state.slot_sides.begin() + state.slot_ends[body];
    std::for_each(first, last, [&](physics::uint slot) {
        if ((slot & physics::OF_JOINT) == 0) visit(std::size_t{slot / 2}, slot % 2);
    });
}

float integrate_position(const State& state, std::size_t contact) {
    return state.carried[contact];
}

bool some_broken(const State& state) {
    return state.counted().broken != 0 && state.counted().overflow == 0;
}

}  // namespace

void find_broken(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const physics::BodyProperties& body = state.properties[i];
        if (!physics::may_break(body) || !state.is_owned(i)) return;
        float blow = 0;
        for_each_slot(state, i,
                      [&](std::size_t contact, physics::uint) { blow = std::max(blow, integrate_position(state, contact)); });
        const physics::Fracturing fracturing = state.fractures[body.fracture];
        const float kept = physics::kept_part(fracturing, blow, state.strains[i]);
        state.strains[i] = physics::strain_after(fracturing, blow, body, state.velocities[i]);
        if (kept >= 1) return;
        state.forces[i].kept = kept;
        std::atomic_ref(state.counted().broken).fetch_add(1, std::memory_order_relaxed);
        if (state.has_copies())
            std::atomic_ref(state.copy_states[state.copy_of(static_cast<std::uint32_t>(i))]).fetch_or(physics::COPY_BREAKS);
    });
}

void return_excess_impulse(State& state, const Threads& threads, std::uint32_t) {
    if (!some_broken(state)) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        if (!physics::is_movable(state.properties[i].motion, state.sleep_states[i], state.fixed().sleep_steps) ||
            !state.is_owned(i))
            return;
        if (state.has_copies() && (state.copy_states[state.copy_of(static_cast<std::uint32_t>(i))] & physics::COPY_BREAKS) == 0)
            return;
        physics::Velocity velocity = state.velocities[i];
        for_each_slot(state, i, [&](std::size_t contact, physics::uint side) {
            const physics::Constraint& c = state.constraints[contact];
            const float kept = std::min(state.forces[c.a].kept, state.forces[c.b].kept);
            if (kept >= 1 || integrate_position(state, contact) <= 0) return;
            velocity = physics::given_back(velocity, physics::whole_mass(state.masses[i]), c, state.impulse(contact), side,
                                           integrate_position(state, contact) * (1 - kept));
        });
        state.velocities[i] = physics::clamp_velocity(velocity, state.fixed());
    });
}

void break_bodies(State& state, const Threads& threads, std::uint32_t) {
    if (!some_broken(state)) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        if (state.forces[i].kept >= 1) return;
        const physics::Fracturing fracturing = state.fractures[state.properties[i].fracture];
        for (physics::uint k = 0; k < fracturing.count; ++k) {
            const std::size_t row = fracturing.first_row + k;
            const physics::RigidState part =
                physics::piece_of(state.pieces[fracturing.first_pose + k], state.poses[i], state.velocities[i]);
            state.poses[row] = part.pose;
            state.velocities[row] = part.velocity;
            state.sleep_states[row] = 0;
            physics::BodyProperties& piece = state.properties[row];
            piece.motion = physics::MOTION_DYNAMIC;
            if (piece.fracture != physics::NONE)
                state.strains[row] = physics::strain_after(state.fractures[piece.fracture], 0, piece, part.velocity);
        }
        state.properties[i].motion = physics::MOTION_BROKEN;
        state.strains[i] = 0;
        state.sleep_states[i] = 0;
        state.velocities[i] = {};
    });
}

}  // namespace scree::reference
