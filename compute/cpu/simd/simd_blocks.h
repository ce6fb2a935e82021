// Passes over blocks of joints of equal structure in SIMD: one block per lane.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compute/tables/block_shape.h"
#include "compute/tables/table_words.h"

namespace scree::reference {

constexpr int joint_rounds = 8, settling_round = 2;

// At most as many blocks as there are lanes; each moves. Lanes beyond `count` repeat the first block, and write nothing.
struct BlockGroup {
    BlockShape shape;
    std::size_t count = 0;
    std::uint32_t first_joint[most_equal_blocks], first_body[most_equal_blocks];
    bool struck[most_equal_blocks];     // a body has an impact in this substep
    bool unsettled[most_equal_blocks];  // result: an active set changed in the last round
};

// Bit-identical to the loops over single blocks in compute/cpu/joints.cpp. False, and nothing is written: a solution is not
// finite, and the blocks are to be solved singly.
struct WideBlockStages {
    std::size_t lanes;
    std::size_t (*bytes)(const BlockShape& shape);  // of room, aligned to 64 bytes
    bool (*solve)(const TableWords&, BlockGroup&, std::byte* room);
    // In the last substep without the stock that is taken of joints and what follows from it: normal sums and slots.
    bool (*relax)(const TableWords&, BlockGroup&, std::byte* room, bool last);
};

// Those of this processor for `blocks` blocks, with at most `most` lanes; null if single blocks are faster.
const WideBlockStages* wide_block_stages(std::size_t blocks, int most);

// compute/cpu/simd/simd_blocks.cpp compiled for baseline vectors, AVX2, and AVX-512.
extern const WideBlockStages wide_block_stages_4, wide_block_stages_8, wide_block_stages_16;

}  // namespace scree::reference
