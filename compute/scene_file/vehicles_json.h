// The vehicles of a scene file (compute/scene_file/scene_json.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compute/scene.h"
#include "compute/scene_file/json_reading.h"

namespace scree {

// The value of "vehicles", once all bodies and joints are there; throws SceneError with the JSON pointer of what is wrong.
void read_vehicles(const nlohmann::json& value, Scene& scene);
std::string vehicle_to_json(const Vehicle& vehicle);  // an object on one line

}  // namespace scree
