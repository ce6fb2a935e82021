// The hash of a checkpoint.
#pragma once

#include <cstddef>
#include <span>

namespace scree {

// Writes the hash of its bytes, with their number, into a checkpoint's head, by which damage is known. `state`: at least a head.
void seal_checkpoint(std::span<std::byte> state);

}  // namespace scree
