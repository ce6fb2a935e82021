// MJCF: height fields.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "compute/scene_file/import/mjcf/mjcf.h"

namespace scree::imports {

namespace {

constexpr std::size_t most_points = 16'000'000;

// MuJoCo's own binary files: numbers of rows and columns, then heights as floats, all little-endian.
struct Grid {
    std::size_t rows = 0, columns = 0;
    std::vector<double> heights;  // row by row, from that of the least y
};

Grid grid_of_file(const Element& asset, const std::string& bytes) {
    static_assert(std::endian::native == std::endian::little);
    if (bytes.starts_with("\x89PNG"))
        asset.refuse("file", "pictures are not read; write the heights as \"elevation\", or as MuJoCo's binary file");
    std::int32_t size[2] = {0, 0};
    if (bytes.size() >= sizeof size) std::memcpy(size, bytes.data(), sizeof size);
    const auto limit = static_cast<std::int32_t>(most_points);
    if (size[0] < 2 || size[1] < 2 || size[0] > limit || size[1] > limit / size[0])
        asset.refuse("file", "is no height field: it must begin with the numbers of rows and columns, 2 to 16000000 points");
    Grid grid{static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1]), {}};
    const std::size_t points = grid.rows * grid.columns;
    if (bytes.size() != sizeof size + 4 * points)
        asset.refuse("file", "must have " + std::to_string(sizeof size + 4 * points) + " bytes for its rows and columns, has " +
                                 std::to_string(bytes.size()));
    std::vector<float> read(points);
    std::memcpy(read.data(), bytes.data() + sizeof size, 4 * points);
    for (const float height : read) {
        if (!std::isfinite(height)) asset.refuse("file", "has a height that is not finite");
        grid.heights.push_back(double{height});
    }
    return grid;
}

Grid grid_of_text(Element& asset) {
    const long rows = asset.whole("nrow", 0), columns = asset.whole("ncol", 0);
    const auto limit = static_cast<long>(most_points);
    if (rows < 2 || columns < 2 || rows > limit || columns > limit / rows)
        asset.refuse("needs \"nrow\" and \"ncol\", 2 to 16000000 points in all, or a file");
    Grid grid{static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), {}};
    grid.heights.assign(grid.rows * grid.columns, 0);
    if (!asset.has("elevation")) {
        asset.note("", "has no heights, which programs of MuJoCo set while they run; it is flat");
        return grid;
    }
    const auto read = numbers_in(asset.text("elevation"), most_points);
    if (!read || read->size() != grid.heights.size()) asset.refuse("elevation", "must be nrow * ncol numbers");
    for (std::size_t r = 0; r < grid.rows; ++r)  // in the text the row of the greatest y is the first
        for (std::size_t c = 0; c < grid.columns; ++c)
            grid.heights[(grid.rows - 1 - r) * grid.columns + c] = (*read)[r * grid.columns + c];
    return grid;
}

// The surface as triangles, for points that are not equally far apart along x and y; z is up.
Mesh mesh_of_grid(const Grid& grid, double half_x, double half_y) {
    Mesh mesh;
    const auto at = [&](std::size_t r, std::size_t c) { return static_cast<std::uint32_t>(r * grid.columns + c); };
    for (std::size_t r = 0; r < grid.rows; ++r)
        for (std::size_t c = 0; c < grid.columns; ++c)
            mesh.vertices.push_back(vec3(glm::dvec3(
                (2 * static_cast<double>(c) / static_cast<double>(grid.columns - 1) - 1) * half_x,
                (2 * static_cast<double>(r) / static_cast<double>(grid.rows - 1) - 1) * half_y, grid.heights[at(r, c)])));
    for (std::size_t r = 0; r + 1 < grid.rows; ++r)
        for (std::size_t c = 0; c + 1 < grid.columns; ++c) {
            mesh.triangles.emplace_back(at(r, c), at(r, c + 1), at(r + 1, c + 1));
            mesh.triangles.emplace_back(at(r, c), at(r + 1, c + 1), at(r + 1, c));
        }
    return mesh;
}

}  // namespace

void Mjcf::read_terrain(const host::XmlElement& tree) {
    Element element = this->element(tree, {});
    std::string name = element.text("name");
    if (name.empty()) name = std::filesystem::path(element.text("file")).stem().string();
    if (name.empty()) element.refuse("has neither name nor file");
    if (!terrains_.try_emplace(name, &tree).second) element.refuse("there are two of this name");
}

std::shared_ptr<const Shape> Mjcf::terrain_of(Element& geom, Placed& placed) {
    const std::string name = geom.text("hfield");
    const auto found = terrains_.find(name);
    if (found == terrains_.end()) geom.refuse("hfield", "there is no hfield \"" + name + "\"");
    Element asset = element(*found->second, {});
    std::string file = asset.text("file");
    if (!file.empty()) {
        if (compiler_.strip) file = file.substr(file.find_last_of("/\\") + 1);
        const std::string& folder = compiler_.meshes.empty() ? compiler_.assets : compiler_.meshes;
        if (!folder.empty() && !file.starts_with('/')) file = folder + "/" + file;
        asset.pass({"nrow", "ncol", "elevation", "content_type"});
    }
    Grid grid = file.empty() ? grid_of_text(asset) : grid_of_file(asset, folder_.bytes(asset.origin(), file));
    const std::vector<double> size = asset.numbers("size", 4, 4);
    if (size.empty()) asset.refuse("size", "is missing");
    for (std::size_t k = 0; k < 3; ++k)
        if (!(size[k] > 0 && size[k] <= 1e5)) asset.refuse("size", "must be above 0 and at most 100000 m");
    asset.finish();
    // Heights are rescaled to all that lies between 0 and the third size.
    const auto [least, most] = std::minmax_element(grid.heights.begin(), grid.heights.end());
    const double low = *least, range = *most - low;
    for (double& height : grid.heights) height = range > 0 ? (height - low) / range * size[2] : 0;
    const double dx = 2 * size[0] / static_cast<double>(grid.columns - 1), dy = 2 * size[1] / static_cast<double>(grid.rows - 1);
    placed = {};
    if (std::abs(dx - dy) > 1e-6 * dx) return std::make_shared<Shape>(mesh_of_grid(grid, size[0], size[1]));
    HeightField field;
    field.columns = static_cast<std::uint32_t>(grid.columns);
    field.rows = static_cast<std::uint32_t>(grid.rows);
    field.spacing = static_cast<float>(dx);
    for (std::size_t r = grid.rows; r-- > 0;)  // its rows go along z, which is -y here, and y is up
        for (std::size_t c = 0; c < grid.columns; ++c)
            field.heights.push_back(static_cast<float>(grid.heights[r * grid.columns + c]));
    placed.turn = dquat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
    return std::make_shared<Shape>(std::move(field));
}

}  // namespace scree::imports
