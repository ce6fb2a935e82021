// What measures read of a world at a moment: its grains, and the contacts that press.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "compute/measures/images.h"
#include "compute/measures/solid.h"
#include "compute/world.h"

namespace scree::granular {

struct Grain {
    std::size_t body = 0;
    glm::dvec3 position{0}, velocity{0};
    double mass = 0, volume = 0;  // kg, m^3
    std::vector<Solid> solids{};
};

// A contact that presses.
struct Touch {
    std::size_t a = 0, b = 0;
    glm::dvec3 normal{0}, middle{0};
    double force = 0;  // normal, N
    struct Point {
        glm::dvec3 position{0}, force{0};  // on b
    };
    std::array<Point, 4> points{};
    std::uint32_t count = 0;
};

// Units that make every term at most 1, powers of two: what they divide stays exact.
struct Units {
    double force = 1, branch = 1, mass = 1, speed = 1, way = 1, volume = 1, diameter = 1;
};

// By body, 1 or 0: solid dynamic bodies that exist are grains, unless a joint makes them a machine's part. `states`:
// world.bodies().
std::vector<std::uint8_t> grains_among(const World& world, const std::vector<BodyState>& states);

constexpr std::size_t no_grain = static_cast<std::size_t>(-1);

// All that is read of a world at a moment.
struct Scan {
    std::vector<Grain> grains;
    std::vector<std::size_t> grain_of;  // by body
    std::vector<BodyState> states;
    std::vector<Touch> touches;
    std::vector<std::uint32_t> neighbours;  // by grain: bodies that press on it
    std::vector<std::uint8_t> rattler;
    Units units;
    Images images;

    Scan(const World& world, std::size_t copy);
    const Grain* grain(std::size_t body) const { return grain_of[body] == no_grain ? nullptr : &grains[grain_of[body]]; }

private:
    void take_grains(const World& world, std::size_t first, std::size_t last);
    void take_touches(const World& world, std::size_t first, std::size_t last);
    void count_neighbours();
    void choose_units();
};

double length_of(glm::dvec3 v);
double diameter_of(const Grain& grain);  // m, of the ball of its volume

}  // namespace scree::granular
