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

// As viewers interpolate: positions linearly, unit quaternions on the arc.
inline glm::vec3 between(glm::vec3 a, glm::vec3 b, float part) {
    return a + (b - a) * part;
}
inline glm::vec4 between(glm::vec4 a, glm::vec4 b, float part) {
    double cosine = glm::dot(glm::dvec4(a), glm::dvec4(b));
    const double sign = cosine < 0 ? -1 : 1;
    cosine = std::min(std::abs(cosine), 1.0);
    const double angle = std::acos(cosine), sine = std::sin(angle);
    if (sine < 1e-6) return a + (b * static_cast<float>(sign) - a) * part;
    return glm::vec4(glm::dvec4(a) * (std::sin((1 - part) * angle) / sine) +
                     glm::dvec4(b) * (sign * std::sin(part * angle) / sine));
}
inline double error_of(glm::vec3 a, glm::vec3 b) {  // m
    return glm::length(glm::dvec3(a) - glm::dvec3(b));
}
inline double error_of(glm::vec4 a, glm::vec4 b) {  // rad, for small ones: the chord of twice the half angle
    const glm::dvec4 x(a), y(b);
    return 2 * std::min(glm::length(x - y), glm::length(x + y));
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
            if (error_of(between(start_, value, (at - start_time_) / (time - start_time_)), seen) > tolerance) return false;
        return true;
    }

    bool begun_ = false, held_ = false;
    float start_time_ = 0, held_until_ = 0;  // s
    Value start_{};
    std::vector<std::pair<float, Value>> between_;
};

}  // namespace scree::demos
