// What the user may ask of a simulation, and how words of the command line become values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compute/settings.h"

namespace CLI {
class App;
}

namespace scree::demos {

// Where to simulate.
struct MachineOptions {
    std::string backend = "auto";
    std::string device;  // index or part of a name
    int threads = 0;     // 0: one a core
    bool validate = false;
};

// What to simulate, and for how long.
struct SceneOptions {
    std::string name;  // of a demo, or a scene file
    std::size_t bodies = 0;
    std::uint64_t seed = 1;
    std::optional<int> steps;
    std::optional<double> seconds;
    float rate = Settings{}.rate;  // Hz
    int substeps = Settings{}.substeps;
    bool sleeping = Settings{}.sleeping;

    Settings settings() const;
    int step_count(double default_seconds) const;
};

// From where pictures are taken: as the scene says, unless something here says otherwise.
struct CameraOptions {
    std::optional<glm::vec3> eye, target;  // m
    std::optional<float> vertical_fov;     // degrees
    bool orthographic = false;
    bool fit = false;                   // as near as all of the scene is seen
    std::optional<double> orbit;        // seconds of a turn about the target; negative: the other way round
    std::optional<std::string> follow;  // a body, by name or index
};

struct PictureOptions {
    std::string frames, video, preview, raw;  // empty: none
    std::string canvas = "auto";              // what draws: auto, vulkan or gl
    int width = 1280, height = 720;
    int bits = 8;  // of a channel
    double fps = 30;
    CameraOptions camera;
    std::string color = "momentum", color_map = "plasma";
    std::optional<std::pair<float, float>> color_range;
    bool legend = true, caption = true;
    bool logarithmic = false;
    std::vector<std::string> show;  // besides the bodies: contacts, velocities, joints, boxes, cells, sleep

    bool shows(const char* what) const { return std::find(show.begin(), show.end(), what) != show.end(); }
    bool wanted() const { return !(frames.empty() && video.empty() && preview.empty() && raw.empty()); }
    // Throws UsageError for an output without a name, for pictures described that nobody takes, and for two outputs (`report`
    // among them) in one file.
    void require_sense(const CLI::App& command, const std::string& report) const;
    bool takes_output() const { return raw == "-"; }  // the standard output is for frames, and words go elsewhere
};

void add_options(CLI::App& command, MachineOptions& options);
void add_options(CLI::App& command, SceneOptions& options);
void add_options(CLI::App& command, PictureOptions& options);

// "10k", "1M", "250" and the like. Throws CLI::ValidationError.
std::size_t count_of(const std::string& word);
std::uint64_t seed_of(const std::string& word);               // throws the same
std::vector<std::size_t> counts_of(const std::string& list);  // parted by commas

}  // namespace scree::demos
