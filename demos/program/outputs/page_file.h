// Pages of scree run: --html FILE.
#pragma once

#include <memory>

#include "demos/film/pages/page_recording.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/options.h"

namespace scree::demos {

// What a page shows of a scene at first: the camera, light and colours of its pictures. `rehearses`: colours may be measured in a
// run ahead.
PageOptions page_options(const PictureOptions& options, const LoadedScene& subject, World& world, bool rehearses = true);

// A page with the camera, light and colours of the run's pictures. Throws UsageError where this program makes none.
std::unique_ptr<PageRecording> make_page(const PictureOptions& options, const CopiesShown& shown, const LoadedScene& subject,
                                         World& world);

}  // namespace scree::demos
