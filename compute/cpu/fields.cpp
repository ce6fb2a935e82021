// Reference stage of fields: wind, water, attractors.
#include "shaders/physics/body/medium.h"

#include "compute/cpu/stages.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

void apply_fields(State& state, const Threads& threads, std::uint32_t) {
    const physics::Parameters& p = state.fixed();
    if (state.counted().overflow) return;
    const bool wet = p.air_density + p.water_density > 0;
    threads.for_each(p.first_part, [&](std::size_t i) {
        const physics::BodyProperties& body = state.properties[i];
        if (!physics::is_movable(body.motion, state.sleep_states[i], p.sleep_steps) || !state.is_owned(i)) return;
        const physics::Immersion immersion =
            wet ? state.immersions[state.id_of(static_cast<std::uint32_t>(i))] : physics::no_immersion();
        state.forces[i] = physics::with_fields(state.forces[i], body, immersion, state.poses[i], state.velocities[i],
                                               physics::mass_in_world(body, state.poses[i].orientation),
                                               parameters_of(state, static_cast<std::uint32_t>(i)));
    });
}

}  // namespace scree::reference
