// Animations of scree run: --export FILE.glb|FILE.usda --export-every N.
#pragma once

#include <optional>
#include <string>

#include "compute/scene_file/import/import_options.h"
#include "demos/film/export/animation.h"

namespace CLI {
class App;
}

namespace scree::demos {

struct ExportOptions {
    std::string file;  // .glb or .usda; empty: none
    int every = 1;     // steps
    bool any_number = false;
    int clip = 0;  // moments in each value clip of a .usda; 0: all are in the file
    // The USD file that the scene is of, over which a .usda lies as a layer; empty, or "none": it stands alone.
    std::string over{};
    ImportOptions imported{};  // of that
};
void add_options(CLI::App& command, ExportOptions& options);
// Throws UsageError for an option that means nothing, and for a file of another kind or that cannot be written.
void require_sense(const CLI::App& command, const ExportOptions& options);
// A .usda of a run of a USD file lies over that, unless it is told otherwise. Throws UsageError where it cannot.
void lay_over(ExportOptions& options, const std::string& scene, const ImportOptions& imported);
// What is written while a run steps.
class Animation {
public:
    // By the file's ending; none if it is empty. Throws std::invalid_argument for too many moving bodies of a .glb.
    Animation(const ExportOptions& options, const World& world);
    explicit operator bool() const { return recorder_.has_value(); }
    int steps_until_due(const World& world) const { return recorder_->steps_until_due(world); }
    void after_step(const World& world) { recorder_->after_step(world); }
    void write() { recorder_->write(); }

private:
    std::optional<AnimationRecorder> recorder_;
};
// The same, and throws UsageError for too many.
Animation make_animation(const ExportOptions& options, const World& world);

}  // namespace scree::demos
