// Selection of demos by names, prefixes and patterns.
#include "demos/suite/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/options.h"

namespace scree::demos {

namespace {

// Whether a name is of a pattern as in a shell: * is any text, ? any character, [abc], [a-c] and [!abc] one of some.
bool matches(std::string_view pattern, std::string_view name) {
    for (; !pattern.empty(); pattern.remove_prefix(1), name.remove_prefix(1)) {
        if (pattern[0] == '*') {
            for (std::size_t i = 0; i <= name.size(); ++i)
                if (matches(pattern.substr(1), name.substr(i))) return true;
            return false;
        }
        if (name.empty()) return false;
        // A bracket that is the first of a set belongs to it.
        const bool none_of = pattern.size() > 1 && (pattern[1] == '!' || pattern[1] == '^');
        const std::size_t begin = none_of ? 2 : 1, end = pattern[0] == '[' ? pattern.find(']', begin + 1) : pattern.npos;
        if (end == pattern.npos) {
            if (pattern[0] != '?' && pattern[0] != name[0]) return false;
            continue;
        }
        bool among = false;
        for (std::size_t i = begin; i < end; ++i) {
            const bool range = i + 2 < end && pattern[i + 1] == '-';
            among = among || (pattern[i] <= name[0] && name[0] <= pattern[range ? i + 2 : i]);
            if (range) i += 2;
        }
        if (among == none_of) return false;
        pattern.remove_prefix(end);
    }
    return name.empty();
}

std::vector<const Demo*> named_by(const std::string& word) {
    if (const Demo* demo = find_demo(word)) return {demo};
    const bool is_pattern = word.find_first_of("*?[") != word.npos;
    std::vector<const Demo*> found;
    for (const Demo& demo : all_demos()) {
        const std::string name = demo.name;
        const bool meant = is_pattern ? matches(word, name) : !word.empty() && name.starts_with(word);
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
