// The joints of a scene file (compute/scene_json.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compute/json_reading.h"
#include "compute/scene.h"

namespace scree {

// The value of "joints", once all bodies are there; throws SceneError with the JSON pointer of what is wrong.
void read_joints(const nlohmann::json& value, Scene& scene);
std::string joint_to_json(const Joint& joint);  // an object on one line

}  // namespace scree
