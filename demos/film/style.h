// How pictures show a scene: the user's choice over the scene's own.
#pragma once

#include <string>
#include <vector>

#include "compute/scene_file/picture_style.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/options.h"
#include "host/canvas/canvas.h"
#include "host/canvas/colors.h"

namespace scree::demos {

// A quantity of the user's replaces the scene's together with its scale and range.
PictureStyle style_of(const PictureOptions& options, const PictureStyle& scene);

// The colour scale of a style; a range that it leaves open is color_range()'s. Throws UsageError for a logarithmic scale
// that begins at 0.
host::ColorScale scale_of(const PictureStyle& style, const LoadedScene& subject, const Settings& settings, bool rehearses = true);

// Sets light and background.
void show_light(const PictureStyle& style, host::CanvasOptions& canvas);

bool shows(const PictureStyle& style, Overlay overlay);
void set_shown(PictureStyle& style, Overlay overlay, bool on);

// Whether the automatic scale of a quantity is that of roots: momentum, energy and impulses of a scene often span several
// powers of ten.
bool is_shown_by_root(ShownQuantity quantity);

// The words of options and scene files (compute/scene_file/picture_style_fields.h).
const std::vector<std::string>& color_words();
const std::vector<std::string>& color_map_words();
const std::vector<std::string>& color_scale_words();
const std::vector<std::string>& overlay_words();
const std::vector<std::string>& sky_words();
std::string word_of(ShownQuantity quantity);

}  // namespace scree::demos
