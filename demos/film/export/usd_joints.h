// Joints of a scene as UsdPhysics.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compute/scene.h"

namespace scree::demos {

// `paths`: of the bodies' prims. What USD cannot say goes to `note`.
std::string usd_joint(const Scene& scene, std::size_t index, const std::vector<std::string>& paths,
                      const std::function<void(const std::string&)>& note);

}  // namespace scree::demos
