// The range of the colour scale, fixed for a run so that colours do not flicker.
#pragma once

#include <string>
#include <utility>

#include "demos/program/loaded_scene.h"

namespace scree::demos {

// From 0 to the quantity of a body of mean mass and size after falling three tenths of the scene's height (or at the
// largest initial speed), rounded to 1, 2 or 5 times a power of ten. For height: from the bottom to the top of the
// scene.
std::pair<float, float> color_range(const LoadedScene& subject, const Settings& settings, const std::string& quantity);

// The range of a logarithmic scale: from a thousandth of its end.
std::pair<float, float> logarithmic_range(std::pair<float, float> range);

}  // namespace scree::demos
