// The cameras of pictures as JSON.
#include "demos/film/camera_track.h"

#include <fmt/format.h>

#include <cmath>

namespace scree::demos {

namespace {

using glm::vec3;

std::string text_of(vec3 v) {
    return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z);
}
std::string row_of(vec3 v, float last) {
    return fmt::format("[{:.9g}, {:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z, last);
}

}  // namespace

void CameraTrack::add(double seconds, const host::Camera& camera) {
    const vec3 back = glm::normalize(camera.eye - camera.target), right = glm::normalize(glm::cross(camera.up, back)),
               up = glm::cross(back, right);
    const float rise = std::tan(glm::radians(camera.vertical_fov) / 2);
    const float aspect = static_cast<float>(width_) / static_cast<float>(height_);
    // Focal length, pixels; of parallel rays the pixels of a metre.
    const float focal =
        0.5f * static_cast<float>(height_) / (camera.orthographic ? rise * glm::length(camera.eye - camera.target) : rise);
    frames_ += count_ > 0 ? ",\n  " : "\n  ";
    frames_ += fmt::format(
        "{{\"frame\": {}, \"time\": {:.9g}, \"eye\": {}, \"target\": {}, \"vertical_fov\": {:.9g}, \"horizontal_fov\": {:.9g},\n"
        "   \"world_to_camera\": [{}, {}, {}, [0, 0, 0, 1]],\n   \"focal\": {:.9g}, \"center\": [{:g}, {:g}]}}",
        count_, seconds, text_of(camera.eye), text_of(camera.target), camera.vertical_fov,
        2 * glm::degrees(std::atan(rise * aspect)), row_of(right, -glm::dot(right, camera.eye)),
        row_of(up, -glm::dot(up, camera.eye)), row_of(back, -glm::dot(back, camera.eye)), focal, 0.5 * width_, 0.5 * height_);
    frames_.insert(frames_.size() - 1, camera.orthographic ? ", \"orthographic\": true" : "");
    ++count_;
}

std::string CameraTrack::json() const {
    return fmt::format(
        "{{\"width\": {}, \"height\": {},\n \"convention\": \"metres, world y up; the camera looks along its -z, x to the right, "
        "y up; a "
        "point (x, y, z) of the camera is at pixel (center[0] - focal x / z, center[1] + focal y / z) from the upper left\",\n "
        "\"frames\": [{}\n]}}\n",
        width_, height_, frames_);
}

}  // namespace scree::demos
