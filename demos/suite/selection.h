// Which demos a list of words names.
#pragma once

#include <string>
#include <vector>

#include "demos/scenes/demos.h"

namespace scree::demos {

// Each word is a name, else the beginning of names, or a pattern ("stack*", "*1m", "pile?m"); in the order of the words, each
// demo once. No words: all. Throws UsageError for a word that names none.
std::vector<const Demo*> select_demos(const std::vector<std::string>& words);

}  // namespace scree::demos
