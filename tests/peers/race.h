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

    // The scene as it begins, falling and settling: every engine steps it from the first step, and all steps count.
    static Course from_start(int rounds, int steps) { return {0, 0, rounds, steps}; }
};

struct Lap {
    std::string name, why_not;  // as the entrant's; engines that failed are excluded too
    std::vector<double> ms;     // of each measured step
    double cpu_ms = 0;          // of them, in sum: processor time, of all threads
    std::size_t points = 0;     // contact points at the end
    double moved_median = 0;    // m, median displacement of bodies from start to end
    double moved_max = 0;
};

struct Field {
    int threads = 2;                    // of scree on the processor, which runs with one as well
    int substeps = 0;                   // of scree; 0: its default
    int box3d_substeps = 4;             // of Box3D, if it is in the build
    std::vector<std::string> programs;  // keys of those that take part; none: all
};
// Keys of programs: bullet, box3d, scree (with Field::threads), scree1, vulkan, mujoco.
std::vector<std::string> program_keys();

// All engines that can run `scene` here; the first, Bullet unless it was not asked for, is the reference of the ratios.
std::vector<Entrant> entrants(const Scene& scene, const Field& field);

std::vector<Lap> race(const Scene& scene, std::vector<Entrant> entrants, const Course& course);

// ms of processor time that all threads of this process have taken. The wall clock also counts what other programs take.
double processor_ms();

// Median, quartiles and mean of step times. `ms` must not be empty.
struct Quartiles {
    double low = 0, median = 0, high = 0, mean = 0;  // ms
};
Quartiles quartiles_of(std::vector<double> ms);

// The results as text, and as CSV with a row per engine. The ratios are those of medians, means and processor times, to the first
// lap's.
std::string table_of(const std::vector<Lap>& laps);
std::vector<std::string> lap_heading();  // of csv_rows
std::vector<std::vector<std::string>> csv_rows(const std::string& scene, std::size_t bodies, const std::vector<Lap>& laps);

}  // namespace scree::peers
