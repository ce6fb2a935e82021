// Random joint blocks for the judge of the joint solver.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "compute/scene.h"

namespace scree::oracle {

// Topology and joint kinds of a random block.
struct JointCase {
    std::string name;
    enum class Graph { chain, ring, tree, ladder } graph = Graph::chain;
    enum class Kinds { balls, hinges, driven_hinges, springs, cones, six_degrees, figure, mixed } kinds = Kinds::balls;
    std::size_t bodies = 8;
};
const std::vector<JointCase>& joint_cases();
// Moving bodies with joint drift, too far apart for contacts.
Scene random_block(const JointCase& what, std::uint32_t seed);

}  // namespace scree::oracle
