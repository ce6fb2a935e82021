// The JSON Schema of scene files, made from the field tables (compute/schema).
#pragma once

#include <string>

namespace scree {

std::string scene_schema();

}  // namespace scree
