// The command line of this process.
#include "demos/program/console.h"

#include <algorithm>
#include <cctype>

#include "host/system/machine.h"

namespace scree::demos {

namespace {

std::string in_quotes(const std::string& word) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) || std::string_view("_-./:,=+@%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace

std::string words_of_this_program() {
    std::string text;
    for (const std::string& word : host::own_words()) text += (text.empty() ? "" : " ") + in_quotes(word);
    return text;
}

}  // namespace scree::demos
