// Random numbers and turns for tests of shapes.
#pragma once

#include <random>

#include "shaders/physics/base/arithmetic.h"

namespace scree::tests {

inline float between(std::mt19937& chance, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(chance);
}
inline vec4 any_turn(std::mt19937& chance) {
    std::normal_distribution<float> normal;
    return glm::normalize(vec4{normal(chance), normal(chance), normal(chance), normal(chance)});
}

}  // namespace scree::tests
