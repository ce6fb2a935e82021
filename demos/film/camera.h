// The camera of a run: where it is at each moment, as the scene says and the user changes it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options.h"
#include "host/canvas/camera.h"

namespace scree::demos {

class CameraMan {
public:
    // `aspect`: width of a picture over its height. Throws UsageError for a body to be followed that is not there, and for an eye
    // in the target.
    CameraMan(const CameraOptions& options, const LoadedScene& subject, float aspect);

    std::optional<std::size_t> followed() const { return followed_; }  // the body whose position at() wants to know
    host::Camera at(double seconds, vec3 followed_position = vec3(0)) const;

private:
    Viewpoint view_;
    std::optional<double> orbit_;  // s
    std::optional<std::size_t> followed_;
};

// Where a camera on the path is at a moment: it rests at the path's ends, and passes the keys between smoothly. The path must
// not be empty.
ViewKey key_at(const std::vector<ViewKey>& path, double seconds);

// Sees all of the points, as near as it can, looking along -back (of any length).
Viewpoint fitted(const std::vector<vec3>& points, vec3 back, float vertical_fov, float aspect, bool orthographic = false);

std::vector<vec3> corners_of(vec3 low, vec3 high);

}  // namespace scree::demos
