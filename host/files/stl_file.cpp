// STL files, binary and text.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "host/files/finite_number.h"
#include "host/files/mesh_file.h"

namespace scree::host {

namespace {

constexpr std::size_t stl_header = 84;  // 80 bytes of anything, and the number of triangles
constexpr std::size_t stl_triangle = 50;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower;
}

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
    void skip_line() { skip(std::min(text_.find_first_of("\r\n"), text_.size())); }
    std::size_t line() const { return line_; }

private:
    void skip(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)  // the end of a line is \n, \r\n or \r
            if (text_[i] == '\n' || (text_[i] == '\r' && !text_.substr(i).starts_with("\r\n"))) ++line_;
        text_.remove_prefix(count);
    }
    std::string_view text_;
    std::size_t line_ = 1;
};

float stl_number(StlWords& words, const std::string& name) {
    std::string_view word = words.next();
    if (const std::optional<float> value = finite_number(word)) return *value;
    throw FileError(name + ": line " + std::to_string(words.line()) + ": a vertex needs three finite numbers");
}

// The header of a binary file may begin with "solid", too, but the number of its triangles has a byte 0.
bool is_text(std::string_view bytes) {
    return bytes.substr(0, stl_header).find('\0') == bytes.npos;
}
bool begins_with_solid(std::string_view bytes) {
    if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    return in_lower_case(StlWords(bytes.substr(0, 4096)).next()).starts_with("solid");
}

MeshFile from_stl_text(std::string_view bytes, const std::string& name) {
    MeshFile mesh;
    if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    StlWords words(bytes);
    words.next(), words.skip_line();  // solid, and its name
    for (std::string word = in_lower_case(words.next()); !word.empty(); word = in_lower_case(words.next())) {
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
    if (mesh.vertices.size() != 3 * mesh.triangles.size())
        throw FileError(name + ": line " + std::to_string(words.line()) + ": the file ends within a facet");
    return mesh;
}

}  // namespace

MeshFile mesh_of_stl(std::string_view bytes, const std::string& name) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
        throw FileError(name + ": is UTF-16 text; write it as ASCII or UTF-8");
    std::uint32_t count = 0;
    if (bytes.size() >= stl_header) std::memcpy(&count, bytes.data() + 80, sizeof count);
    const std::size_t whole = stl_header + count * stl_triangle;
    if (bytes.size() != whole && is_text(bytes)) {
        if (begins_with_solid(bytes)) return from_stl_text(bytes, name);
        if (bytes.size() < whole) throw FileError(name + ": not an STL file: its text does not begin with \"solid\"");
    }
    if (count == 0 || bytes.size() < whole)
        throw FileError(name + ": not an STL file, or cut off: it says " + std::to_string(count) + " triangles in " +
                        std::to_string(bytes.size()) + " bytes");
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
