// Animations of scree run: --export FILE.glb --export-every N.
#pragma once

#include <optional>
#include <string>

#include "demos/film/glb_export.h"

namespace CLI {
class App;
}

namespace scree::demos {

struct ExportOptions {
    std::string file;  // .glb; empty: none
    int every = 1;     // steps
    bool any_number = false;
};
void add_options(CLI::App& command, ExportOptions& options);
// Throws UsageError for an option that means nothing, and for a file of another kind or that cannot be written.
void require_sense(const CLI::App& command, const ExportOptions& options);
// None if no file is asked for. Throws UsageError for too many moving bodies.
std::unique_ptr<GlbExport> make_export(const ExportOptions& options, const World& world);

}  // namespace scree::demos
