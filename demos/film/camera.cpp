// The camera of a run.
#include "demos/film/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "compute/scene/shape_geometry.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"

namespace scree::demos {

namespace {

vec3 turned_about_y(vec3 v, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

std::size_t body_named(const std::string& word, const Scene& scene) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    const bool number = error != std::errc::invalid_argument && end == word.data() + word.size();
    if (number && (error != std::errc() || index >= scene.bodies.size())) {
        throw UsageError(fmt::format("--camera follow:{}: there is no such body; the scene has {}, counted from 0", word,
                                     scene.bodies.size()));
    }
    if (!number) {
        std::vector<std::string> names;
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            const std::string& name = scene.bodies[i].name;
            if (name == word) found.push_back(i);
            if (!name.empty() && names.size() < 1000) names.push_back(name);
        }
        if (found.size() > 1) {
            throw UsageError(
                fmt::format("--camera follow:{}: bodies {} and {} have this name; give an index", word, found[0], found[1]));
        }
        if (found.empty()) {
            const std::string near = nearest(word, names);
            throw UsageError(fmt::format("--camera follow:{}: no body has this name{}; an index will do, too", word,
                                         near.empty() ? "" : ", nearest: \"" + near + "\""));
        }
        index = found[0];
    }
    if (std::holds_alternative<Plane>(scene.bodies[index].shape)) {
        throw UsageError(fmt::format("--camera follow:{}: cannot follow a plane; choose a body that moves", word));
    }
    return index;
}

// Tangent of the path at key i: a Catmull-Rom spline (1974) for uneven keys, zero at the ends.
template <class Value>
Value slope_at(const std::vector<ViewKey>& path, std::size_t i, Value ViewKey::*member) {
    if (i == 0 || i + 1 == path.size()) return Value(0);
    return (path[i + 1].*member - path[i - 1].*member) / (path[i + 1].time - path[i - 1].time);
}

template <class Value>
Value between_keys(const std::vector<ViewKey>& path, std::size_t i, float t, Value ViewKey::*member) {
    const float span = path[i + 1].time - path[i].time, t2 = t * t, t3 = t2 * t;
    return path[i].*member * (2 * t3 - 3 * t2 + 1) + slope_at(path, i, member) * (span * (t3 - 2 * t2 + t)) +
           path[i + 1].*member * (3 * t2 - 2 * t3) + slope_at(path, i + 1, member) * (span * (t3 - t2));
}

// Positions of the corners during an orbit about the centre, so that no frame crops them.
std::vector<vec3> swept(const std::vector<vec3>& corners, vec3 middle) {
    std::vector<vec3> all;
    for (int i = 0; i < 32; ++i) {
        for (const vec3& corner : corners)
            all.push_back(middle + turned_about_y(corner - middle, 2 * std::numbers::pi_v<float> * static_cast<float>(i) / 32));
    }
    return all;
}

}  // namespace

CameraMan::CameraMan(const CameraOptions& options, const LoadedScene& subject, float aspect, float strip)
    : view_(subject.viewpoint) {
    const bool placed = options.eye || options.target;
    if (!view_.path.empty()) view_.eye = view_.path[0].eye, view_.target = view_.path[0].target;
    if (placed || options.fit || options.follow || options.still) view_.path.clear();
    if (options.eye) view_.eye = *options.eye;
    if (options.target) view_.target = *options.target;
    view_.orthographic = view_.orthographic || options.orthographic;
    if (options.vertical_fov) {
        view_.vertical_fov = *options.vertical_fov;
        for (ViewKey& key : view_.path) key.vertical_fov = *options.vertical_fov;
    }
    if (glm::length(view_.eye - view_.target) < 1e-4f) {
        throw UsageError("--eye and --target: must be at least 0.1 mm apart, or the camera looks nowhere");
    }
    choose_motion(options, subject);
    if (options.fit || (subject.viewpoint.fit && !placed && !options.follow)) {
        std::vector<vec3> points = corners_of(subject.low, subject.high);
        if (orbit_) points = swept(points, 0.5f * (subject.low + subject.high));
        view_ = fitted(points, view_.eye - view_.target, view_.vertical_fov, aspect, view_.orthographic, strip);
    }
    if (!followed_) return;
    const Body& body = subject.scene.bodies[*followed_];
    vec3 back = view_.eye - view_.target;
    if (!options.follow) {  // the scene's camera moves with the body
        view_.target -= body.position;
        view_.eye = view_.target + back;
        return;
    }
    // By default the followed body takes a tenth of the picture's height.
    if (!placed && !options.fit) {
        const float rise = std::tan(glm::radians(view_.vertical_fov) / 2);
        back *= 10 * bounding_radius(body.shape) / (rise * glm::length(back));
    }
    view_.target = vec3(0);
    view_.eye = back;
}

