// Finding the contacts and joints that need ghosts.
#include "compute/distributed/border.h"

#include <algorithm>

namespace scree {

void Border::find(State& state) {
    const auto first = state.contacts_to_solve.begin(), last = first + state.counted().solver_contacts;
    const auto is_ghost = [&](std::uint32_t row) { return state.presence[row] == Presence::ghost; };
    border_contacts_.clear();
    const auto inner_end = std::remove_if(first, last, [&](std::uint32_t contact) {
        const physics::Constraint& c = state.constraints[contact];
        if (!is_ghost(c.a) && !is_ghost(c.b)) return false;
        border_contacts_.push_back(contact);
        return true;
    });
    std::copy(border_contacts_.begin(), border_contacts_.end(), inner_end);
    inner_contacts_ = static_cast<std::uint32_t>(inner_end - first);
    state.border_blocks.clear();
    const std::uint32_t blocks = state.fixed().joint_blocks;
    if (blocks == 0 || border_contacts_.empty()) return;
    touches_ghost_.assign(state.fixed().first_part, false);
    for (const std::uint32_t contact : border_contacts_)
        for (const std::uint32_t row : {state.constraints[contact].a, state.constraints[contact].b}) touches_ghost_[row] = true;
    state.border_blocks.resize(blocks);
    for (std::uint32_t i = 0; i < blocks; ++i) {
        const physics::JointBlock& block = state.joint_blocks[i];
        const std::span members = std::span(state.block_bodies).subspan(block.first_body, block.bodies);
        state.border_blocks[i] =
            std::any_of(members.begin(), members.end(), [&](const auto& member) { return touches_ghost_[member.body]; });
    }
}

}  // namespace scree
