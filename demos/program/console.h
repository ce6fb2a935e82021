// Messages on the standard error output.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace scree::demos {

// Escapes control characters but line feeds as \xNN, since names may contain terminal control sequences.
inline std::string printable(const std::string& text) {
    std::string shown;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        shown += (code < 0x20 && c != '\n') || code == 0x7f ? fmt::format("\\x{:02x}", code) : std::string(1, c);
    }
    return shown;
}

// The command line of this process, quoted where a shell would need it; empty where the system does not tell.
std::string words_of_this_program();

// Unlike fmt::print, say() does not throw when the stream is closed; the exit status remains.
template <class... Arguments>
void say(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
    const std::string text = fmt::format(form, std::forward<Arguments>(arguments)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace scree::demos
