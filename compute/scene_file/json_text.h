// JSON text that grows, in the shortest digits that read back to the same float.
#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compute/scene.h"

namespace scree {

class Text {
public:
    std::string take() { return std::move(text_); }
    Text& operator<<(std::string_view plain) {
        text_ += plain;
        return *this;
    }
    Text& operator<<(float value) {
        if (!std::isfinite(value)) throw SceneError("", "a value of the scene is not finite; JSON cannot hold it");
        if (value == 0) return *this << (std::signbit(value) ? "-0.0" : "0");
        char digits[64];
        char* end = std::to_chars(digits, digits + sizeof digits - 1, value).ptr;
        *end = '\0';
        // Readers go through a double; should that round twice to a neighbour, write all digits of the float instead.
        double wide = 0;
        std::from_chars(digits, end, wide);
        if (static_cast<float>(wide) != value)
            end = std::to_chars(digits, digits + sizeof digits, static_cast<double>(value)).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }
    Text& operator<<(std::uint32_t value) { return *this << std::string_view(std::to_string(value)); }
    template <glm::length_t size, class Number>
    Text& operator<<(const glm::vec<size, Number>& v) {
        for (glm::length_t i = 0; i < size; ++i) *this << (i == 0 ? "[" : ", ") << v[i];
        return *this << "]";
    }
    void quoted(std::string_view words) {
        static constexpr char hex[] = "0123456789abcdef";
        text_ += '"';
        for (const char c : words) {
            const auto code = static_cast<unsigned char>(c);
            if (c == '"' || c == '\\') {
                text_ += '\\';
                text_ += c;
            } else if (code < 0x20) {
                text_ += "\\u00";
                text_ += hex[code >> 4];
                text_ += hex[code & 15];
            } else {
                text_ += c;
            }
        }
        text_ += '"';
    }
    template <class Value>
    void list(const std::vector<Value>& values) {
        *this << "[";
        for (std::size_t i = 0; i < values.size(); ++i) *this << (i == 0 ? "" : ", ") << values[i];
        *this << "]";
    }
    template <class Value>
    void unless_default(std::string_view key, const Value& value, const Value& by_default) {
        if (same_bits(value, by_default)) return;
        *this << ", \"" << key << "\": " << value;
    }

private:
    static bool same_bits(float a, float b) { return std::bit_cast<unsigned>(a) == std::bit_cast<unsigned>(b); }
    template <glm::length_t size>
    static bool same_bits(const glm::vec<size, float>& a, const glm::vec<size, float>& b) {
        for (glm::length_t i = 0; i < size; ++i) {
            if (!same_bits(a[i], b[i])) return false;
        }
        return true;
    }

    std::string text_;
};

}  // namespace scree
