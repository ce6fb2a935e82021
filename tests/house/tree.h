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

// Every file of C++, GLSL, CMake and shell in the rooms, in the order of their paths.
const std::vector<SourceFile>& source_files();
// Those of C++ and GLSL.
std::vector<SourceFile> code_files();

// The text with comments blanked out (newlines stay), and with strings blanked out as well.
std::string without_comments(const std::string& text);
std::string without_comments_and_strings(const std::string& text);

struct Token {
    std::string text;  // an identifier, a number, or one sign
    std::size_t line = 0;
    bool identifier() const;
    bool number() const;
};
// Preprocessor lines are left out, but for what #define defines.
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
