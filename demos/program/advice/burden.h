// What bears too much: bodies under the weight of much heavier ones, and the substeps with which they stand.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compute/world.h"

namespace scree::demos {

struct Burden {
    std::size_t body = 0, heaviest = 0;  // what bears, and the heaviest body that lies on it directly
    double ratio = 0;                    // of the weight on it to its own
    double substeps_a_second = 0;        // with which it stands
};

// The substeps a second with which a body of this width (m, the smaller one across gravity) bears `ratio` times its weight in
// this gravity (m/s^2).
double needed_substeps(double ratio, double width, double gravity);

// The bodies that do not bear what lies on them with the world's substeps and rate, by index; of many copies, in the first.
std::vector<Burden> overburdened(const World& world);

// "--substeps 20", or with a higher rate where more than 64 substeps would be needed; empty if no rate suffices.
std::string options_for(double substeps_a_second, double rate);

}  // namespace scree::demos
