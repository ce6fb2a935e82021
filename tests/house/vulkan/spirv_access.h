// Buffer accesses of a compiled shader.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>

namespace scree::house {

struct BufferAccess {
    bool loads = false, stores = false, atomics = false;
};

struct Accesses {
    std::map<std::uint32_t, BufferAccess> of;  // by binding; with buffer addresses, by the member that holds the address
    // For tables in shared buffers: by the member of the parameters (binding 0) that holds the table's offset.
    std::map<std::uint32_t, BufferAccess> of_member;
    std::set<std::uint32_t> constants;  // SpecIds that the code uses
    std::uint32_t tested_bits = 0;      // bits of the constant with SpecId 1 that the code tests
};

// Accesses in code that is reachable when the constant with SpecId 3 is `variant`.
Accesses accesses_of(std::span<const std::uint32_t> words, std::uint32_t variant = 0);

}  // namespace scree::house
