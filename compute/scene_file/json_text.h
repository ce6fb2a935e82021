// JSON text output, with the shortest digits that read back to the same float.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree {

class Text {
public:
    std::string take() { return std::move(text_); }
    Text& operator<<(std::string_view plain) {
        text_ += plain;
        return *this;
    }
    Text& operator<<(float value);  // throws SceneError if not finite, which JSON cannot express
    Text& operator<<(std::uint32_t value) { return *this << std::string_view(std::to_string(value)); }
    template <glm::length_t size, class Number>
    Text& operator<<(const glm::vec<size, Number>& v) {
        for (glm::length_t i = 0; i < size; ++i) *this << (i == 0 ? "[" : ", ") << v[i];
        return *this << "]";
    }
    void quoted(std::string_view words);
    void key(std::string_view before, std::string_view key);  // as it is: before"key":
    template <class Value>
    void list(const std::vector<Value>& values) {
        *this << "[";
        for (std::size_t i = 0; i < values.size(); ++i) *this << (i == 0 ? "" : ", ") << values[i];
        *this << "]";
    }

private:
    std::string text_;
};

}  // namespace scree