// The user's motion, else the scene's, unless the user has chosen a place or stillness.
void CameraMan::choose_motion(const CameraOptions& options, const LoadedScene& subject) {
    orbit_ = options.orbit;
    const Viewpoint& scene = subject.viewpoint;
    if (!orbit_ && scene.orbit != 0 && !options.still) orbit_ = scene.orbit;
    if (options.follow) {
        followed_ = body_named(*options.follow, subject.scene);
        chases_ = options.chase;
    } else if (scene.follow < subject.scene.bodies.size() && !(options.still || options.fit || options.eye || options.target)) {
        followed_ = scene.follow;
        chases_ = scene.chase;
    }
}

// Turns towards the back of the body's way, by half within a third of a second.
void CameraMan::turn_behind(double seconds, vec3 position) {
    const auto duration = static_cast<float>(seconds - std::exchange(chased_at_, seconds).value_or(seconds));
    const vec3 way = position - std::exchange(chased_, position);
    if (duration <= 0) return;                               // the first picture
    if (std::hypot(way.x, way.z) < 0.4f * duration) return;  // slower than 0.4 m/s, it has no way
    const vec3 back = turned_about_y(view_.eye - view_.target, turned_);
    const float turn = std::remainder(std::atan2(-way.x, -way.z) - std::atan2(back.x, back.z), 2 * std::numbers::pi_v<float>);
    turned_ += turn * (1 - std::exp(-2 * duration));
}

host::Camera CameraMan::at(double seconds, vec3 followed_position) {
    ViewKey key{0, view_.eye, view_.target, view_.vertical_fov};
    if (!view_.path.empty()) key = key_at(view_.path, seconds);
    if (chases_) {
        turn_behind(seconds, followed_position);
        key.eye = turned_about_y(key.eye, turned_);
        key.target = turned_about_y(key.target, turned_);
    }
    if (followed_) key.eye += followed_position, key.target += followed_position;
    if (orbit_) {
        const double turns = seconds / *orbit_;
        const auto angle = static_cast<float>(2 * std::numbers::pi * (turns - std::floor(turns)));
        key.eye = key.target + turned_about_y(key.eye - key.target, angle);
    }
    host::Camera camera;
    camera.eye = key.eye;
    camera.target = key.target;
    camera.vertical_fov = key.vertical_fov;
    camera.orthographic = view_.orthographic;
    const vec3 along = key.target - key.eye;
    if (std::abs(along.y) > 0.999f * glm::length(along)) camera.up = {0, 0, -1};  // looking straight down or up
    return camera;
}

ViewKey key_at(const std::vector<ViewKey>& path, double seconds) {
    const auto time = static_cast<float>(seconds);
    if (time <= path.front().time) return path.front();
    if (time >= path.back().time) return path.back();
    std::size_t i = 0;
    while (path[i + 1].time < time) ++i;
    const float t = (time - path[i].time) / (path[i + 1].time - path[i].time);
    ViewKey key{time, between_keys(path, i, t, &ViewKey::eye), between_keys(path, i, t, &ViewKey::target),
                between_keys(path, i, t, &ViewKey::vertical_fov)};
    key.vertical_fov = std::clamp(key.vertical_fov, 1.0f, 170.0f);
    return key;
}

std::vector<vec3> corners_of(vec3 low, vec3 high) {
    std::vector<vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return corners;
}

Viewpoint fitted(const std::vector<vec3>& points, vec3 back, float vertical_fov, float aspect, bool orthographic, float strip) {
    constexpr float margin = 1.06f;
    Viewpoint view;
    view.vertical_fov = vertical_fov;
    view.orthographic = orthographic;
    back = glm::normalize(back);
    const bool upright = std::abs(back.y) < 0.999f;
    const vec3 right = glm::normalize(glm::cross(upright ? vec3(0, 1, 0) : vec3(0, 0, -1), back));
    const vec3 up = glm::cross(back, right);
    const float rise = std::tan(glm::radians(vertical_fov) / 2) / margin;
    view.target = vec3(0);
    for (const vec3& point : points) view.target += point / static_cast<float>(points.size());
    // A point p relative to the target is visible if |p.right| <= rise aspect (d - p.back), and likewise upward, but
    // downward to 1 - 2 strip of that; with an orthographic camera the bound is that at d. Iterate: centre the visible
    // extent in what is left of the picture by moving the target.
    float distance = 0;
    for (int round = 0; round < 8; ++round) {
        distance = 1e-3f;
        for (const vec3& point : points) {
            const vec3 p = point - view.target;
            const float side = std::abs(glm::dot(p, right)) / (rise * aspect), height = glm::dot(p, up) / rise;
            distance =
                std::max(distance, (orthographic ? 0 : glm::dot(p, back)) + std::max({side, height, -height / (1 - 2 * strip)}));
        }
        vec3 least(1e30f), most(-1e30f);
        for (const vec3& point : points) {
            const vec3 p = point - view.target;
            const vec3 seen =
                vec3(glm::dot(p, right), glm::dot(p, up), 0) / (orthographic ? distance : distance - glm::dot(p, back));
            least = glm::min(least, seen);
            most = glm::max(most, seen);
        }
        view.target += (right * (least.x + most.x) + up * (least.y + most.y - 2 * strip * rise)) * (0.5f * distance);
    }
    view.eye = view.target + back * distance;
    return view;
}

}  // namespace scree::demos
