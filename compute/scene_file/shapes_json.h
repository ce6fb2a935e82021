// Shapes of a scene file: reading, writing and their schema.
#pragma once

#include <nlohmann/json.hpp>

#include "compute/scene.h"
#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/json_text.h"

namespace scree {

namespace json_reading {
void read(const json& value, const Place& place, Shape& out);
}
void write_shape(Text& text, const Shape& shape);
// The definition "shape" of the schema's $defs; it refers to "number", "vector" and "size" there.
nlohmann::ordered_json shape_schema();

}  // namespace scree
