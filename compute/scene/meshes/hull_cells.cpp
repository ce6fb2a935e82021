// Clips the cells of a cube map by the normal cones of a hull's vertices.
#include "compute/scene/meshes/hull_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compute/scene/portable_math.h"

namespace scree {

namespace {

using glm::dvec2;
using glm::dvec3;

// Tangent of the angle beyond a cell that its vertices cover: that of edges counted as flat (collide_convex.h).
constexpr double beyond_cell = 0.0315;
// Relative to the hull's radius: float rounding in comparing two vertices.
constexpr double rounding = 1e-5;
// Vertex counts from which coarse cells pay off, and fine ones.
constexpr std::size_t some_corners = 9, many_corners = 20;

// The directions of one cube side: (ahead, u, v), ahead = 1 or -1, along the axes from `axis` on.
struct Side {
    int axis;
    double ahead;
    dvec3 direction(dvec2 uv) const {
        dvec3 d;
        d[axis] = ahead;
        d[(axis + 1) % 3] = uv.x;
        d[(axis + 2) % 3] = uv.y;
        return d;
    }
    // Coefficients over (u, v, 1) whose sum is the dot product of the direction and v.
    dvec3 product(const dvec3& v) const { return {v[(axis + 1) % 3], v[(axis + 2) % 3], ahead * v[axis]}; }
};

double at(const dvec3& line, dvec2 uv) {
    return line.x * uv.x + line.y * uv.y + line.z;
}

using Polygon = std::vector<dvec2>;
// The part of a convex polygon where the line is at most 0.
void clip(Polygon& polygon, const dvec3& line, Polygon& clipped) {
    clipped.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double of_p = at(line, p), of_q = at(line, q);
        if (of_p <= 0) clipped.push_back(p);
        if ((of_p <= 0) != (of_q <= 0)) clipped.push_back(p + (q - p) * (of_p / (of_p - of_q)));
    }
    polygon.swap(clipped);
}

// The cell from `low` on, enlarged to all directions near it.
Polygon around(const Side& side, dvec2 low, double width) {
    const dvec2 high = low + dvec2(width);
    const dvec2 farthest = glm::max(glm::abs(low), glm::abs(high));
    const double way = beyond_cell * glm::length(side.direction(farthest));
    const dvec2 more = (dvec2(1) + farthest) * (way / (1 - way));
    return {low - more, {high.x + more.x, low.y - more.y}, high + more, {low.x - more.x, high.y + more.y}};
}

std::vector<std::vector<std::uint32_t>> neighbours_in(const HullForm& form) {
    std::vector<std::vector<std::uint32_t>> neighbours(form.vertices.size());
    for (const HullForm::Face& face : form.faces) {
        for (std::size_t k = 0; k < face.corners.size(); ++k)
            neighbours[face.corners[k]].push_back(face.corners[(k + 1) % face.corners.size()]);
    }
    return neighbours;
}

void set_byte(physics::uvec4& record, std::size_t k, std::size_t value) {
    record[static_cast<int>(k / 4)] |= static_cast<physics::uint>(value) << (8 * (k % 4));
}

}  // namespace

HullCells hull_cells(const HullForm& form) {
    HullCells result;
    if (form.vertices.size() < some_corners) return result;
    const physics::uint across = form.vertices.size() < many_corners ? 2 : 4;
    result.across = across;
    double reach = 0;
    for (const dvec3& v : form.vertices) reach = std::max(reach, glm::length(v));
    const double slack = rounding * reach;
    const auto neighbours = neighbours_in(form);
    Polygon part, scratch;
    std::vector<std::size_t> near;
    std::vector<std::pair<double, std::size_t>> looks(form.faces.size());
    for (int number = 0; number < 6; ++number) {
        const Side side{number / 2, number % 2 == 0 ? -1.0 : 1.0};
        for (physics::uint cell = 0; cell < across * across; ++cell) {
            const double width = 2.0 / across;
            const dvec2 low(-1 + width * (cell / across), -1 + width * (cell % across));
            const std::array corners{low, low + dvec2(width, 0), low + dvec2(width, width), low + dvec2(0, width)};
            HullCells::Cell& made = result.cells.emplace_back(HullCells::Cell{physics::uvec4(0), physics::uvec4(0)});

            const Polygon wider = around(side, low, width);
            // A vertex supports a direction where it reaches farther than its neighbours.
            near.clear();
            for (std::size_t i = 0; i < form.vertices.size(); ++i) {
                part = wider;
                for (const std::uint32_t other : neighbours[i]) {
                    clip(part, side.product(form.vertices[other] - form.vertices[i]) - dvec3(0, 0, slack), scratch);
                    if (part.empty()) break;
                }
                if (!part.empty()) near.push_back(i);
            }
            if (near.size() <= physics::LISTED_VERTICES) {
                set_byte(made.vertices, 0, near.size());
                for (std::size_t k = 0; k < near.size(); ++k) set_byte(made.vertices, k + 1, near[k]);
            }

            const dvec3 middle = glm::normalize(side.direction(low + dvec2(width / 2)));
            double spread = 0;
            for (const dvec2 corner : corners)
                spread = std::max(spread, portable::acos(glm::dot(middle, glm::normalize(side.direction(corner)))));
            for (std::size_t i = 0; i < form.faces.size(); ++i) {
                const double angle = portable::acos(std::clamp(glm::dot(middle, form.faces[i].normal), -1.0, 1.0));
                looks[i] = {portable::cos(std::max(angle - spread, 0.0)), i};
            }
            const std::size_t listed = std::min<std::size_t>(looks.size(), physics::LISTED_FACES);
            std::partial_sort(looks.begin(), looks.begin() + static_cast<long>(std::min(listed + 1, looks.size())), looks.end(),
                              [](const auto& a, const auto& b) { return a.first > b.first; });
            const double beyond = listed < looks.size() ? looks[listed].first : -1;
            std::sort(looks.begin(), looks.begin() + static_cast<long>(listed),
                      [](const auto& a, const auto& b) { return a.second < b.second; });
            set_byte(made.faces, 0, listed);
            set_byte(made.faces, 1, static_cast<std::size_t>((beyond + 1) * 126) + 1);
            for (std::size_t k = 0; k < listed; ++k) set_byte(made.faces, k + 2, looks[k].second);
        }
    }
    return result;
}

}  // namespace scree
