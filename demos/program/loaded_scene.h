// What is simulated: a demo by its name, or a scene from a file.
#pragma once

#include <optional>
#include <string>

#include "compute/scene.h"
#include "compute/scene_file/scene_json.h"
#include "demos/program/options.h"
#include "demos/scenes/script.h"
#include "demos/suite/promise.h"

namespace scree::demos {

struct LoadedScene {
    std::string name;
    Scene scene;
    Viewpoint viewpoint;
    vec3 low, high;  // corners of where it happens, m
    double seconds = 10;
    std::optional<Promise> promise;  // a scene file has none
    bool sleeping = true;
    Script before_step;

    Settings settings(const SceneOptions& options) const;  // what the user asks, as far as the scene allows it
};

// Throws UsageError naming the nearest demo, the place of a mistake in a file, or how many bodies would fit into the memory,
// pieces of those that may break included.
LoadedScene load_subject(const SceneOptions& options);

// Throws UsageError if a run of that many bodies would not fit into the memory that is free.
void require_memory_for(std::size_t bodies);

}  // namespace scree::demos
