// Pseudo-random numbers, equal on every machine: PCG32 (O'Neill 2014), 64 bits of state, 32 bits of output.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace scree {

class SeededRandom {
public:
    explicit SeededRandom(std::uint64_t seed) : state_(seed + increment) { bits(); }
    // One of many independent sequences of a seed: neighbouring numbers are mixed first (SplitMix64, Steele et al. 2014).
    SeededRandom(std::uint64_t seed, std::uint64_t sequence) : SeededRandom(mixed(mixed(seed) + sequence)) {}

    std::uint32_t bits() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005u + increment;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<std::uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }
    // 24 random bits convert to float exactly, so no rounding differs between machines.
    float unit() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    // z is drawn first. Draws in the arguments of one call have no order that all compilers keep.
    glm::vec3 vector(float low, float high) {
        const float z = between(low, high), y = between(low, high), x = between(low, high);
        return {x, y, z};
    }

    // A uniformly distributed orientation, by rejection sampling in the 4-ball, since sin and cos differ between C
    // libraries.
    glm::vec4 orientation() {
        for (;;) {
            const float x = between(-1, 1), y = between(-1, 1), z = between(-1, 1), w = between(-1, 1);
            const float squared = x * x + y * y + z * z + w * w;
            if (squared < 1 && squared > 0.01f) return glm::vec4(x, y, z, w);  // normalised by scene validation
        }
    }

private:
    static std::uint64_t mixed(std::uint64_t x) {
        x += 0x9E3779B97F4A7C15u;
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
        return x ^ (x >> 31);
    }
    static constexpr std::uint64_t increment = 1442695040888963407u;
    std::uint64_t state_;
};

}  // namespace scree
