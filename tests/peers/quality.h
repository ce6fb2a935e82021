// How well engines keep a scene: the same scene and the same measures, taken from positions alone, and what a step took.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/peers/engine.h"

namespace scree::peers {

// Penetration of boxes and hulls by separating axes, in double precision: each touching pair counts once, and each body in a
// plane. Other shapes are left out. `scene`: checked.
struct Overlaps {
    std::size_t pairs = 0;          // that penetrate
    double mean = 0, greatest = 0;  // m, of these pairs
};
Overlaps overlaps_of(const Scene& scene, const std::vector<Pose>& poses);

// All ways are of dynamic bodies.
struct Keeping {
    std::string name;
    double ms = 0;          // processor time of a step, the mean of all
    double drift = 0;       // m, greatest horizontal way from start to end
    double late_drift = 0;  // m, greatest horizontal way in the second half
    double sinking = 0;     // m, greatest way down from start to end
    double end_speed = 0;   // m/s, greatest way of any centre in any step of the last second, over its time
    Overlaps overlaps;      // at the end
};

// Every engine takes `steps` steps, by turns of one.
std::vector<Keeping> keep(const Scene& scene, const std::vector<std::unique_ptr<Engine>>& engines, int steps);

// scree at 4, 8 and 12 substeps, and Box3D at 4 and 8 if the build has it, at 8 also with contacts as stiff as they then can be;
// one thread each.
std::vector<std::unique_ptr<Engine>> keepers(const Scene& scene);

std::string table_of(const std::vector<Keeping>& all);  // the ratio of times is that to the first
std::vector<std::vector<std::string>> csv_rows(const std::string& scene, std::size_t bodies, const std::vector<Keeping>& all);
std::vector<std::string> keeping_heading();  // of csv_rows

}  // namespace scree::peers
