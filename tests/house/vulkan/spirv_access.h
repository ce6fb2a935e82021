// Which buffers the code of a shader reads and writes, and by what instructions.
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
    std::map<std::uint32_t, BufferAccess> of;  // by binding; of a buffer found by its address, the member that holds it
    // Of a table that shares its buffer: by the member of the parameters (binding 0) that says where it begins.
    std::map<std::uint32_t, BufferAccess> of_member;
    std::set<std::uint32_t> constants;  // SpecId of those that the code uses
    std::uint32_t tested_bits = 0;      // of the constant with SpecId 1, those that it is masked with
};

// Of what is reached when the constant with SpecId 3 is `variant`.
Accesses accesses_of(std::span<const std::uint32_t> words, std::uint32_t variant = 0);

}  // namespace scree::house
