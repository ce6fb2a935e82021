// Changes of single values of a scene, by their paths in the scene file: --set KEY=VALUE.
#pragma once

#include <string>
#include <vector>

#include "demos/program/options/options.h"

namespace scree::demos {

// Of "bodies/3/friction=0.2". Throws CLI::ValidationError.
SceneEdit scene_edit_of(const std::string& word);

// The text of a scene file with the changes. A part of a key is a member's name, an index or the "name" of an element, or * for
// all elements; members that are missing are added, and the last may be. A value is JSON, or else a string. Throws UsageError.
std::string edited(const std::string& scene, const std::vector<SceneEdit>& edits);

}  // namespace scree::demos
