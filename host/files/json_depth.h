// How deep JSON text is nested, before a parser that calls itself reads it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace scree::host {

// The JSON pointer (its first members, where it is long) of the first value that lies in more than `most` arrays and objects;
// nothing if none does. Of what is no JSON whatever it looks like: its parser will say.
std::optional<std::string> nested_deeper_than(std::size_t most, std::string_view json);

}  // namespace scree::host
