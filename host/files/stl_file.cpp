// STL files, binary and text.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "host/files/mesh_file.h"

namespace scree::host {

namespace {

constexpr std::size_t stl_header = 84;  // 80 bytes of anything, and the number of triangles
constexpr std::size_t stl_triangle = 50;

// The words of a text file, with their lines.
class StlWords {
public:
    explicit StlWords(std::string_view text) : text_(text) {}
    std::string_view next() {
        while (!text_.empty() && static_cast<unsigned char>(text_.front()) <= ' ') skip(1);
        std::size_t end = 0;
        while (end < text_.size() && static_cast<unsigned char>(text_[end]) > ' ') ++end;
        const std::string_view word = text_.substr(0, end);
        skip(end);
        return word;
    }
    void skip_line() { skip(std::min(text_.find('\n'), text_.size())); }
    std::size_t line() const { return line_; }

private:
    void skip(std::size_t count) {
        line_ += static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
        text_.remove_prefix(count);
    }
    std::string_view text_;
    std::size_t line_ = 1;
};

float stl_number(StlWords& words, const std::string& name) {
    std::string_view word = words.next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(static_cast<float>(value)))
        throw FileError(name + ": line " + std::to_string(words.line()) + ": a vertex needs three finite numbers");
    return static_cast<float>(value);
}

MeshFile from_stl_text(std::string_view bytes, const std::string& name) {
    MeshFile mesh;
    StlWords words(bytes);
    words.next(), words.skip_line();  // solid, and its name
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (word == "vertex") {
            const float x = stl_number(words, name), y = stl_number(words, name), z = stl_number(words, name);
            mesh.vertices.emplace_back(x, y, z);
        } else if (word == "endloop") {
            const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
            if (count != 3 * (mesh.triangles.size() + 1))
                throw FileError(name + ": line " + std::to_string(words.line()) + ": a facet needs three vertices");
            mesh.triangles.emplace_back(count - 3, count - 2, count - 1);
        } else if (word == "solid" || word == "endsolid") {
            words.skip_line();
        }
    }
    return mesh;
}

}  // namespace

MeshFile mesh_of_stl(std::string_view bytes, const std::string& name) {
    std::uint32_t count = 0;
    if (bytes.size() >= stl_header) std::memcpy(&count, bytes.data() + 80, sizeof count);
    const bool binary = bytes.size() >= stl_header && (bytes.size() - stl_header) / stl_triangle >= count && count > 0 &&
                        (!bytes.starts_with("solid") || bytes.size() == stl_header + count * stl_triangle);
    if (!binary) {
        if (!bytes.starts_with("solid"))
            throw FileError(name + ": not an STL file, or cut off: it says " + std::to_string(count) + " triangles in " +
                            std::to_string(bytes.size()) + " bytes");
        return from_stl_text(bytes, name);
    }
    MeshFile mesh;
    mesh.vertices.reserve(3 * std::size_t{count});
    mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        float numbers[9];  // behind the normal, which the corners' order tells, too
        std::memcpy(numbers, bytes.data() + stl_header + i * stl_triangle + 12, sizeof numbers);
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (std::size_t k = 0; k < 9; k += 3) {
            const glm::vec3 at(numbers[k], numbers[k + 1], numbers[k + 2]);
            if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z))
                throw FileError(name + ": triangle " + std::to_string(i) + ": a vertex is not finite");
            mesh.vertices.push_back(at);
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

}  // namespace scree::host
