// Buffer accesses of a compiled shader.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <span>

namespace scree::house {

struct BufferAccess {
    bool loads = false, stores = false, atomics = false;
};

// A component of an array of vectors of four in the parameters (binding 0).
struct ArrayPlace {
    std::uint32_t member = 0, at = 0;
    auto operator<=>(const ArrayPlace&) const = default;
};

struct Accesses {
    std::map<std::uint32_t, BufferAccess> of;     // by binding; with buffer addresses, by the member that holds the address
    std::map<ArrayPlace, BufferAccess> of_place;  // of tables in shared buffers, by where their offset is
    std::set<std::uint32_t> constants;            // SpecIds that the code uses
    std::uint32_t tested_bits = 0;                // bits of the constant with SpecId 1 that the code tests
};

// Accesses in code that is reachable when the constant with SpecId 3 is `variant`.
Accesses accesses_of(std::span<const std::uint32_t> words, std::uint32_t variant = 0);

}  // namespace scree::house
