// Files of VTK's XML formats, which ParaView opens: arrays appended raw.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree::demos {

struct VtkArray {
    std::string name;
    const char* type = "Float32";  // VTK's words; see vtk_type
    std::size_t components = 1;
    std::vector<std::byte> bytes;
};

template <class Value>
inline constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<float> = "Float32";
template <>
inline constexpr const char* vtk_type<double> = "Float64";
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";

template <class Value>
VtkArray vtk_array(std::string name, std::size_t components, const std::vector<Value>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {std::move(name), vtk_type<Value>, components, {bytes.begin(), bytes.end()}};
}

// Points, and cells of one kind over them.
struct VtkPolyData {
    std::vector<glm::vec3> points;
    const char* kind = "Verts";               // or Lines, Polys
    std::vector<std::int64_t> corners, ends;  // of the cells: points, and where each cell's end
    std::vector<VtkArray> of_points, of_cells;
};
struct VtkImage {
    glm::dvec3 lower{0}, cell{1};  // m
    glm::uvec3 cells{1};
    std::vector<VtkArray> of_cells;  // x fastest
};

// Each file appears whole. Throw host::FileError.
void write_vtk(const std::filesystem::path& path, double time, const VtkPolyData& data);
void write_vtk(const std::filesystem::path& path, double time, const VtkImage& image);
// The index of files over time, .pvd: replaced as a whole.
void write_vtk_index(const std::filesystem::path& path, const std::vector<std::pair<double, std::string>>& files);

}  // namespace scree::demos
