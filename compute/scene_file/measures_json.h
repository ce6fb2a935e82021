// What is measured, as JSON: a file with the keys of a scene file's "measures".
#pragma once

#include <string>
#include <string_view>

#include "compute/measures.h"

namespace scree {

// Bodies are those of the scene, by index or name. Throws SceneError with the JSON pointer of an invalid value, or line and
// column of a syntax error.
MeasureRequest measures_from_json(std::string_view text, const Scene& scene);
std::string measures_to_json(const MeasureRequest& request);

}  // namespace scree
