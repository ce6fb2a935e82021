// The compiled shaders, embedded in the program.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::shaders {

// SPIR-V words of a shader: "count_pairs" for stages/count_pairs.comp or the variant of that name, "count_pairs.bda"
// with tables reached by buffer device address, "count_pairs.texels" and "count_pairs.bda.texels" with read-only
// tables as texel buffers, "box.vert" for render/box.vert. Empty if unknown, and without SCREE_VULKAN.
std::span<const std::uint32_t> find(std::string_view name);

// Value of the specialisation constant VARIANT (stages/lib/features.glsl) for the stage of that name; similar stages
// share a module.
std::uint32_t variant_of(std::string_view name);

// OpenGL ES GLSL of a shader of render/, by file name. Empty if unknown.
std::string_view find_es(std::string_view name);

// Names of all SPIR-V shaders, stages first.
std::vector<std::string_view> names();

}  // namespace scree::shaders
