// The joints of a scene file (compute/scene_file/scene_json.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compute/scene.h"
#include "compute/scene_file/fields_read.h"

namespace scree {

// The value of "joints", once all bodies are there; throws SceneError with the JSON pointer of what is wrong.
void read_joints(const nlohmann::json& value, const json_reading::NamedThings& named, Scene& scene);
// One joint that says where it is in its bodies' frames (not by "anchor"), and its bodies by their index; not checked yet.
Joint joint_of(const nlohmann::json& value, const json_reading::Place& place);
std::string joint_to_json(const Joint& joint);  // an object on one line

}  // namespace scree
