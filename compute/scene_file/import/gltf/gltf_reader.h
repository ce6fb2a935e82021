// The JSON of a glTF file with the places of its values, as the reader of physics sees it.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "compute/scene_file/import/notes.h"

namespace scree::imports {

// A value and its JSON pointer. Members that nobody asks for are noted by finish().
class GltfValue {
public:
    GltfValue(const nlohmann::json& value, std::string pointer, const std::string& file, Notes& notes)
        : value_(&value), pointer_(std::move(pointer)), file_(&file), notes_(&notes) {}

    const nlohmann::json& json() const { return *value_; }
    bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
    GltfValue at(const char* key);          // null if it is missing
    GltfValue at(std::size_t index) const;  // refuses an index beyond the array
    std::size_t size() const { return value_->is_array() ? value_->size() : 0; }
    explicit operator bool() const { return !value_->is_null(); }

    double number(const char* key, double otherwise);
    bool flag(const char* key, bool otherwise);
    std::string text(const char* key, const std::string& otherwise = "");
    std::size_t index(const char* key, std::size_t below, std::size_t otherwise);
    std::vector<double> numbers(const char* key, std::size_t count);  // none if it is missing
    std::size_t word(const char* key, const std::vector<std::string>& known, std::size_t otherwise);

    Origin origin() const { return {*file_, 0, pointer_.empty() ? "/" : pointer_}; }
    [[noreturn]] void refuse(const std::string& reason) const { imports::refuse(origin(), reason); }
    void note(const std::string& kind, const std::string& reason) const { notes_->add({*file_, 0, pointer_}, kind, reason); }
    void finish();

private:
    const nlohmann::json* value_;
    std::string pointer_;
    const std::string* file_;
    Notes* notes_;
    std::set<std::string> read_;
};

constexpr std::size_t none_given = static_cast<std::size_t>(-1);

}  // namespace scree::imports
