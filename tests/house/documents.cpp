// The documents: pages are short, links lead somewhere, C++ stands in a test that is compiled, and JSON is a scene.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "tests/house/pages.h"
#include "tests/house/tree.h"

namespace {

using namespace scree::house;

std::string without_spaces(const std::string& text) {
    std::string kept;
    for (const char c : text)
        if (std::isspace(static_cast<unsigned char>(c)) == 0) kept += c;
    return kept;
}

std::string first_block(const Page& page, const std::string& language) {
    for (const Block& block : page.blocks)
        if (block.language == language) return block.text;
    return "";
}

// What is wrong with a link of a page; "" if nothing.
std::string fault_of(const Page& page, const std::string& link) {
    if (link.find("://") != std::string::npos) return "";
    const std::size_t mark = link.find('#');
    const std::string path = link.substr(0, mark);
    const std::filesystem::path target = path.empty() ? page.path : (page.path.parent_path() / path).lexically_normal();
    if (!std::filesystem::exists(root() / target)) return link + ": there is no " + target.generic_string();
    if (mark == std::string::npos || target.extension() != ".md") return "";
    const std::vector<std::string> anchors = page_of(target).anchors;
    const bool found = std::find(anchors.begin(), anchors.end(), link.substr(mark + 1)) != anchors.end();
    return found ? "" : link + ": " + target.generic_string() + " has no such heading";
}

}  // namespace

TEST_CASE("house: a page is read as text, headings, links and blocks", "[house]") {
    const Page page = read_page("a.md",
                                "# One `a/b`: two, three\n\nwords [here](b.md#c) and `[not](there)`\n```sh\nls [x](y)\n```\n"
                                "<!-- table -->\n| three more words |\n<!-- end of table -->\n## Two\n## Two\nend\n");
    CHECK(page.words == 5 + 4 + 4 + 3 + 4 + 1);
    CHECK(page.anchors == std::vector<std::string>{"one-ab-two-three", "two", "two-1"});
    CHECK(page.links == std::vector<std::string>{"b.md#c"});
    REQUIRE(page.blocks.size() == 1);
    CHECK(page.blocks[0].language == "sh");
    CHECK(page.blocks[0].text == "ls [x](y)\n");
}

TEST_CASE("house: README has at most 1,500 words and every other page 1,200", "[house]") {
    REQUIRE(pages().size() > 40);
    for (const Page& page : pages()) {
        INFO(page.path << " has " << page.words << " words, printed tables not counted");
        CHECK(page.words <= (page.path == "README.md" ? 1500u : 1200u));
    }
}

TEST_CASE("house: every link of every page leads to a file and a heading", "[house]") {
    std::size_t links = 0;
    for (const Page& page : pages()) {
        for (const std::string& link : page.links) {
            ++links;
            INFO(page.path);
            CHECK(fault_of(page, link) == "");
        }
    }
    REQUIRE(links > 150);
    Page page = page_of("README.md");
    CHECK(fault_of(page, "demos/docs/nowhere.md") != "");
    CHECK(fault_of(page, "tests/README.md#nowhere") != "");
    CHECK(fault_of(page, "tests/README.md#rules") == "");
}

TEST_CASE("house: every page of the book is in its contents", "[house]") {
    const Page contents = page_of("demos/docs/README.md");
    for (const Page& page : pages()) {
        const std::string path = page.path.generic_string(), folder = "demos/docs/";
        if (path.rfind(folder, 0) != 0 || page.path == contents.path) continue;
        INFO(path);
        CHECK(std::count(contents.links.begin(), contents.links.end(), path.substr(folder.size())) == 1);
    }
}

TEST_CASE("house: the README's example is the consumer that is built and run", "[house]") {
    REQUIRE(first_block(page_of("README.md"), "cpp") == text_of("tests/consumer/main.cpp"));
}

TEST_CASE("house: every C++ block of a page stands in a test that is compiled", "[house]") {
    std::vector<std::string> tests;
    for (const SourceFile& file : source_files())
        if (file.in("tests/") && file.ends_with(".cpp")) tests.push_back(without_spaces(file.text));
    std::size_t blocks = 0;
    for (const Page& page : pages()) {
        for (const Block& block : page.blocks) {
            if (block.language != "cpp") continue;
            ++blocks;
            INFO(page.path << ":\n" << block.text);
            const std::string text = without_spaces(block.text);
            CHECK(std::any_of(tests.begin(), tests.end(),
                              [&](const std::string& test) { return test.find(text) != std::string::npos; }));
        }
    }
    REQUIRE(blocks > 10);
}

TEST_CASE("house: every JSON block of a page is a scene", "[house]") {
    std::size_t blocks = 0;
    for (const Page& page : pages()) {
        for (const Block& block : page.blocks) {
            if (block.language != "json") continue;
            ++blocks;
            INFO(page.path << ":\n" << block.text);
            const scree::SceneDocument document = scree::scene_from_json(block.text);
            // A mesh's file is not beside the page.
            if (block.text.find("\"file\"") == std::string::npos) CHECK_NOTHROW(scree::checked(document.scene));
        }
    }
    REQUIRE(blocks > 8);
}
