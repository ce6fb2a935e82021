// The compiled shaders, embedded in the program.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::shaders {

// The SPIR-V of a shader: "count_pairs" for stages/broadphase/count_pairs.comp or the variant of that name; "count_pairs.bda"
// with tables by buffer device address; "count_pairs.texels" and "count_pairs.bda.texels" with read-only tables as texels;
// "box.vert" for render/bodies/box.vert. Empty for an unknown name, and without SCREE_VULKAN.
std::span<const std::uint32_t> find(std::string_view name);

// The specialisation constant VARIANT (stages/lib/features.glsl) for the stage of that name: similar stages share a
// module.
std::uint32_t variant_of(std::string_view name);

// A shader of render/ as GLSL of OpenGL ES 3.1. Empty for an unknown name.
std::string_view find_es(std::string_view name);

// Names of all SPIR-V shaders, stages first.
std::vector<std::string_view> names();

}  // namespace scree::shaders
