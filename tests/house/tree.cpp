// Reads the source tree and tokenises its files.
#include "tests/house/tree.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace scree::house {

namespace {

std::vector<SourceFile> read_tree() {
    const std::filesystem::path root = SCREE_SOURCE_DIR;
    const std::vector<std::string> endings = {".h", ".cpp", ".comp", ".vert", ".frag", ".glsl", ".py", ".sh", "CMakeLists.txt"};
    std::vector<SourceFile> files;
    for (const char* room : {"shaders", "host", "compute", "demos", "tests"}) {
        if (!std::filesystem::exists(root / room)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / room)) {
            if (!entry.is_regular_file()) continue;
            SourceFile file{entry.path().lexically_relative(root).generic_string(), ""};
            if (std::none_of(endings.begin(), endings.end(), [&](const std::string& ending) { return file.ends_with(ending); })) {
                continue;
            }
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            file.text = text.str();
            files.push_back(std::move(file));
        }
    }
    std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

bool starts_word(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool in_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// End of the string, character or raw string literal that begins at `i`; `i` if there is none.
std::size_t end_of_quote(const std::string& text, std::size_t i) {
    const char quote = text[i];
    if (quote != '"' && quote != '\'') return i;
    if (quote == '\'' && i > 0 && in_word(text[i - 1])) return i;  // 1'000
    if (quote == '"' && i > 0 && text[i - 1] == 'R' && (i < 2 || !in_word(text[i - 2]))) {
        const std::size_t bracket = text.find('(', i);
        const std::size_t end = text.find(")" + text.substr(i + 1, bracket - i - 1) + "\"", bracket);
        return end == std::string::npos ? text.size() : end + bracket - i + 1;
    }
    std::size_t end = i + 1;
    while (end < text.size() && text[end] != quote && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
}

std::string blanked(const std::string& text, bool strings_too) {
    std::string result = text;
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) {
            if (result[k] != '\n') result[k] = ' ';
        }
    };
    std::size_t i = 0;
    while (i < text.size()) {
        std::size_t end = i;
        if (text.compare(i, 2, "//") == 0) {
            end = std::min(text.find('\n', i), text.size());
            blank(i, end);
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t close = text.find("*/", i + 2);
            end = close == std::string::npos ? text.size() : close + 2;
            blank(i, end);
        } else {
            end = end_of_quote(text, i);
            if (strings_too && end > i + 1) blank(i + 1, end - 1);
        }
        i = std::max(end, i + 1);
    }
    return result;
}

}  // namespace

bool SourceFile::ends_with(const std::string& ending) const {
    return path.size() >= ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

const std::vector<SourceFile>& source_files() {
    static const std::vector<SourceFile> files = read_tree();
    return files;
}

std::vector<SourceFile> code_files() {
    std::vector<SourceFile> files;
    for (const SourceFile& file : source_files()) {
        for (const char* ending : {".h", ".cpp", ".comp", ".vert", ".frag", ".glsl"}) {
            if (file.ends_with(ending)) files.push_back(file);
        }
    }
    return files;
}

std::string without_comments(const std::string& text) {
    return blanked(text, false);
}
std::string without_comments_and_strings(const std::string& text) {
    return blanked(text, true);
}

bool Token::identifier() const {
    return starts_word(text[0]);
}
bool Token::number() const {
    return std::isdigit(static_cast<unsigned char>(text[0])) != 0 || (text[0] == '.' && text.size() > 1);
}

std::vector<Token> tokens_of(const std::string& text) {
    const std::string code =
        std::regex_replace(without_comments_and_strings(text), std::regex("#[ \t]*(include|version|extension|pragma)[^\n]*"), "");
    std::vector<Token> tokens;
    std::size_t line = 1, i = 0;
    while (i < code.size()) {
        const auto digit = [&](std::size_t k) {
            return k < code.size() && std::isdigit(static_cast<unsigned char>(code[k])) != 0;
        };
        std::size_t end = i + 1;
        if (code[i] == '\n') ++line;
        if (starts_word(code[i])) {
            while (end < code.size() && in_word(code[end])) ++end;
        } else if (digit(i) || (code[i] == '.' && digit(i + 1))) {
            const bool hexadecimal = code.compare(i, 2, "0x") == 0 || code.compare(i, 2, "0X") == 0;
            const auto exponent_sign = [&] {
                return (code[end] == '+' || code[end] == '-') && !hexadecimal && (code[end - 1] == 'e' || code[end - 1] == 'E');
            };
            while (end < code.size() && (in_word(code[end]) || code[end] == '.' || exponent_sign())) ++end;
        }
        if (std::isspace(static_cast<unsigned char>(code[i])) == 0) tokens.push_back({code.substr(i, end - i), line});
        i = end;
    }
    return tokens;
}

std::vector<Include> includes_of(const std::string& text) {
    static const std::regex pattern("^[ \t]*#[ \t]*include[ \t]*([\"<])([^\">]+)[\">]");
    std::vector<Include> includes;
    std::istringstream lines(without_comments(text));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch match;
        if (std::regex_search(line, match, pattern)) includes.push_back({match[2], match[1] == "\"", number});
    }
    return includes;
}

std::string at(const SourceFile& file, std::size_t line, const std::string& what) {
    return file.path + ":" + std::to_string(line) + ": " + what;
}

}  // namespace scree::house
