// Values of glTF's JSON.
#include "compute/scene_file/import/gltf/gltf_reader.h"

#include <cmath>

namespace scree::imports {

namespace {
const nlohmann::json no_value;
}

GltfValue GltfValue::at(const char* key) {
    read_.insert(key);
    return {has(key) ? (*value_)[key] : no_value, pointer_ + "/" + key, *file_, *notes_};
}

GltfValue GltfValue::at(std::size_t index) const {
    if (!value_->is_array() || index >= value_->size()) refuse("has no element " + std::to_string(index));
    return {(*value_)[index], pointer_ + "/" + std::to_string(index), *file_, *notes_};
}

double GltfValue::number(const char* key, double otherwise) {
    const GltfValue found = at(key);
    if (!found) return otherwise;
    if (!found.json().is_number() || !(std::abs(found.json().get<double>()) <= 1e30))
        found.refuse("must be a number within 1e30");
    return found.json().get<double>();
}

bool GltfValue::flag(const char* key, bool otherwise) {
    const GltfValue found = at(key);
    if (!found) return otherwise;
    if (!found.json().is_boolean()) found.refuse("must be true or false");
    return found.json().get<bool>();
}

std::string GltfValue::text(const char* key, const std::string& otherwise) {
    const GltfValue found = at(key);
    if (!found) return otherwise;
    if (!found.json().is_string()) found.refuse("must be a string");
    return found.json().get<std::string>();
}

std::size_t GltfValue::index(const char* key, std::size_t below, std::size_t otherwise) {
    const GltfValue found = at(key);
    if (!found) return otherwise;
    if (!found.json().is_number_unsigned() || found.json().get<std::uint64_t>() >= below)
        found.refuse("must be an index below " + std::to_string(below));
    return found.json().get<std::size_t>();
}

std::vector<double> GltfValue::numbers(const char* key, std::size_t count) {
    const GltfValue found = at(key);
    std::vector<double> numbers;
    if (!found) return numbers;
    if (found.size() != count) found.refuse("must be an array of " + std::to_string(count) + " numbers");
    for (const nlohmann::json& one : found.json()) {
        if (!one.is_number() || !(std::abs(one.get<double>()) <= 1e30)) found.refuse("must be numbers within 1e30");
        numbers.push_back(one.get<double>());
    }
    return numbers;
}

std::size_t GltfValue::word(const char* key, const std::vector<std::string>& known, std::size_t otherwise) {
    const GltfValue found = at(key);
    if (!found) return otherwise;
    std::string choices;
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (found.json() == known[i]) return i;
        choices += (i > 0 ? ", " : "") + known[i];
    }
    found.refuse("must be one of " + choices);
}

void GltfValue::finish() {
    if (!value_->is_object()) return;
    for (const auto& [key, value] : value_->items())
        if (!read_.contains(key) && key != "name" && key != "extras") note(key.substr(0, 60), "is unknown here and left out");
}

}  // namespace scree::imports
