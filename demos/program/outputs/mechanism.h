// What a scene is as a mechanism: degrees of freedom, joints with limits and drives, couplings, masses.
#pragma once

#include <cstddef>
#include <string>

#include "compute/scene.h"

namespace scree::demos {

// Of a tree of joints the degrees are 6 of each free body less what joints and couplings take (Gruebler). Where joints close
// loops, what they take may repeat: then the number is a least one.
struct Mobility {
    std::size_t moving = 0, fixed = 0, kinematic = 0;  // bodies, fragments of whole ones left out
    double mass = 0;                                   // kg, of those that move
    std::size_t free_bases = 0;  // groups of joined bodies that no joint holds to the world or to a body that is not dynamic
    std::size_t joint_degrees = 0;
    std::size_t couplings = 0;  // that take a degree each
    std::size_t loops = 0;      // that joints close
    std::size_t degrees = 0;    // 6 a free base, and those of joints, less couplings and 6 a loop; not below 0
};
Mobility mobility_of(const Scene& scene);  // the scene must be checked

// As text with a table of the joints, and as JSON.
std::string mechanism_text(const Scene& scene, const std::string& title);
std::string mechanism_json(const Scene& scene, const std::string& title);

}  // namespace scree::demos
