// Many small scenes at once: bins of twenty stones (demo `bins`, each of a seed of its own) settle in scree's copies of one world
// and in worlds of other engines, one for each bin, on one thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/peers/quality.h"

namespace scree::peers {

constexpr double bin_seconds = 5;  // simulated, of each bin; bodies may sleep

struct Filling {
    std::string name;
    std::size_t bins = 0;     // that were simulated
    std::size_t settled = 0;  // of these: no stone moved by more than 1 mm in the last quarter of a second
    double seconds = 0;       // processor time, with what it takes to make the worlds
    Overlaps overlaps;        // at the end, over the first 64 bins
};

// Of all engines in the build, with settings from fast to stiff; what engines with a world for each bin would take longer for
// than `most_seconds` (of processor time) is told by those bins that they simulated until then.
std::vector<Filling> fill(std::size_t bins, double most_seconds);

std::string table_of(const std::vector<Filling>& all);  // the ratios are to the first
std::vector<std::vector<std::string>> csv_rows(const std::vector<Filling>& all);
std::vector<std::string> filling_heading();  // of csv_rows

}  // namespace scree::peers
