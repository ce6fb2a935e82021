// The source tree as text: its files, their code without comments, and the tokens of that code.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scree::house {

struct SourceFile {
    std::string path;  // from the root: "compute/scene.h"
    std::string text;
    bool in(const std::string& folder) const { return path.compare(0, folder.size(), folder) == 0; }
    bool ends_with(const std::string& ending) const;
};

// Every C++, GLSL, CMake and shell file of the rooms, sorted by path.
const std::vector<SourceFile>& source_files();
// The C++ and GLSL files.
std::vector<SourceFile> code_files();

// The text with comments (and string literals) replaced by blanks; newlines stay.
std::string without_comments(const std::string& text);
std::string without_comments_and_strings(const std::string& text);

struct Token {
    std::string text;  // an identifier, a number, or one punctuation character
    std::size_t line = 0;
    bool identifier() const;
    bool number() const;
};
// Tokens without preprocessor lines, except the replacement texts of #define.
std::vector<Token> tokens_of(const std::string& text);

struct Include {
    std::string path;
    bool quoted = false;
    std::size_t line = 0;
};
std::vector<Include> includes_of(const std::string& text);

// "compute/scene.h:12: what"
std::string at(const SourceFile& file, std::size_t line, const std::string& what);

}  // namespace scree::house
