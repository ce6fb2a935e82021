// Broadphase grid: a body fits its level, and every overlapping body looks up its cell.
#include "shaders/physics/collide/grid.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

Parameters grid_of(float cell) {
    Parameters parameters{};
    parameters.cell = cell;
    parameters.inverse_cell = reciprocal(cell);
    parameters.buckets = 1024;
    return parameters;
}

double width(float cell, uint level) {
    return std::ldexp(static_cast<double>(cell), static_cast<int>(level));
}

struct Extent {
    vec3 lower, upper;
    uint level;
};
// Bounds of half extents `half` about `middle`, on the level of the longest side.
Extent extent_of(vec3 middle, vec3 half, const Parameters& grid) {
    Extent box{middle - half, middle + half, 0};
    const vec3 size = box.upper - box.lower;
    box.level = level_of(larger(size.x, larger(size.y, size.z)), grid.inverse_cell);
    return box;
}

}  // namespace

TEST_CASE("a level's cells are as wide as its bodies, and the level below is too fine") {
    for (const float cell : {0.05f, 0.37f, 1.0f, 12.5f}) {
        const float inverse = reciprocal(cell);
        uint before = 0;
        for (float extent = 1e-3f * cell; extent < 1e9f * cell; extent *= 1.0037f) {
            const uint level = level_of(extent, inverse);
            CAPTURE(cell, extent, level);
            REQUIRE(width(cell, level) >= extent * 1.0099);
            if (level > 0) REQUIRE(width(cell, level - 1) < extent * 1.0101);
            REQUIRE(level >= before);
            before = level;
        }
    }
    REQUIRE(level_of(0, 1) == 0);
    REQUIRE(level_of(1e30f, 1) == LEVELS - 1);  // clamped to the coarsest level
}

TEST_CASE("a power of two is one") {
    for (int exponent = -126; exponent <= 127; ++exponent) REQUIRE(power_of_two(exponent) == std::ldexp(1.0f, exponent));
}

TEST_CASE("the cell of bounds is the one that their middle lies in") {
    const float cell = 0.5f;
    for (const uint level : {0u, 1u, 5u}) {
        const float side = static_cast<float>(width(cell, level));
        for (int i = -40; i < 40; ++i) {
            const vec3 middle = vec3(static_cast<float>(i) + 0.5f, static_cast<float>(-i) + 0.25f, 0.75f) * side;
            REQUIRE(cell_of(middle - 0.2f, middle + 0.2f, level, 1 / cell) == ivec3(i, -i, 0));
        }
    }
}

TEST_CASE("bounds that overlap are found in the cells in reach, two or three along each axis") {
    tests::Noise noise(21);
    int met = 0, far_met = 0;
    for (int i = 0; i < 200000; ++i) {
        const Parameters grid = grid_of(i % 2 ? 0.7f : 1.0f);
        // Up to 80,000 of the finest cells from the origin.
        const float distance = i % 3 == 0 ? 0 : i % 3 == 1 ? 500.0f : 50000.0f;
        const vec3 where = noise.vector() * distance;
        const auto half = [&] {
            const vec3 form = vec3(0.6f) + noise.vector() * 0.4f;
            return form * std::exp2(3.0f * noise());
        };
        const Extent a = extent_of(where, half(), grid);
        const vec3 other = half();
        // Distances close to the sum of extents, so that some barely touch.
        const vec3 reach = (a.upper - a.lower) * 0.5f + other;
        const Extent b = extent_of(where + noise.vector() * reach * 1.05f, other, grid);
        const Extent &fine = a.level <= b.level ? a : b, &coarse = a.level <= b.level ? b : a;
        const CellRange range = cells_in_reach(fine.lower, fine.upper, coarse.level, grid);
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(i, axis, range.first[axis], range.last[axis]);
            REQUIRE(range.last[axis] >= range.first[axis]);
            REQUIRE(range.last[axis] - range.first[axis] <= 2);
        }
        if (!boxes_overlap(fine.lower, fine.upper, coarse.lower, coarse.upper)) continue;
        ++met;
        far_met += distance > 1000;
        const ivec3 home = cell_of(coarse.lower, coarse.upper, coarse.level, grid.inverse_cell);
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(i, axis, range.first[axis], home[axis], range.last[axis]);
            REQUIRE(home[axis] >= range.first[axis]);
            REQUIRE(home[axis] <= range.last[axis]);
        }
    }
    REQUIRE(met > 50000);
    REQUIRE(far_met > 10000);
}

TEST_CASE("of two bodies in the grid exactly one owns their pair, and a row of cells is a run of buckets") {
    for (const uint level : {0u, 3u}) {
        for (const uint other : {0u, 1u, 3u}) REQUIRE(owns_pair(5, level, 9, other) != owns_pair(9, other, 5, level));
    }
    for (int y = -3; y < 3; ++y) {
        const uint first = bucket_of(ivec3(-2, y, 7), 2, 64);
        for (int x = -1; x < 80; ++x) REQUIRE(bucket_of(ivec3(x, y, 7), 2, 64) == ((first + uint(x + 2)) & 63u));
    }
}

TEST_CASE("a plane is reached by bounds whose deepest corner is not in front of it") {
    tests::Noise noise(22);
    int reached = 0;
    for (int i = 0; i < 20000; ++i) {
        const vec3 normal = unit3(noise.vector(), vec3(0, 1, 0)), middle = noise.vector() * 3.0f;
        const vec3 half = vec3(0.6f) + noise.vector() * 0.5f, point = noise.vector() * 2.0f;
        double deepest = 1e30;
        for (int corner = 0; corner < 8; ++corner) {
            const vec3 way(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
            deepest = std::min(deepest, glm::dot(glm::dvec3(middle + way) - glm::dvec3(point), glm::dvec3(normal)));
        }
        if (std::abs(deepest) < 1e-5) continue;
        REQUIRE(reaches_plane(middle - half, middle + half, normal, point) == (deepest < 0));
        reached += deepest < 0;
    }
    REQUIRE(reached > 5000);
    REQUIRE(reached < 19000);
}
