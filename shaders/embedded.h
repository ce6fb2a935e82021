// The compiled shaders, as words in the program.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::shaders {

// The SPIR-V of a shader: "count_pairs" for stages/count_pairs.comp or the variant of that name, "body.vert" for
// render/body.vert. Empty if there is none of that name.
std::span<const std::uint32_t> find(std::string_view name);

// All names, stages first.
std::vector<std::string_view> names();

}  // namespace scree::shaders
