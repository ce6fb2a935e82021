// Images of what is in a periodic cell, as measures see them: of a medium that goes on for ever.
#pragma once

#include <glm/glm.hpp>

#include "compute/measures/solid.h"

namespace scree {

class Images {
public:
    explicit Images(const PeriodicCell& cell) : cell_(cell), size_(cell.size) {}

    // The shortest of the ways to a point and its images.
    glm::dvec3 nearest(glm::dvec3 way) const {
        for (int k = 0; k < 3; ++k) {
            if (!(size_[k] > 0)) continue;
            if (way[k] > 0.5 * size_[k]) way[k] -= size_[k];
            if (way[k] < -0.5 * size_[k]) way[k] += size_[k];
        }
        return way;
    }
    // Of a point and its images the one nearest to a place.
    glm::dvec3 nearest_to(glm::dvec3 place, glm::dvec3 point) const {
        return cell_.any() ? place + nearest(point - place) : point;
    }
    // Calls take(shift) for what is within `bounds` and those of its images that are within a region: from it to them, m.
    template <class Take>
    void for_each(const Span& bounds, const Span& region, const Take& take) const {
        if (!cell_.any()) return take(glm::dvec3(0));
        const glm::ivec3 first(size_.x > 0 ? -1 : 0, size_.y > 0 ? -1 : 0, size_.z > 0 ? -1 : 0);
        for (glm::ivec3 at = first; at.z <= -first.z; ++at.z)
            for (at.y = first.y; at.y <= -first.y; ++at.y)
                for (at.x = first.x; at.x <= -first.x; ++at.x) {
                    const glm::dvec3 shift = glm::dvec3(at) * size_;
                    if (glm::all(glm::lessThanEqual(bounds.lower + shift, region.upper)) &&
                        glm::all(glm::lessThanEqual(region.lower, bounds.upper + shift)))
                        take(shift);
                }
    }
    // The cell along its periodic axes, else what is given.
    Span cell_or(Span bounds) const {
        for (int k = 0; k < 3; ++k) {
            if (!(size_[k] > 0)) continue;
            bounds.lower[k] = double{cell_.centre[k]} - 0.5 * size_[k];
            bounds.upper[k] = double{cell_.centre[k]} + 0.5 * size_[k];
        }
        return bounds;
    }

private:
    PeriodicCell cell_;
    glm::dvec3 size_;
};

}  // namespace scree
