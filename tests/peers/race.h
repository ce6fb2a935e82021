// The race: engines that step the same scene by turns, in one process, so that what else the machine does meets all of them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/peers/engine.h"

namespace scree::peers {

struct Entrant {
    std::string name;
    std::unique_ptr<Engine> engine;  // null: left out, and `why_not` says why
    std::string why_not;
    bool made_the_scene = false;  // settled it: it lies as this program has things lie
};

struct Course {
    int warmup = 60;   // steps before the first that counts: contacts form, caches of contacts fill
    int settle = 300;  // and so many more of those who did not make the scene: it is not at rest until they have moved it
    int rounds = 5;    // each engine's turn comes once a round, another engine first each time
    int steps = 12;    // of a turn
};

struct Lap {
    std::string name, why_not;  // as the entrant's; one that failed on the way is left out too
    std::vector<double> ms;     // of each step that counts
    std::size_t points = 0;     // contacts at the end
    double moved_median = 0;    // m, between the start and the end, of the bodies
    double moved_max = 0;
};

// All that can run `scene` here: Bullet first, which the others are compared with.
std::vector<Entrant> entrants(const Scene& scene, int threads);

std::vector<Lap> race(const Scene& scene, std::vector<Entrant> entrants, const Course& course);

// How long a step took: median, and the quartiles between which half of all steps lie. `ms` not empty.
struct Quartiles {
    double low = 0, median = 0, high = 0;  // ms
};
Quartiles quartiles_of(std::vector<double> ms);

// For people, and as CSV with a row for each program. The ratio is of medians, to the first lap's.
std::string table_of(const std::vector<Lap>& laps);
std::vector<std::vector<std::string>> csv_rows(const std::string& scene, std::size_t bodies, const std::vector<Lap>& laps);

}  // namespace scree::peers
