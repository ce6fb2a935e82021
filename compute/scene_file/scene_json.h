// Scenes as JSON: errors have the exact place, floats read back bit-identically.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/bonds.h"
#include "compute/measures.h"
#include "compute/scene.h"
#include "compute/scene_file/events.h"
#include "compute/scene_file/picture_style.h"
#include "compute/scene_stream.h"
#include "compute/servo_walls.h"
#include "compute/settings.h"

namespace scree {

// A key frame of the camera path.
struct ViewKey {
    float time = 0;           // s
    vec3 eye{0};              // m
    vec3 target{0};           // m
    float vertical_fov = 45;  // degrees
};

// The camera suggested for a scene; the simulation does not use it.
struct Viewpoint {
    vec3 eye{0};                // m; with a path that of its first key, likewise below
    vec3 target{0};             // m
    float vertical_fov = 45;    // degrees
    bool orthographic = false;  // parallel projection, with the same scale at the target's distance
    std::vector<ViewKey> path;  // ascending in time; empty: a fixed camera
    // Motion of a camera without a path. With a body to follow, eye and target move with it.
    std::size_t follow = no_body;
    bool chase = false;  // looks at the followed body from behind its way
    float orbit = 0;     // s per turn about the target, < 0: the other way round; 0: none
    bool fit = false;    // as near as sees the whole scene at the start, in the direction from target to eye
};

// Grains of a scene file.
struct FileGrains {
    Grains grains{};
    float start = 0;  // s, when those that are poured begin to come
};

// A scene file: the scene, and how it is run and shown.
struct SceneDocument {
    Scene scene{};  // not validated; World does that
    std::optional<Viewpoint> viewpoint{};
    std::optional<Settings> settings{};
    float duration = 0;  // s, of a run that is not told how long; 0: 10 s
    std::optional<PictureStyle> picture{};
    std::vector<TimedEvent> events{};
    // Until add_grains(): grains to come. Reading a file has done that.
    std::vector<FileGrains> grains{};
    std::optional<MeasureRequest> measures{};
    std::vector<Bonding> bonds{};          // likewise, until add_bonds()
    std::vector<ServoWall> servo_walls{};  // of a file; reading it has made them joints
};

// Takes the document's bonds, which bond bodies of its scene. Throws SceneError, its pointer by the index in the list.
void add_bonds(SceneDocument& document);

// Takes the document's grains: those that are there at the start become bodies behind the others, those that are poured events.
// Throws SceneError, its pointer by the index in the list, and for more than `most_bodies` bodies. `notes`, if given, receives
// remarks, on curves that few grains miss.
void add_grains(SceneDocument& document, std::vector<std::string>* notes = nullptr,
                std::size_t most_bodies = static_cast<std::size_t>(-1));

// Reads a scene file's text (format: scene_schema()). Throws SceneError with the JSON pointer of an invalid value, or
// line and column of a syntax error. Rejects more than `most_bodies` bodies before they fill memory.
SceneDocument scene_from_json(std::string_view text, std::size_t most_bodies = static_cast<std::size_t>(-1));

// Reads a scene file's text with its bodies apart: calls take(body) for each as soon as it has been read. None if the text has a
// syntax error, or refers to its bodies (joints, vehicles, exclusions, events, a followed body): scene_from_json() reads these.
// Throws SceneError likewise, and what take() throws.
std::optional<SceneDocument> scene_without_bodies(std::istream& text, const TakeBody& take);

// Writes a scene, one body per line, without keys that have their default. Throws SceneError for values that are not
// finite, which JSON cannot express.
std::string scene_to_json(const SceneDocument& document);
std::string scene_to_json(const Scene& scene, const std::optional<Viewpoint>& viewpoint = {});

// XXH64 of a scene: of gravity, bodies, joints and vehicles as scene_to_json() writes them, fragments left out. A file
// of a mesh counts by its name.
std::uint64_t hash_of(const Scene& scene);
std::uint64_t hash_of(const StreamedScene& scene);

// One body as a JSON object on one line.
std::string body_to_json(const Body& body);

}  // namespace scree
