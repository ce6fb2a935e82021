// Blocks of joints of equal structure, solved together.
#include "compute/cpu/equal_blocks.h"

#include <memory>

#include "compute/cpu/joint_block.h"

namespace scree::reference {

static_assert(physics::JOINT_ROUNDS == joint_rounds && physics::SETTLING_ROUND == settling_round);

std::size_t EqualBlocks::take(State& state, std::size_t at, std::size_t last, int lanes) {
    const JointGroups& groups = state.joint_groups;
    const WideBlockStages* const widest = wide_block_stages(most_equal_blocks, lanes);
    const std::size_t most = widest ? widest->lanes : most_equal_blocks;
    const std::uint32_t group = groups.group_of[at];
    blocks_.clear();
    for (; at < last && groups.group_of[at] == group && blocks_.size() < most; ++at) {
        const std::uint32_t block = groups.blocks[at];
        if (state.passes_block(block) && state.owns_block(state.joint_blocks[block]) && JointBlock(state, block).moves())
            blocks_.push_back(block);
    }
    stages_ = wide_block_stages(blocks_.size(), lanes);
    group_.shape = groups.shape(groups.groups[group]);
    return at;
}

TableWords EqualBlocks::begin(State& state) {
    group_.count = blocks_.size();
    for (std::size_t lane = 0; lane < most_equal_blocks; ++lane) {
        const physics::JointBlock& block = state.joint_blocks[blocks_[lane < group_.count ? lane : 0]];
        group_.first_joint[lane] = block.first_joint;
        group_.first_body[lane] = block.first_body;
    }
    constexpr std::size_t alignment = 64;
    std::size_t room = stages_->bytes(group_.shape) + alignment;
    if (bytes_.size() < room) bytes_.resize(room);
    void* aligned = bytes_.data();
    room_ = static_cast<std::byte*>(std::align(alignment, room - alignment, aligned, room));
    return state.words();
}
void EqualBlocks::end(State& state) const {
    for (std::size_t lane = 0; lane < group_.count; ++lane) state.joint_blocks[blocks_[lane]].unsettled = group_.unsettled[lane];
}

bool EqualBlocks::solve(State& state) {
    if (!stages_) return false;
    const TableWords tables = begin(state);
    if (!stages_->solve(tables, group_, room_)) return false;
    end(state);
    return true;
}

bool EqualBlocks::relax(State& state, bool last) {
    if (!stages_) return false;
    for (std::size_t lane = 0; lane < most_equal_blocks; ++lane)
        group_.struck[lane] = JointBlock(state, blocks_[lane < blocks_.size() ? lane : 0]).struck();
    const TableWords tables = begin(state);
    if (!stages_->relax(tables, group_, room_, last)) return false;
    end(state);
    return true;
}

}  // namespace scree::reference
