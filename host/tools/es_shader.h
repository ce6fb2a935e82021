// Translation of SPIR-V shaders to OpenGL ES 3.1 GLSL.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace scree::host {

// Bindings are unchanged. The push constant becomes the uniform `pushed`. Clip space depth is 0..w, as in Vulkan;
// define SCREE_WHOLE_DEPTH after the first line where the context has -w..w. Throws std::runtime_error.
std::string es_text_of(std::span<const std::uint32_t> words);

}  // namespace scree::host
