// A build tool: makes a compiled shader ready to be embedded, with NoContraction on all its float arithmetic.
//     scree_embed_shader [--forbid-inexact] IN.spv OUT SOURCE
#include <cstring>
#include <exception>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "host/files/file.h"
#include "host/spirv/spirv.h"

namespace {

using namespace scree::host;

std::vector<std::uint32_t> read_words(const std::string& path) {
    const std::string bytes = read_text(path);
    if (bytes.size() % 4 != 0) throw SpirvError("not a SPIR-V module: " + std::to_string(bytes.size()) + " bytes");
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

int embed(const std::vector<std::string>& arguments, bool forbid_inexact) {
    const std::vector<std::uint32_t> words = read_words(arguments[0]);
    const std::vector<std::string> inexact = forbid_inexact ? inexact_instructions(words) : std::vector<std::string>{};
    for (const std::string& instruction : inexact) {
        std::cerr << arguments[2] << ": " << instruction << ": its result differs between devices; spell it with + - *\n";
    }
    if (!inexact.empty()) return 1;
    const std::vector<std::uint32_t> ready = without_lines(without_contraction(words));
    write_atomically(arguments[1], std::as_bytes(std::span(ready)));
    return 0;
}

}  // namespace

int main(int count, char** values) {
    std::vector<std::string> arguments(values + 1, values + count);
    const bool forbid_inexact = !arguments.empty() && arguments.front() == "--forbid-inexact";
    if (forbid_inexact) arguments.erase(arguments.begin());
    if (arguments.size() != 3) {
        std::cerr << "usage: scree_embed_shader [--forbid-inexact] IN.spv OUT SOURCE\n";
        return 2;
    }
    try {
        return embed(arguments, forbid_inexact);
    } catch (const std::exception& error) {
        std::cerr << arguments[2] << ": " << error.what() << "\n";
        return 1;
    }
}
