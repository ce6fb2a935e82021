// Motion of a body over time as few key frames: only where linear interpolation would err.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace scree::demos {

inline double error_of(glm::dvec4 x, glm::dvec4 y) {  // rad, for small ones: the chord of twice the half angle
    return 2 * std::min(glm::length(x - y), glm::length(x + y));
}

// Greatest error of viewers that interpolate from a to b, where `seen` was. Positions, m: linearly.
inline double interpolation_error(glm::vec3 a, glm::vec3 b, float part, glm::vec3 seen) {
    return glm::length(glm::dvec3(a) + glm::dvec3(b - a) * double{part} - glm::dvec3(seen));
}
// Orientations, rad: on the arc, as glTF says, or by component, as Blender does.
inline double interpolation_error(glm::vec4 from, glm::vec4 to, float part, glm::vec4 seen) {
    const glm::dvec4 a(from), b = glm::dot(glm::dvec4(from), glm::dvec4(to)) < 0 ? -glm::dvec4(to) : glm::dvec4(to);
    const double t = double{part}, angle = std::acos(std::min(glm::dot(a, b), 1.0)), sine = std::sin(angle);
    const glm::dvec4 straight = glm::normalize(a + (b - a) * t);
    if (sine < 1e-6) return error_of(straight, glm::dvec4(seen));
    const glm::dvec4 arc = a * (std::sin((1 - t) * angle) / sine) + b * (std::sin(t * angle) / sine);
    return std::max(error_of(straight, glm::dvec4(seen)), error_of(arc, glm::dvec4(seen)));
}

template <class Value>
class Track {
public:
    // Takes the value of a later time; `emit(time, value)` receives keys as soon as they are known.
    template <class Emit>
    void add(float time, const Value& value, double tolerance, const Emit& emit) {
        if (!begun_) {
            begun_ = true;
            emit(start_time_ = time, start_ = value);
            return;
        }
        if (between_.empty() && value == start_) {  // at rest: nothing to remember but how long
            held_ = true;
            held_until_ = time;
            return;
        }
        if (held_) {
            held_ = false;
            if (held_until_ > start_time_) emit(start_time_ = held_until_, start_);
        }
        if (!between_.empty() && (between_.size() >= longest || !fits(time, value, tolerance))) {
            std::tie(start_time_, start_) = between_.back();
            emit(start_time_, start_);
            between_.clear();
        }
        between_.emplace_back(time, value);
    }
    // The last key; later values may follow.
    template <class Emit>
    void finish(const Emit& emit) {
        if (held_ && held_until_ > start_time_) emit(start_time_ = held_until_, start_);
        held_ = false;
        if (between_.empty()) return;
        std::tie(start_time_, start_) = between_.back();
        emit(start_time_, start_);
        between_.clear();
    }

private:
    static constexpr std::size_t longest = 64;  // bounds memory and time
    bool fits(float time, const Value& value, double tolerance) const {
        for (const auto& [at, seen] : between_)
            if (interpolation_error(start_, value, (at - start_time_) / (time - start_time_), seen) > tolerance) return false;
        return true;
    }

    bool begun_ = false, held_ = false;
    float start_time_ = 0, held_until_ = 0;  // s
    Value start_{};
    std::vector<std::pair<float, Value>> between_;
};

}  // namespace scree::demos
