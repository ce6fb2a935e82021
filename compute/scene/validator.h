// What is wrong with a part of a scene, said with its place and its name.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "compute/scene.h"

namespace scree {

inline std::string text_of(float value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

inline std::string plain(float limit) {
    return limit >= 1 && limit < 1e7f && limit == std::floor(limit) ? std::to_string(static_cast<int>(limit)) : text_of(limit);
}

inline std::string out_of_range(float value, float low, float high, const char* unit) {
    const std::string limits =
        low == -high ? "within " + plain(high) + unit + " of 0" : "between " + plain(low) + " and " + plain(high) + unit;
    return "must be " + limits + ", is " + text_of(value);
}

// One body, joint or vehicle of a scene under examination: where it is, and what it is called, for messages. Texts are made only
// when there is something to say. It refers to the name that it is given.
class Examination {
public:
    // `kind`: body, joint or vehicle; `list`: the scene's list of them.
    Examination(const char* list, const char* kind, std::size_t index, const std::string& name, std::string inside = "")
        : list_(list), kind_(kind), index_(index), name_(name), inside_(std::move(inside)) {}

    // A part of it: keys are then those of the part.
    Examination part(const std::string& inside) const { return {list_, kind_, index_, name_, inside_ + inside}; }

    [[noreturn]] void refuse(const std::string& key, const std::string& reason) const {
        throw SceneError(place() + key, reason + (name_.empty() ? "" : " (" + std::string(kind_) + " \"" + name_ + "\")"));
    }
    std::string place() const { return "/" + std::string(list_) + "/" + std::to_string(index_) + inside_; }
    void between(const char* key, float value, float low, float high, const char* unit) const {
        if (!(value >= low && value <= high)) refuse(key, out_of_range(value, low, high, unit));
    }
    void between(const std::string& key, float value, float low, float high, const char* unit) const {
        between(key.c_str(), value, low, high, unit);
    }
    void between(const char* key, vec3 value, float low, float high, const char* unit) const {
        for (int i = 0; i < 3; ++i) {
            if (value[i] >= low && value[i] <= high) continue;
            refuse(key + ("/" + std::to_string(i)), out_of_range(value[i], low, high, unit));
        }
    }
    // Divides by the length in double precision. What has unit length already, to rounding, stays: checking twice changes no bit.
    template <class Vector>
    void make_unit(const char* key, Vector& v, const char* meaning) const {
        double squared = 0;
        for (int i = 0; i < Vector::length(); ++i) {
            if (!std::isfinite(v[i])) refuse(key + ("/" + std::to_string(i)), "must be finite, is " + text_of(v[i]));
            squared += static_cast<double>(v[i]) * v[i];
        }
        if (squared < 1e-12) refuse(key, std::string("must not be of length 0: ") + meaning);
        if (std::abs(squared - 1) <= 2.5e-7) return;
        for (int i = 0; i < Vector::length(); ++i) v[i] = static_cast<float>(v[i] / std::sqrt(squared));
    }

private:
    const char *list_, *kind_;
    std::size_t index_;
    const std::string& name_;
    std::string inside_;
};

}  // namespace scree
