// The Markdown pages of the tree: words, headings, links and code blocks.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::house {

struct Block {
    std::string language;  // "cpp"
    std::string text;      // without its fences
};

struct Page {
    std::filesystem::path path;  // from the root
    std::string text;
    std::size_t words = 0;  // but for tables that a program prints: from <!-- NAME --> to <!-- end of NAME --> or the end
    std::vector<std::string> anchors;  // of headings, as GitHub makes them
    std::vector<std::string> links;    // targets as written, outside code
    std::vector<std::string> spans;    // inline code
    std::vector<Block> blocks;
};

std::filesystem::path root();
std::string text_of(const std::filesystem::path& path);  // from the root
Page read_page(const std::filesystem::path& path, const std::string& text);
Page page_of(const std::filesystem::path& path);
// Every page of the tree, sorted by path.
const std::vector<Page>& pages();

}  // namespace scree::house
