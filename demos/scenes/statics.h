// Builders of statics with friction: masonry arches, and ropes round a peg.
#pragma once

#include <vector>

#include "compute/scene.h"

namespace scree::demos {

// A semicircular arch of equal stones, of density 2000 kg/m^3 and friction 0.8, along x, as deep as a fifth of its radius.
struct Arch {
    float radius;     // of the centre line, m
    float thickness;  // of the radius
    int stones;
};
// Adds the stones, from +x to -x, and returns their indices. `centre`: of the arch's circle.
std::vector<std::size_t> add_arch(Scene& scene, const Arch& arch, vec3 centre);

// A rope of links over the upper half of a peg of friction 1 along z, with a weight at each end: the right one (+x) pulls
// `ratio` times as much as the left one.
struct Rope {
    float friction;  // on the peg
    double ratio;
    float z;  // m, where it hangs
};
Body peg();  // fixed at the origin
// Adds links, weights and joints, and returns the left weight's index.
std::size_t add_rope(Scene& scene, const Rope& rope);

}  // namespace scree::demos
