// URDF, the XML of ROS, as a model.
#pragma once

#include "compute/scene_file/import/element.h"
#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/scene_json.h"

namespace scree::imports {

// The scene of a document whose root is <robot>.
SceneDocument scene_of_urdf(const host::XmlElement& root, Folder& folder, const ImportOptions& options, Notes& notes,
                            std::size_t most_bodies);

}  // namespace scree::imports
