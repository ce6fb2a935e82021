// A build tool: turns a compiled shader into a C++ array, with NoContraction on all its float arithmetic.
//     scree_embed_shader [--forbid-inexact] IN.spv OUT.cpp NAMESPACE SYMBOL SOURCE
#include <cstring>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "host/file.h"
#include "host/spirv.h"

namespace {

using namespace scree::host;

std::vector<std::uint32_t> read_words(const std::string& path) {
    const std::string bytes = read_text(path);
    if (bytes.size() % 4 != 0) throw SpirvError("not a SPIR-V module: " + std::to_string(bytes.size()) + " bytes");
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

std::string as_cpp(const std::vector<std::uint32_t>& words, const std::string& space, const std::string& symbol,
                   const std::string& source) {
    std::ostringstream out;
    out << "// Made from " << source << " when the project is built.\n#include <cstddef>\n#include <cstdint>\n\nnamespace "
        << space << " {\n"
        << "extern const std::uint32_t " << symbol << "[];\nextern const std::size_t " << symbol << "_size;\n"
        << "const std::size_t " << symbol << "_size = " << words.size() << ";\nconst std::uint32_t " << symbol << "[] = {";
    for (std::size_t i = 0; i < words.size(); ++i) out << (i % 12 == 0 ? "\n" : "") << words[i] << "u,";
    out << "\n};\n}\n";
    return out.str();
}

int embed(const std::vector<std::string>& arguments, bool forbid_inexact) {
    const std::vector<std::uint32_t> words = read_words(arguments[0]);
    const std::vector<std::string> inexact = forbid_inexact ? inexact_instructions(words) : std::vector<std::string>{};
    for (const std::string& instruction : inexact) {
        std::cerr << arguments[4] << ": " << instruction << ": its result differs between devices; spell it with + - *\n";
    }
    if (!inexact.empty()) return 1;
    write_atomically(arguments[1], as_cpp(without_lines(without_contraction(words)), arguments[2], arguments[3], arguments[4]));
    return 0;
}

}  // namespace

int main(int count, char** values) {
    std::vector<std::string> arguments(values + 1, values + count);
    const bool forbid_inexact = !arguments.empty() && arguments.front() == "--forbid-inexact";
    if (forbid_inexact) arguments.erase(arguments.begin());
    if (arguments.size() != 5) {
        std::cerr << "usage: scree_embed_shader [--forbid-inexact] IN.spv OUT.cpp NAMESPACE SYMBOL SOURCE\n";
        return 2;
    }
    try {
        return embed(arguments, forbid_inexact);
    } catch (const std::exception& error) {
        std::cerr << arguments[4] << ": " << error.what() << "\n";
        return 1;
    }
}
