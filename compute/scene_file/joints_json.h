// The joints of a scene file (compute/scene_file/scene_json.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compute/scene.h"
#include "compute/scene_file/fields_read.h"

namespace scree {

// Reads the value of "joints" after all bodies are read; throws SceneError with the JSON pointer of the error.
void read_joints(const nlohmann::json& value, json_reading::NamedThings& named, Scene& scene);
// A joint given in its bodies' frames (not by "anchor"), with bodies by index; not validated.
Joint joint_of(const nlohmann::json& value, const json_reading::Place& place);
std::string joint_to_json(const Joint& joint);  // a JSON object on one line

}  // namespace scree
