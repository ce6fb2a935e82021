// The shapes of a scene file (compute/scene_file/scene_json.h): read and written by the list of shapes.
#pragma once

#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/json_text.h"

namespace scree {

namespace json_reading {
void read(const json& value, const Place& place, Shape& out);
}

void write_shape(Text& text, const Shape& shape);

}  // namespace scree
