// An orbit camera.
#include "demos/film/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::demos {

namespace {
constexpr float steepest = 1.55f;                                      // rad: the azimuth is undefined at the pole
constexpr float least_distance = 0.05f, greatest_distance = 20000.0f;  // m
constexpr float turn_of_a_pixel = 0.006f;                              // rad
constexpr float chasing_elevation = 0.28f;                             // rad
}  // namespace

OrbitCamera::OrbitCamera(const Viewpoint& view) : target_(view.target), vertical_fov_(view.vertical_fov) {
    const vec3 back = view.eye - view.target;
    distance_ = std::clamp(glm::length(back), least_distance, greatest_distance);
    azimuth_ = std::atan2(back.x, back.z);
    elevation_ = std::clamp(std::asin(std::clamp(back.y / glm::length(back), -1.0f, 1.0f)), -steepest, steepest);
}

vec3 OrbitCamera::forward() const {
    return -vec3(std::cos(elevation_) * std::sin(azimuth_), std::sin(elevation_), std::cos(elevation_) * std::cos(azimuth_));
}
vec3 OrbitCamera::right() const {
    return {std::cos(azimuth_), 0, -std::sin(azimuth_)};
}
vec3 OrbitCamera::up() const {
    return glm::cross(right(), forward());
}
vec3 OrbitCamera::position() const {
    return target_ - forward() * distance_;
}
Viewpoint OrbitCamera::viewpoint() const {
    return {position(), target_, vertical_fov_};
}
float OrbitCamera::slope() const {
    return std::tan(glm::radians(vertical_fov_) * 0.5f);
}

void OrbitCamera::orbit(double dx, double dy) {
    azimuth_ -= static_cast<float>(dx) * turn_of_a_pixel;
    elevation_ = std::clamp(elevation_ + static_cast<float>(dy) * turn_of_a_pixel, -steepest, steepest);
}

void OrbitCamera::pan(double dx, double dy, Extent extent) {
    const float pixel = 2 * slope() * distance_ / static_cast<float>(extent.height);  // m
    target_ += (up() * static_cast<float>(dy) - right() * static_cast<float>(dx)) * pixel;
}

void OrbitCamera::zoom(double clicks) {
    distance_ = std::clamp(distance_ * std::pow(0.88f, static_cast<float>(clicks)), least_distance, greatest_distance);
}

void OrbitCamera::stay_above(float height) {
    constexpr float clearance = 0.02f;  // of the distance
    target_.y = std::max(target_.y, height);
    const float least = (height - target_.y) / distance_ + clearance;
    elevation_ = std::max(elevation_, std::asin(std::clamp(least, -1.0f, std::sin(steepest))));
}

void OrbitCamera::chase(vec3 target, vec3 ahead, float distance, double seconds) {
    constexpr double in_place = 8, behind = 2.5;  // 1/s
    const auto part = [&](double rate) { return static_cast<float>(1 - std::exp(-rate * std::min(seconds, 1.0))); };
    target_ += (target - target_) * part(in_place);
    distance_ += (distance - distance_) * part(behind);
    elevation_ += (chasing_elevation - elevation_) * part(behind);
    if (std::abs(ahead.x) + std::abs(ahead.z) < 0.1f) return;  // the heading is undefined when nearly vertical
    const float turn = std::atan2(-ahead.x, -ahead.z) - azimuth_;
    azimuth_ += std::remainder(turn, 2 * std::numbers::pi_v<float>) * part(behind);
}

Ray OrbitCamera::ray(double x, double y, Extent extent) const {
    const double half_height = 0.5 * extent.height;
    const float across = static_cast<float>((x + 0.5 - 0.5 * extent.width) / half_height) * slope();
    const float above = static_cast<float>((half_height - y - 0.5) / half_height) * slope();
    return {position(), glm::normalize(forward() + right() * across + up() * above)};
}

std::optional<glm::vec2> OrbitCamera::pixel_of(vec3 point, Extent extent) const {
    const vec3 way = point - position();
    const float depth = glm::dot(way, forward());
    if (depth < 1e-3f) return std::nullopt;
    const float scale = 0.5f * static_cast<float>(extent.height) / (slope() * depth);
    return glm::vec2(0.5f * static_cast<float>(extent.width) + glm::dot(way, right()) * scale - 0.5f,
                     0.5f * static_cast<float>(extent.height) - glm::dot(way, up()) * scale - 0.5f);
}

}  // namespace scree::demos
