// Selection of demos by names and patterns.
#pragma once

#include <string>
#include <vector>

#include "demos/scenes/demos.h"

namespace scree::demos {

// Each word is a name, else a prefix of names, or a glob pattern ("stack*", "*1m", "pile?m"). Returns demos in the
// order of the words, without duplicates; all demos for no words. Throws UsageError for a word without matches.
std::vector<const Demo*> select_demos(const std::vector<std::string>& words);

}  // namespace scree::demos
