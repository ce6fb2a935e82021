// The example in README.md is the program that the tests build against the installed library.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// The first code block in a language, without its fence.
std::string first_block(const std::string& markdown, const std::string& language) {
    const std::string fence = "```" + language + "\n";
    const std::size_t begin = markdown.find(fence);
    if (begin == std::string::npos) return "";
    const std::size_t end = markdown.find("```", begin + fence.size());
    return markdown.substr(begin + fence.size(), end - begin - fence.size());
}

}  // namespace

TEST_CASE("house: the README's example is the consumer that is built and run", "[house]") {
    const std::filesystem::path root = SCREE_SOURCE_DIR;
    REQUIRE(first_block("a\n```sh\nls\n```\n```cpp\nint x;\n```\n", "cpp") == "int x;\n");
    REQUIRE(std::filesystem::exists(root / "README.md"));
    REQUIRE(first_block(text_of(root / "README.md"), "cpp") == text_of(root / "tests/consumer/main.cpp"));
}
