// The camera of a run over time, from the scene and the user's options.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/options.h"
#include "host/canvas/camera.h"

namespace scree::demos {

class CameraMan {
public:
    // `aspect`: width of a picture over its height; `strip`: share of the height, 0 to 0.5, at the lower edge where a fitted
    // scene is not. Throws UsageError when the body to follow does not exist, or when eye and target coincide.
    CameraMan(const CameraOptions& options, const LoadedScene& subject, float aspect, float strip = 0);

    std::optional<std::size_t> followed() const { return followed_; }  // the body whose position at() needs
    // Call with rising times: a chasing camera turns gradually.
    host::Camera at(double seconds, vec3 followed_position = vec3(0));

private:
    void choose_motion(const CameraOptions& options, const LoadedScene& subject);
    void turn_behind(double seconds, vec3 position);

    Viewpoint view_;
    std::optional<double> orbit_;  // s
    std::optional<std::size_t> followed_;
    bool chases_ = false;
    float turned_ = 0;                 // rad about y, of the chasing camera since the start
    vec3 chased_{0};                   // last position
    std::optional<double> chased_at_;  // s
};

// The camera on a path at a time: a cubic spline through the keys, at rest at both ends. The path must not be empty.
ViewKey key_at(const std::vector<ViewKey>& path, double seconds);

// The nearest camera that sees all points above the lowest `strip` of the picture (a share of its height, 0 to 0.5), looking
// along -back (of any length). vertical_fov in degrees.
Viewpoint fitted(const std::vector<vec3>& points, vec3 back, float vertical_fov, float aspect, bool orthographic = false,
                 float strip = 0);

std::vector<vec3> corners_of(vec3 low, vec3 high);

}  // namespace scree::demos
