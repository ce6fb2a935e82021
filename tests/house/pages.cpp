// Reads Markdown, as far as the house's pages use it.
#include "tests/house/pages.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace scree::house {

namespace {

std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) != 0 || letter >= 128 || c == '_' || c == '-') {
            anchor += static_cast<char>(std::tolower(letter));
        } else if (c == ' ') {
            anchor += '-';
        }
    }
    return anchor;
}

std::size_t words_of(const std::string& line) {
    std::istringstream words(line);
    std::size_t count = 0;
    for (std::string word; words >> word;) ++count;
    return count;
}

// Links and inline code of a line outside blocks.
void read_line(const std::string& line, Page& page) {
    static const std::regex span("`([^`]+)`"), link("\\]\\(([^)\\s]+)\\)");
    for (std::sregex_iterator each(line.begin(), line.end(), span), end; each != end; ++each) page.spans.push_back((*each)[1]);
    const std::string plain = std::regex_replace(line, span, "");
    for (std::sregex_iterator each(plain.begin(), plain.end(), link), end; each != end; ++each) page.links.push_back((*each)[1]);
}

}  // namespace

std::filesystem::path root() {
    return SCREE_SOURCE_DIR;
}

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(root() / path).rdbuf();
    return text.str();
}

Page read_page(const std::filesystem::path& path, const std::string& text) {
    Page page{.path = path, .text = text};
    std::map<std::string, int> used;
    bool in_block = false, printed = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!printed) page.words += words_of(line);
        if (line.rfind("```", 0) == 0) {
            in_block = !in_block;
            if (in_block) page.blocks.push_back({line.substr(3), ""});
        } else if (in_block) {
            page.blocks.back().text += line + "\n";
        } else if (line.rfind("<!-- ", 0) == 0) {
            printed = line.rfind("<!-- end of ", 0) != 0;
        } else {
            static const std::regex heading("#+ (.*)");
            if (std::smatch match; std::regex_match(line, match, heading)) {
                const std::string anchor = anchor_of(match[1]);
                const int before = used[anchor]++;
                page.anchors.push_back(before == 0 ? anchor : anchor + "-" + std::to_string(before));
            }
            read_line(line, page);
        }
    }
    return page;
}

Page page_of(const std::filesystem::path& path) {
    return read_page(path, text_of(path));
}

const std::vector<Page>& pages() {
    static const std::vector<Page> all = [] {
        std::vector<Page> found{page_of("README.md")};
        for (const char* room : {".github", "shaders", "host", "compute", "demos", "tests"}) {
            for (const auto& entry : std::filesystem::recursive_directory_iterator(root() / room)) {
                if (entry.path().extension() == ".md") found.push_back(page_of(entry.path().lexically_relative(root())));
            }
        }
        std::sort(found.begin(), found.end(), [](const Page& a, const Page& b) { return a.path < b.path; });
        return found;
    }();
    return all;
}

}  // namespace scree::house
