// Compute shaders written inside a test, compiled as the project compiles its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// A folder that goes with the object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

// The SPIR-V of a shader after `#version 460`, by glslc with these options besides.
std::vector<std::uint32_t> compiled(const std::string& body, const std::string& options = "--target-env=vulkan1.2");

// Whether spirv-val takes it; true with a warning where it is not installed.
bool is_valid(const std::vector<std::uint32_t>& words, const std::string& environment = "vulkan1.2");
