// Compiles compute shaders of tests like those of the project.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scree::tests {

// SPIR-V of a shader; `body` follows `#version 460`, `options` are passed to glslc.
std::vector<std::uint32_t> compiled(const std::string& body, const std::string& options = "--target-env=vulkan1.2");

// Whether spirv-val accepts the module; true with a warning where it is not installed.
bool is_valid(const std::vector<std::uint32_t>& words, const std::string& environment = "vulkan1.2");

}  // namespace scree::tests
