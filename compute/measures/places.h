// Where measures are taken: regions, and the cells of a grid.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>

#include "compute/measures.h"
#include "compute/measures/solid.h"

namespace scree {

Span bounds_of(const MeasureShape& shape);
double volume_of(const MeasureShape& shape);  // m^3
bool holds(const MeasureShape& shape, glm::dvec3 point);
double share_of(const MeasureShape& shape, glm::dvec3 from, glm::dvec3 to);  // of the way that is within, 0 to 1
double volume_within(const Solid& solid, const MeasureShape& shape);         // m^3

// The cells of a grid, by index: x fastest, then y, then z.
class Cells {
public:
    explicit Cells(const MeasureGrid& grid);
    glm::uvec3 count() const { return count_; }
    std::size_t size() const { return std::size_t{count_.x} * count_.y * count_.z; }
    Span bounds() const { return {lower_, lower_ + cell_ * glm::dvec3(count_)}; }
    double volume() const { return cell_.x * cell_.y * cell_.z; }
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t at(glm::dvec3 point) const;  // none: it is outside
    // Calls take(cell, share) with the cells on a way and the shares that they have of it.
    void walk(glm::dvec3 from, glm::dvec3 to, const std::function<void(std::size_t, double)>& take) const;
    // Calls take(cell, volume) with the cells that a solid is in.
    void fill(const Solid& solid, const std::function<void(std::size_t, double)>& take) const;

private:
    Span span_of(glm::ivec3 cell) const;
    std::size_t index_of(glm::ivec3 cell) const;
    double edge(int axis, int k) const { return lower_[axis] + cell_[axis] * k; }
    int place(int axis, double x) const;  // of the cell, which may be outside

    glm::dvec3 lower_, cell_;
    glm::uvec3 count_;
};

}  // namespace scree
