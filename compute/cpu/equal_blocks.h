// Blocks of joints of equal structure, which a pass of the reference runner solves together, one per SIMD lane
// (compute/cpu/simd/simd_blocks.h), in the bits of single blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compute/cpu/simd/simd_blocks.h"
#include "compute/tables/state.h"

namespace scree::reference {

class EqualBlocks {
public:
    // Takes the next blocks that move, as many as fit the lanes, from the list of blocks by structure (JointGroups) at `at`
    // and before `last`; returns where the next ones begin.
    std::size_t take(State& state, std::size_t at, std::size_t last, int lanes);
    std::span<const std::uint32_t> blocks() const { return blocks_; }

    // A pass; false if the blocks are to be solved singly: they are few, or a solution is not finite. In the last substep
    // without the stock that is taken of joints, and what follows from it.
    bool solve(State& state);
    bool relax(State& state, bool last);

private:
    TableWords begin(State& state);
    void end(State& state) const;

    std::vector<std::uint32_t> blocks_;
    const WideBlockStages* stages_ = nullptr;
    BlockGroup group_;
    std::vector<std::byte> bytes_;
    std::byte* room_ = nullptr;
};

}  // namespace scree::reference
