// Runs of what is free in a list, by their first: they are joined where they meet, and taken from the lowest that is long enough.
#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

namespace scree {

template <class Number>
using FreeRuns = std::map<Number, Number>;  // first, count

template <class Number>
void add_run(FreeRuns<Number>& runs, Number first, Number count) {
    if (const auto next = runs.find(first + count); next != runs.end()) {
        count += next->second;
        runs.erase(next);
    }
    if (const auto after = runs.lower_bound(first); after != runs.begin())
        if (const auto before = std::prev(after); before->first + before->second == first) {
            before->second += count;
            return;
        }
    runs[first] = count;
}

// The first of `count`; nothing where no run is so long.
template <class Number>
std::optional<Number> take_run(FreeRuns<Number>& runs, Number count) {
    const auto run = std::find_if(runs.begin(), runs.end(), [&](const auto& one) { return one.second >= count; });
    if (run == runs.end()) return std::nullopt;
    const auto [first, length] = *run;
    runs.erase(run);
    if (length > count) runs[first + count] = length - count;
    return first;
}

}  // namespace scree
