// Options of runs of many copies of a scene.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/program/loaded_scene.h"

namespace CLI {
class App;
}

namespace scree::demos {

struct CopyOptions {
    std::size_t copies = 0;         // 0: the scene itself
    std::vector<std::string> vary;  // KEY=FROM:TO, or seed
    std::optional<std::size_t> copy;
    std::size_t mosaic = 0;  // copies in pictures; 0: as many as are clear
};

// Which copies pictures show, side by side in a square.
struct CopiesShown {
    std::size_t first = 0;
    std::size_t count = 0;  // 0: a world without copies
    vec3 pitch{0};          // m from one to the next along x and z
    bool shows(std::size_t copy) const { return count == 0 || (copy >= first && copy < first + count); }
    vec3 offset(std::size_t copy) const;
};

void add_options(CLI::App& command, CopyOptions& options);
// Throws UsageError for what is asked of a single scene, or of copies that a run of them cannot have.
void require_sense(const CLI::App& command, const CopyOptions& options);
void require_sense(const CopyOptions& options, const LoadedScene& subject);
// How copies differ; empty if they do not. Throws UsageError for a key or a value.
VaryCopy vary_of(const CopyOptions& options, const SceneOptions& scene);
// The copies in pictures; widens the subject's box and camera to them.
CopiesShown shown_of(const CopyOptions& options, LoadedScene& subject);

}  // namespace scree::demos
