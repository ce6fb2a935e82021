// The scene to simulate: a demo by name, or a scene file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_stream.h"
#include "compute/world.h"
#include "demos/program/options/options.h"
#include "demos/scenes/script.h"
#include "demos/suite/promise.h"

namespace scree::demos {

struct Backend;  // demos/program/backend.h

struct LoadedScene {
    std::string name;
    Scene scene;
    Viewpoint viewpoint;
    vec3 low, high;  // bounding box of the action, m; of a file without bodies far from the others (at most a tenth)
    double seconds = 10;
    std::optional<Promise> promise{};  // none for scene files
    Settings of_scene{};               // the scene's own
    Script before_step{};
    PictureStyle style{};
    std::vector<TimedEvent> events{};          // of a scene file; before_step performs them
    std::optional<MeasureRequest> measures{};  // likewise
    // Of load_streamed(): the bodies behind those of `scene`; none if null.
    std::function<void(const TakeBody& take)> others{};
    StreamedScene streamed() const { return {scene, others}; }

    Settings settings(const SceneOptions& options) const;  // the scene's settings with those of the user
    std::string title() const;                             // without the folder
};

// Throws UsageError naming the nearest demo, the JSON pointer of an error in a file, or how many bodies (fragments
// included) fit into memory.
LoadedScene load_subject(const SceneOptions& options);

// Likewise, for one of `ranks` of which none is to hold all bodies: those of demos and files that can come one after the other
// stay apart.
LoadedScene load_streamed(const SceneOptions& options, int ranks);

// A scene that is described in the program. Checks it: throws SceneError. `notes`: as of scree::checked.
LoadedScene subject_of(SceneDocument document, std::string name, std::vector<std::string>* notes = nullptr);

// The scene as a file says it.
SceneDocument document_of(const LoadedScene& subject);
// A file to continue from: the present scene, of one of its copies if there are any, and the events that are still to come.
SceneDocument document_of(const LoadedScene& subject, const World& world, std::optional<std::size_t> copy = std::nullopt);

// Throws UsageError if a run of that many bodies would not fit into free memory.
void require_memory_for(std::size_t bodies);

// Steps are refused, with what they ask for, before their tables take more than MachineOptions::memory or than is free. A
// device with memory of its own tells itself when that ends.
void limit_memory(World& world, const Backend& machine);

}  // namespace scree::demos
