// The race: engines step the same scene by turns in one process, so that load of the machine affects all alike.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/peers/engine.h"

namespace scree::peers {

struct Entrant {
    std::string name;
    std::unique_ptr<Engine> engine;  // null: excluded, with the reason in `why_not`
    std::string why_not;
    bool made_the_scene = false;  // this engine settled the scene
};

struct Course {
    int warmup = 60;   // steps before measuring, to fill contact caches
    int settle = 300;  // further steps of the other engines, for which the scene is not at rest yet
    int rounds = 5;    // every engine has one turn per round, in rotating order
    int steps = 12;    // per turn
};

struct Lap {
    std::string name, why_not;  // as the entrant's; engines that failed are excluded too
    std::vector<double> ms;     // of each measured step
    std::size_t points = 0;     // contact points at the end
    double moved_median = 0;    // m, median displacement of bodies from start to end
    double moved_max = 0;
};

// All engines that can run `scene` here; the first, Bullet, is the reference of the ratios.
std::vector<Entrant> entrants(const Scene& scene, int threads);

std::vector<Lap> race(const Scene& scene, std::vector<Entrant> entrants, const Course& course);

// Median and quartiles of step times. `ms` must not be empty.
struct Quartiles {
    double low = 0, median = 0, high = 0;  // ms
};
Quartiles quartiles_of(std::vector<double> ms);

// The results as text, and as CSV with a row per engine. The ratio is that of medians, to the first lap's.
std::string table_of(const std::vector<Lap>& laps);
std::vector<std::vector<std::string>> csv_rows(const std::string& scene, std::size_t bodies, const std::vector<Lap>& laps);

}  // namespace scree::peers
