// What joint blocks of equal structure have in common.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree {

// A joint of a block, whose joints and bodies are numbered from 0. A tile is the part of the matrix between two joints, or of
// one; the tiles of a joint are its own and those of its links, one after the other.
struct JointShape {
    std::int32_t a, b;         // bodies of the block; -1: none that can move
    std::uint32_t first_tile;  // in the block
    std::uint32_t links;       // later joints whose equations its elimination changes
    std::uint32_t link[8];     // ascending
    std::int32_t ends[8];      // which bodies it shares with each: physics::shared_ends
    std::int32_t own_ends;
};

constexpr std::size_t most_equal_blocks = 16;  // solved at once

struct BlockShape {
    const JointShape* joint;
    std::uint32_t joints, bodies, tiles;
};

}  // namespace scree
