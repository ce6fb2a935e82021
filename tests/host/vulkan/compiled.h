// Compiles compute shaders of tests like those of the project.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// A temporary folder, removed by the destructor.
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

// SPIR-V of a shader; `body` follows `#version 460`, `options` are passed to glslc.
std::vector<std::uint32_t> compiled(const std::string& body, const std::string& options = "--target-env=vulkan1.2");

// Whether spirv-val accepts the module; true with a warning where it is not installed.
bool is_valid(const std::vector<std::uint32_t>& words, const std::string& environment = "vulkan1.2");
