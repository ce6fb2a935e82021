// Bonds between all bodies that are near each other: cemented grains, sandstone, concrete.
#pragma once

#include <cstddef>
#include <string>

#include "compute/scene.h"

namespace scree {

// Which bodies are bonded, and how. Sizes are those of balls; other bodies count as the ball of their volume, and what has no
// volume is not bonded.
struct Bonding {
    std::string bodies{};       // the body of that name and those called "NAME 17", as grains are; empty: all
    std::string with{};         // these are bonded to those; empty: among themselves
    float gap = 0.1f;           // between surfaces at most, of the smaller radius, 0 to 10
    float radius = 1;           // of a bond, of the smaller radius, above 0 to 10
    float stiffness = 0;        // as of a Bond
    float damping = 0.5f;       // likewise
    float tension = unlimited;  // likewise
    float shear = unlimited;    // likewise
};

// Bonds bodies of the scene as it is at present, and returns the number of new bonds. Pairs that are bonded already, and those
// that never move, are left out. Throws SceneError, its pointer beginning with `place`, for values out of range and names that
// no body has.
std::size_t add_bonds(Scene& scene, const Bonding& bonding, const std::string& place = "/bonds/0");

}  // namespace scree
