// Finding the blocks of joints that wait for ghosts.
#include "compute/distributed/border.h"

#include <algorithm>
#include <span>

namespace scree {

void Border::find(State& state) {
    const std::span solved = std::span(state.contacts_to_solve).first(state.counted().solver_contacts);
    const std::span at_border = solved.subspan(state.inner_contacts);
    state.border_blocks.clear();
    const std::uint32_t blocks = state.fixed().joint_blocks;
    if (blocks == 0 || at_border.empty()) return;
    touches_ghost_.assign(state.fixed().first_part, false);
    for (const std::uint32_t contact : at_border)
        for (const std::uint32_t row : {state.contacts[contact].a, state.contacts[contact].b})
            touches_ghost_[state.body_of(row)] = true;
    state.border_blocks.resize(blocks);
    for (std::uint32_t i = 0; i < blocks; ++i) {
        const physics::JointBlock& block = state.joint_blocks[i];
        const std::span members = std::span(state.block_bodies).subspan(block.first_body, block.bodies);
        state.border_blocks[i] =
            std::any_of(members.begin(), members.end(), [&](const auto& member) { return touches_ghost_[member.body]; });
    }
}

}  // namespace scree
