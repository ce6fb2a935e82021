// Memory layouts in a compiled shader: member offsets, array strides, bindings of blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scree::house {

inline constexpr std::uint32_t no_binding = 0xFFFFFFFF;

struct MemberLayout {
    std::string name;
    std::size_t offset = 0;  // bytes
    std::string element;     // of an array: name of the element type; else empty
    std::size_t stride = 0;  // of an array, bytes
};
struct StructLayout {
    std::string name;
    bool is_block = false;
    std::uint32_t binding = no_binding;  // binding of the block's variable
    std::vector<MemberLayout> members;
};
struct ArrayLayout {
    std::string element;            // name of a struct, or "uint", "float", "vec4", ...
    std::size_t element_bytes = 0;  // of a scalar or vector, else 0
    std::size_t stride = 0;         // bytes
};
struct Layout {
    std::vector<StructLayout> structs;  // structs in buffers
    std::vector<ArrayLayout> arrays;    // likewise
};

Layout layout_of(std::span<const std::uint32_t> words);

}  // namespace scree::house
