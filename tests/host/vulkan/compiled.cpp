// Compiles compute shaders of tests like those of the project.
#include "tests/host/vulkan/compiled.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>

#include "host/files/file.h"
#include "tests/temporary_folder.h"

namespace scree::tests {

std::vector<std::uint32_t> compiled(const std::string& body, const std::string& options) {
    const TemporaryFolder folder;
    const std::filesystem::path source = folder.path() / "test.comp", output = folder.path() / "test.spv";
    host::write_atomically(source, "#version 460\n" + body);
    const std::string command = "glslc -O0 " + options + " -o " + output.string() + " " + source.string();
    REQUIRE(std::system(command.c_str()) == 0);
    const std::string bytes = host::read_text(output);
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

bool is_valid(const std::vector<std::uint32_t>& words, const std::string& environment) {
    if (std::system("spirv-val --version > /dev/null 2>&1") != 0) {
        WARN("spirv-val is not installed (package spirv-tools): not checked");
        return true;
    }
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "test.spv";
    host::write_atomically(file, std::as_bytes(std::span(words)));
    return std::system(("spirv-val --target-env " + environment + " " + file.string()).c_str()) == 0;
}

}  // namespace scree::tests
