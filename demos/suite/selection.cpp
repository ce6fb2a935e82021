// Selection of demos by names, prefixes and patterns.
#include "demos/suite/selection.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/options.h"

namespace scree::demos {

namespace {

std::vector<const Demo*> named_by(const std::string& word) {
    if (const Demo* demo = find_demo(word)) return {demo};
    const bool is_pattern = word.find_first_of("*?[") != word.npos;
    std::vector<const Demo*> found;
    for (const Demo& demo : all_demos()) {
        const std::string name = demo.name;
        const bool meant = is_pattern ? fnmatch(word.c_str(), name.c_str(), 0) == 0 : !word.empty() && name.starts_with(word);
        if (meant) found.push_back(&demo);
    }
    return found;
}

[[noreturn]] void refuse(const std::string& word) {
    if (word.find('/') != word.npos || word.ends_with(".json"))
        throw UsageError(word + ": a scene file has no promise to check; `scree list` shows the demos");
    std::vector<std::string> names;
    for (const Demo& known : all_demos()) names.emplace_back(known.name);
    const std::string near = nearest(word, names);
    throw UsageError(
        fmt::format("unknown demo \"{}\"{}; a name, its beginning or a pattern such as \"stack*\"; `scree list` shows all", word,
                    near.empty() ? "" : ", nearest: \"" + near + "\""));
}

}  // namespace

std::vector<const Demo*> select_demos(const std::vector<std::string>& words) {
    std::vector<const Demo*> chosen;
    for (const std::string& word : words.empty() ? std::vector<std::string>{"*"} : words) {
        const std::vector<const Demo*> found = named_by(word);
        if (found.empty()) refuse(word);
        for (const Demo* demo : found) {
            if (std::find(chosen.begin(), chosen.end(), demo) == chosen.end()) chosen.push_back(demo);
        }
    }
    return chosen;
}

}  // namespace scree::demos
