// What all queries share: refusal by name, and lists of several queries.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/queries.h"

namespace scree {

[[noreturn]] inline void refuse_query(const char* kind, std::size_t index, const std::string& reason) {
    throw std::invalid_argument(std::string(kind) + " " + std::to_string(index) + ": " + reason);
}

inline bool is_unit(glm::vec3 v) {
    const float squared = glm::dot(v, v);
    return std::isfinite(squared) && std::abs(squared - 1) < 2e-3f;
}
inline bool is_finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline void check_copy(const char* kind, std::size_t i, std::size_t copy, std::size_t copies) {
    if (copy >= copies)
        refuse_query(kind, i, "there is no copy " + std::to_string(copy) + " of the scene, of " + std::to_string(copies));
}

template <class Item>
QueryLists<Item> joined_lists(std::vector<std::vector<Item>>&& lists) {
    QueryLists<Item> made;
    made.starts.push_back(0);
    for (const std::vector<Item>& list : lists) made.starts.push_back(made.starts.back() + list.size());
    made.items.reserve(made.starts.back());
    for (const std::vector<Item>& list : lists) made.items.insert(made.items.end(), list.begin(), list.end());
    return made;
}

}  // namespace scree
