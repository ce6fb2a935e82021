// How each demo is shown: colours, overlays and camera, as `scree run DEMO` draws it.
#pragma once

#include <string_view>

#include "demos/scenes/demos.h"

namespace scree::demos {

// Sets the picture style of a demo, and its camera where the scene's own is not the best. Unknown names change nothing.
void set_look(std::string_view demo, DemoScene& scene);

}  // namespace scree::demos
