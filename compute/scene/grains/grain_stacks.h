// Places for grains that are there at the start: boxes put on one another, on narrow columns whose heights are known.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "compute/grains.h"
#include "compute/scene/random.h"

namespace scree {

class GrainStacks {
public:
    // `largest`: the longest side of any grain's box, m.
    GrainStacks(const GrainRegion& region, double largest, std::uint64_t seed);

    struct Place {
        glm::dvec3 low{0}, size{0};  // m; at least as large as the box
    };
    // A place for a box: of some at random the lowest. None if the region is too narrow for it.
    std::optional<Place> put(const glm::dvec3& box);

private:
    bool is_inside(std::uint32_t x, std::uint32_t z) const;  // a column, of a cylinder

    glm::dvec3 low_{0};
    double wide_x_ = 0, wide_z_ = 0, radius_ = 0, gap_ = 0;  // m
    std::uint32_t columns_ = 0, rows_ = 0;
    std::vector<double> heights_;  // m, above the region's floor; of what is outside of it infinite
    SeededRandom random_;
};

double volume_of(const GrainRegion& region);  // m^3

}  // namespace scree
