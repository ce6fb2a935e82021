// The range of colours of a run, fixed before it begins so that no frame flickers.
#pragma once

#include <string>
#include <utility>

#include "demos/program/loaded_scene.h"

namespace scree::demos {

// From 0 to what a body of mean mass and size would have after falling over three tenths of the scene's height (or moving as fast
// as the fastest does at the start), rounded to 1, 2 or 5 times a power of ten. For height: from the bottom of the scene to its
// top.
std::pair<float, float> color_range(const LoadedScene& subject, const Settings& settings, const std::string& quantity);

// The same on a logarithmic scale, which cannot begin at 0: from a thousandth of its end.
std::pair<float, float> logarithmic_range(std::pair<float, float> range);

}  // namespace scree::demos
