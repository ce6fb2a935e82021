// Validation errors with JSON pointer and name.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "compute/scene.h"
#include "compute/schema/check.h"
#include "compute/schema/range_text.h"

namespace scree {

// A value being validated: a body, joint or vehicle with its name, or a member of one. Texts are built only for errors.
// Holds references to the name and to its parent.
class Examination {
public:
    // `list`: the scene's array; `kind`: body, joint or vehicle.
    Examination(const char* list, const char* kind, std::size_t index, const std::string& name)
        : list_(list), kind_(kind), index_(index), name_(&name) {}
    // The scene itself.
    Examination() = default;

    // A member; its own keys follow.
    Examination operator/(const char* key) const { return {*this, key, 0}; }
    Examination operator/(std::size_t index) const { return {*this, nullptr, index}; }
    Examination part(std::string inside) const {
        Examination part(*this, "", 0);
        part.inside_ = std::move(inside);
        return part;
    }

    [[noreturn]] void refuse(const std::string& key, const std::string& reason) const {
        throw SceneError(place() + key,
                         reason + (!name_ || name_->empty() ? "" : " (" + std::string(kind_) + " \"" + *name_ + "\")"));
    }
    std::string place() const {
        if (!whole_) return list_ ? "/" + std::string(list_) + "/" + std::to_string(index_) : "";
        return whole_->place() + (!inside_.empty() ? inside_ : "/" + (key_ ? std::string(key_) : std::to_string(index_)));
    }
    void between(const char* key, float value, float low, float high, const char* unit) const {
        const schema::Range range{static_cast<double>(low), static_cast<double>(high)};
        if (!range.holds(value)) refuse(key, out_of_range(value, range, *unit == ' ' ? unit + 1 : unit));
    }
    void between(const std::string& key, float value, float low, float high, const char* unit) const {
        between(key.c_str(), value, low, high, unit);
    }
    void between(const char* key, vec3 value, float low, float high, const char* unit) const {
        for (int i = 0; i < 3; ++i) {
            if (value[i] >= low && value[i] <= high) continue;
            between(key + ("/" + std::to_string(i)), value[i], low, high, unit);
        }
    }
    template <class Vector>
    void make_unit(const char* key, Vector& v, const char* meaning) const {
        schema::make_unit(part(key), v, meaning);
    }

private:
    Examination(const Examination& whole, const char* key, std::size_t index)
        : whole_(&whole), kind_(whole.kind_), key_(key), index_(index), name_(whole.name_) {}

    const Examination* whole_ = nullptr;
    const char *list_ = nullptr, *kind_ = nullptr, *key_ = nullptr;
    std::size_t index_ = 0;
    const std::string* name_ = nullptr;
    std::string inside_;
};

[[noreturn]] inline void refuse(const Examination& at, const std::string& reason) {
    at.refuse("", reason);
}

}  // namespace scree
