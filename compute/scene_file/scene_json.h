// Scenes as JSON text: read with the exact place of every mistake, written so that every float reads back to the same bits.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/scene.h"

namespace scree {

// Where a camera that moves is at a moment.
struct ViewKey {
    float time = 0;           // s
    vec3 eye{0};              // m
    vec3 target{0};           // m
    float vertical_fov = 45;  // degrees
};

// Where a scene is best seen from. The simulation never looks at it.
struct Viewpoint {
    vec3 eye{0};                // m; with a path its first eye, and so on
    vec3 target{0};             // m
    float vertical_fov = 45;    // degrees
    bool orthographic = false;  // parallel rays; what lies as far as the target is as large as without
    std::vector<ViewKey> path;  // in the order of time; empty: the camera stands still
};

struct SceneDocument {
    Scene scene;  // as written; World checks it
    std::optional<Viewpoint> viewpoint;
};

// Reads the text of a scene file (the format: scene_schema(), of compute/scene_file/scene_schema.h). Throws SceneError: with the
// JSON pointer of what is wrong with a value, or with line and column when it is no JSON. Refuses more than `most_bodies` bodies
// before they fill the memory.
SceneDocument scene_from_json(std::string_view text, std::size_t most_bodies = static_cast<std::size_t>(-1));

// One body a line. Keys that have their default value are left out. Finite values only (SceneError otherwise): JSON has no other.
std::string scene_to_json(const Scene& scene, const std::optional<Viewpoint>& viewpoint = {});

// One body of it, as an object on one line.
std::string body_to_json(const Body& body);

}  // namespace scree
