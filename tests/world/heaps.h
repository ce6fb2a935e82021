// Scenes for tests of whole worlds: piles of mixed bodies, isolated bodies, and swarms colliding in free space.
#pragma once

#include <cstdint>

#include "compute/scene.h"

namespace scree::tests {

// Pseudo-random numbers, uniform in [-1, 1] and equal on every machine.
class Noise {
public:
    explicit Noise(std::uint32_t seed) : state_(seed) {}
    float operator()() {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<float>(state_ >> 8) / 8388608.0f - 1.0f;
    }
    vec3 vector() {
        const float x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }

private:
    std::uint32_t state_;
};

// A plane through the origin.
Body ground();

// `count` spheres, capsules and boxes of several sizes and materials above a plane, not touching; some have
// restitution, some rolling resistance.
Scene heap(int count, std::uint32_t seed = 1);

// Such a pile without restitution and rolling resistance, one in eight of its bodies 300 times denser.
Scene laden_heap(int count, std::uint32_t seed = 1);

// Such a pile without restitution and rolling resistance, whose boxes break when they land.
Scene brittle_heap(int count, std::uint32_t seed = 1);

// `count` bodies flying towards a common centre without gravity, with the given restitution.
Scene swarm(int count, float restitution, std::uint32_t seed = 1);

// `count` boxes, spheres and capsules in a lattice on the ground that penetrate their neighbours by up to a few
// millimetres: more contacts than bodies from the first step on.
Scene packed(int count, std::uint32_t seed = 1);

// `count` such bodies a metre apart and `height` (m) above the ground, touching nothing but the ground. At height 0:
// exactly `count` contacts from the first step on.
Scene apart(int count, float height = 0, std::uint32_t seed = 1);

}  // namespace scree::tests
