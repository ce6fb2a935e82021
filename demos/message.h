// What the program says beside its results, on the standard error output.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace scree::demos {

// Unlike fmt::print, it does not throw where nobody can listen: the exit status still tells.
template <class... Arguments>
void say(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
    const std::string text = fmt::format(form, std::forward<Arguments>(arguments)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace scree::demos
