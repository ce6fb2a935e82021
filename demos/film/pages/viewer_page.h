// The page of the viewer, embedded in the program (demos/viewer).
#pragma once

#include <string_view>

namespace scree::demos {

std::string_view viewer_page();  // empty in programs that were built without esbuild

}  // namespace scree::demos
