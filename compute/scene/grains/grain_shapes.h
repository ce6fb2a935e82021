// Shapes of grains of unit sieve size: families of convex polyhedra, and their measures.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "compute/grains.h"

namespace scree {

// Hulls have these many sizes within an interval of the curve, so that grains share them.
constexpr int hull_sizes = 8;

// The smallest square hole that points pass, in any turn: the least, over all turns, of the larger of two widths that are
// across each other. Found by a coarse search over turns and a finer one around the best of them.
double smallest_hole(const std::vector<glm::dvec3>& points);

// A shape of unit sieve size, about its centre of mass along its principal axes.
struct UnitGrain {
    Shape shape{};
    double volume = 0;  // m^3
};
// The shapes of a family. Throws SceneError at `place`, that of the form.
std::vector<UnitGrain> unit_grains(const GrainForm& form, std::uint64_t seed, const std::string& place);
// Scaled, as checked.
Shape scaled(const UnitGrain& unit, double size);

}  // namespace scree
