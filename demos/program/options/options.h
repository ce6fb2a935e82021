// Options shared by commands, and their parsing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compute/scene_file/import/import_options.h"
#include "compute/settings.h"

namespace CLI {
class App;
}

namespace scree::demos {

// The backend.
struct MachineOptions {
    std::string backend = "auto";
    std::string device;  // index or part of a name
    int threads = 0;     // 0: one per core
    bool validate = false;
    bool pipelines = false;  // the device tells statistics of its pipelines
    std::size_t memory = 0;  // bytes that the tables of steps may take; 0: what is free
};

// A value of the scene as a file says it: "bodies/3/friction" = "0.2".
struct SceneEdit {
    std::string key, value;
};

// Scene, duration and settings.
struct SceneOptions {
    std::string name;  // demo name or scene file
    std::size_t bodies = 0;
    std::uint64_t seed = 1;
    std::optional<int> steps;
    std::optional<double> seconds;
    std::optional<float> rate;  // Hz; none, likewise below: the scene's
    std::optional<int> substeps;
    bool sleeping = true;          // false: none sleeps, whatever the scene says
    ImportOptions imported{};      // of files of other programs
    std::vector<SceneEdit> edits;  // values of the scene to change

    Settings settings(Settings of_scene = {}) const;
    int step_count(double default_seconds, float steps_a_second) const;
};

// Camera; unset values are those of the scene.
struct CameraOptions {
    std::optional<glm::vec3> eye, target;  // m
    std::optional<float> vertical_fov;     // degrees
    bool orthographic = false;
    bool fit = false;                   // nearest camera that sees the whole scene
    std::optional<double> orbit;        // s per orbit about the target; negative: reversed
    std::optional<std::string> follow;  // body to follow, by name or index
    bool chase = false;                 // from behind its way
    bool still = false;                 // the scene's camera without its motion
};

struct PictureOptions {
    std::string frames, video, preview, raw;  // empty: none
    std::string html;                         // a page that plays the run; may be empty
    bool overwrite = false;                   // frames of an earlier run in the folder are removed
    std::string cameras;                      // JSON file of each picture's camera; may be empty
    std::vector<std::string> channels;        // depth, ids, parts, normals, flow (demos/film/channels.h)
    std::string annotations;                  // coco, bop (demos/film/annotations.h); may be empty
    std::string channel_files = "both";       // npy, png or both
    std::string canvas = "auto";              // auto, vulkan or gl
    int width = 1280, height = 720;
    int bits = 0;                     // per channel of what is drawn; 0: drawn_bits()
    std::string frame_files = "png";  // or exr
    double fps = 30;
    double from = 0;              // s of simulated time, of the first picture
    std::optional<double> until;  // of the last; none: the end of the run
    CameraOptions camera;
    // None: the scene's (demos/film/style.h).
    std::optional<std::string> color, color_map, color_scale;
    std::optional<std::pair<float, float>> color_range;
    std::optional<std::vector<std::string>> show;  // overlays, or "none"
    std::optional<std::string> sky;
    std::optional<std::pair<float, float>> sun;  // azimuth and elevation, degrees
    std::string background = "sky";              // or none: transparent, or #rrggbb, or #rgb
    float shutter = 0;                           // of motion blur: part of the time between pictures, 0: none
    int shutter_samples = 8;                     // pictures that are averaged
    bool legend = true, caption = true;
    int samples = 1;  // per pixel: 1, 4, 9 or 16, drawn as larger pictures
    // Light of half floats for EXR files, where the canvas can.
    int drawn_bits() const { return bits != 0 ? bits : frame_files == "exr" && canvas != "gl" ? 16 : 8; }
    bool wanted() const { return !(frames.empty() && video.empty() && preview.empty() && raw.empty()); }
    bool shown() const { return wanted() || !html.empty(); }
    // Throws UsageError for an output without a name, for picture options without an output, and for two outputs
    // (`report` among them) to one file.
    void require_sense(const CLI::App& command) const;
    bool takes_output() const { return raw == "-"; }  // frames go to the standard output, hence text does not
};

void add_options(CLI::App& command, MachineOptions& options);
void add_options(CLI::App& command, float& rate, int& substeps);
void add_options(CLI::App& command, std::optional<float>& rate, std::optional<int>& substeps);
void add_options(CLI::App& command, std::uint64_t& seed);
void add_options(CLI::App& command, ImportOptions& options);
void add_options(CLI::App& command, SceneOptions& options);
void add_options(CLI::App& command, PictureOptions& options);

// "10k", "1M", "250" and the like. Throws CLI::ValidationError.
std::size_t count_of(const std::string& word, const char* option = "--bodies");
std::uint64_t seed_of(const std::string& word);               // throws the same
std::vector<std::size_t> counts_of(const std::string& list);  // comma-separated

}  // namespace scree::demos
