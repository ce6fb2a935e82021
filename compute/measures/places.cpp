// Regions and grids: what is within, of points, ways and solids.
#include "compute/measures/places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace scree {

namespace {

using glm::dvec3;

constexpr double pi = std::numbers::pi;

struct Stretch {  // of a way
    double from = 0, to = 1;
    double length() const { return std::max(0.0, to - from); }
};

// Where start + t way lies between two limits.
void cut(Stretch& stretch, double start, double way, double low, double high) {
    if (way == 0) {
        if (!(start >= low && start < high)) stretch.to = stretch.from;
        return;
    }
    const double a = (low - start) / way, b = (high - start) / way;
    stretch.from = std::max(stretch.from, std::min(a, b));
    stretch.to = std::min(stretch.to, std::max(a, b));
}
// Where |start + t way| is at most r.
void cut_round(Stretch& stretch, dvec3 start, dvec3 way, double r) {
    const double a = glm::dot(way, way), b = glm::dot(start, way), c = glm::dot(start, start) - r * r;
    if (a == 0) {
        if (c > 0) stretch.to = stretch.from;
        return;
    }
    const double squared = b * b - a * c;
    if (squared <= 0) {
        stretch.to = stretch.from;
        return;
    }
    stretch.from = std::max(stretch.from, (-b - std::sqrt(squared)) / a);
    stretch.to = std::min(stretch.to, (-b + std::sqrt(squared)) / a);
}

struct Shaft {
    dvec3 from, along;
    double length;
};
Shaft axis_of(const MeasureCylinder& cylinder) {
    const dvec3 way = dvec3(cylinder.to) - dvec3(cylinder.from);
    const double length = std::sqrt(glm::dot(way, way));
    return {dvec3(cylinder.from), way / length, length};
}

Span bounds(const MeasureBox& box) {
    return {dvec3(box.lower), dvec3(box.upper)};
}
Span bounds(const MeasureSphere& ball) {
    return {dvec3(ball.centre) - double{ball.radius}, dvec3(ball.centre) + double{ball.radius}};
}
Span bounds(const MeasureCylinder& cylinder) {
    const Shaft axis = axis_of(cylinder);
    dvec3 reach(0);
    for (int k = 0; k < 3; ++k) reach[k] = double{cylinder.radius} * std::sqrt(std::max(0.0, 1 - axis.along[k] * axis.along[k]));
    const dvec3 from(cylinder.from), to(cylinder.to);
    return {glm::min(from, to) - reach, glm::max(from, to) + reach};
}

double volume(const MeasureBox& box) {
    const dvec3 edges = dvec3(box.upper) - dvec3(box.lower);
    return edges.x * edges.y * edges.z;
}
double volume(const MeasureSphere& ball) {
    const double r = ball.radius;
    return 4.0 / 3.0 * pi * r * r * r;
}
double volume(const MeasureCylinder& cylinder) {
    return pi * double{cylinder.radius} * double{cylinder.radius} * axis_of(cylinder).length;
}

bool inside(const MeasureBox& box, dvec3 point) {
    for (int k = 0; k < 3; ++k)
        if (!(point[k] >= double{box.lower[k]} && point[k] < double{box.upper[k]})) return false;
    return true;
}
bool inside(const MeasureSphere& ball, dvec3 point) {
    const dvec3 away = point - dvec3(ball.centre);
    return glm::dot(away, away) <= double{ball.radius} * double{ball.radius};
}
bool inside(const MeasureCylinder& cylinder, dvec3 point) {
    const Shaft axis = axis_of(cylinder);
    const dvec3 away = point - axis.from;
    const double height = glm::dot(away, axis.along);
    const dvec3 beside = away - axis.along * height;
    return height >= 0 && height < axis.length && glm::dot(beside, beside) <= double{cylinder.radius} * double{cylinder.radius};
}

Stretch within(const MeasureBox& box, dvec3 from, dvec3 to) {
    Stretch stretch;
    for (int k = 0; k < 3; ++k) cut(stretch, from[k], to[k] - from[k], double{box.lower[k]}, double{box.upper[k]});
    return stretch;
}
Stretch within(const MeasureSphere& ball, dvec3 from, dvec3 to) {
    Stretch stretch;
    cut_round(stretch, from - dvec3(ball.centre), to - from, double{ball.radius});
    return stretch;
}
Stretch within(const MeasureCylinder& cylinder, dvec3 from, dvec3 to) {
    const Shaft axis = axis_of(cylinder);
    const dvec3 away = from - axis.from, way = to - from;
    const double height = glm::dot(away, axis.along), climb = glm::dot(way, axis.along);
    Stretch stretch;
    cut(stretch, height, climb, 0, axis.length);
    cut_round(stretch, away - axis.along * height, way - axis.along * climb, double{cylinder.radius});
    return stretch;
}

bool apart(const Span& a, const Span& b) {
    for (int k = 0; k < 3; ++k)
        if (a.lower[k] >= b.upper[k] || a.upper[k] <= b.lower[k]) return true;
    return false;
}

}  // namespace

