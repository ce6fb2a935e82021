// Nesting depth check of JSON text, to protect recursive parsers from stack overflow.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace scree::host {

// The JSON pointer (shortened if long) of the first value nested in more than `most` arrays and objects; nothing if
// there is none. The result for malformed JSON is unspecified, since the parser reports that.
std::optional<std::string> nested_deeper_than(std::size_t most, std::string_view json);

}  // namespace scree::host
