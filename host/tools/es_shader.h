// Compiled shaders turned into GLSL of OpenGL ES 3.1.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace scree::host {

// Bindings stay as they are. The push constant becomes the uniform `pushed`. Depth in clip space runs from 0 to w, as in Vulkan;
// for contexts where it runs from -w to w, SCREE_WHOLE_DEPTH is defined behind the first line. Throws std::runtime_error.
std::string es_text_of(std::span<const std::uint32_t> words);

}  // namespace scree::host