Span bounds_of(const MeasureShape& shape) {
    return std::visit([](const auto& one) { return bounds(one); }, shape);
}
double volume_of(const MeasureShape& shape) {
    return std::visit([](const auto& one) { return volume(one); }, shape);
}
bool holds(const MeasureShape& shape, dvec3 point) {
    return std::visit([&](const auto& one) { return inside(one, point); }, shape);
}
double share_of(const MeasureShape& shape, dvec3 from, dvec3 to) {
    return std::visit([&](const auto& one) { return within(one, from, to).length(); }, shape);
}
double volume_within(const Solid& solid, const MeasureShape& shape) {
    const Span around = bounds_of(shape);
    if (std::holds_alternative<MeasureBox>(shape)) return volume_within(solid, around);
    if (apart(solid.bounds, around)) return 0;
    bool whole = true;  // regions are convex
    for (int corner = 0; whole && corner < 8; ++corner)
        whole = holds(shape, {(corner & 1) != 0 ? solid.bounds.upper.x : solid.bounds.lower.x,
                              (corner & 2) != 0 ? solid.bounds.upper.y : solid.bounds.lower.y,
                              (corner & 4) != 0 ? solid.bounds.upper.z : solid.bounds.lower.z});
    if (whole) return solid.volume;
    return volume_where(solid, [&](dvec3 point) { return holds(shape, point); });
}

glm::uvec3 cells_of(const MeasureGrid& grid) {
    glm::uvec3 count(1);
    for (int k = 0; k < 3; ++k) {
        // As many as fit, and another one for more than a thousandth of one.
        const double cells = std::ceil((double{grid.upper[k]} - double{grid.lower[k]}) / double{grid.cell[k]} - 1e-3);
        count[k] = static_cast<glm::uint>(std::clamp(cells, 1.0, 4e9));
    }
    return count;
}

Cells::Cells(const MeasureGrid& grid) : lower_(grid.lower), cell_(grid.cell), count_(cells_of(grid)) {}

Span Cells::span_of(glm::ivec3 cell) const {
    Span span{};
    for (int k = 0; k < 3; ++k) {
        span.lower[k] = edge(k, cell[k]);
        span.upper[k] = edge(k, cell[k] + 1);
    }
    return span;
}
std::size_t Cells::index_of(glm::ivec3 cell) const {
    for (int k = 0; k < 3; ++k)
        if (cell[k] < 0 || cell[k] >= static_cast<int>(count_[k])) return none;
    return static_cast<std::size_t>(cell.x) +
           count_.x * (static_cast<std::size_t>(cell.y) + std::size_t{count_.y} * static_cast<std::size_t>(cell.z));
}
int Cells::place(int axis, double x) const {
    // Just outside is far enough.
    int k = static_cast<int>(std::clamp(std::floor((x - lower_[axis]) / cell_[axis]), -1.0, double(count_[axis])));
    if (k >= 0 && x < edge(axis, k)) --k;
    if (k < static_cast<int>(count_[axis]) && x >= edge(axis, k + 1)) ++k;
    return k;
}
std::size_t Cells::at(dvec3 point) const {
    return index_of({place(0, point.x), place(1, point.y), place(2, point.z)});
}

void Cells::walk(dvec3 from, dvec3 to, const std::function<void(std::size_t, double)>& take) const {
    std::vector<double> cuts{0, 1};
    for (int k = 0; k < 3; ++k) {
        const int first = place(k, std::min(from[k], to[k])), last = place(k, std::max(from[k], to[k]));
        for (int j = first + 1; j <= last; ++j) {
            const double t = (edge(k, j) - from[k]) / (to[k] - from[k]);
            if (t > 0 && t < 1) cuts.push_back(t);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (cuts[i] == cuts[i - 1]) continue;
        const std::size_t cell = at(from + (to - from) * (0.5 * (cuts[i] + cuts[i - 1])));
        if (cell != none) take(cell, cuts[i] - cuts[i - 1]);
    }
}

void Cells::fill(const Solid& solid, const std::function<void(std::size_t, double)>& take) const {
    glm::ivec3 first, last;
    for (int k = 0; k < 3; ++k) {
        first[k] = std::max(0, place(k, solid.bounds.lower[k]));
        last[k] = std::min(static_cast<int>(count_[k]) - 1, place(k, solid.bounds.upper[k]));
    }
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const double within = volume_within(solid, span_of({x, y, z}));
                if (within > 0) take(index_of({x, y, z}), within);
            }
}

}  // namespace scree
