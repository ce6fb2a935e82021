// Measures of scree run: --measures FILE.json, --measures-out TABLE, and --vtk FOLDER.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "compute/measures.h"
#include "compute/world.h"

namespace CLI {
class App;
}

namespace scree::demos {

struct MeasureOptions {
    std::string file;   // JSON; empty: what the scene asks for
    std::string table;  // .csv or .npz; empty: none
    int every = 0;      // steps; 0: the interval that is asked for
    std::string vtk;    // folder; empty: none
    int vtk_every = 0;  // steps; 0: as --fps
    bool any() const { return !file.empty() || !table.empty() || !vtk.empty(); }
};
void add_options(CLI::App& command, MeasureOptions& options);
// Throws UsageError for an option that means nothing, and for a file of another kind or that cannot be written.
void require_sense(const CLI::App& command, const MeasureOptions& options);
// What --measures says, else what the scene does. Throws UsageError.
std::optional<MeasureRequest> measures_asked(const MeasureOptions& options, const std::optional<MeasureRequest>& of_scene,
                                             const Scene& scene);

// Records while the run steps. It first looks at the world in after_step().
class MeasuresFile {
public:
    // `asked`: what is measured; none: the grains as a whole. `fps`: moments of VTK files a second.
    MeasuresFile(const MeasureOptions& options, const std::optional<MeasureRequest>& asked, std::size_t copy, double fps);
    ~MeasuresFile();
    MeasuresFile(const MeasuresFile&) = delete;
    MeasuresFile& operator=(const MeasuresFile&) = delete;

    int steps_until_due(const World& world) const;
    void after_step(const World& world);  // records if it is due; call it before the first step, too
    void finish();                        // throws host::FileError
    int vtk_moments() const;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
