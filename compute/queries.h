// Queries of a world in batches: rays, shapes that are cast, overlaps and their depths, against the bodies as they are now.
//
//     std::vector<scree::RayQuery> rays = ...;
//     const std::vector<std::optional<scree::QueryHit>> hits = world.cast_rays(rays);  // the nearest of each
//
// Bodies may sleep, be fixed or kinematic. Results are complete and the same bits on every backend and with any number of
// threads; of equally near hits the one with the lowest body, then part, counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "compute/scene.h"

namespace scree {

struct RayQuery {
    vec3 from{0};                     // m
    vec3 along{0, 0, -1};             // unit
    float reach = unlimited;          // m, > 0; as of all queries, infinity and `unlimited` are no limit
    std::uint32_t mask = 0xFFFFFFFF;  // of the categories of bodies and parts (Filter) that it sees
    bool solid = true;                // a body in which the ray begins is hit at distance 0; false: is not seen
    std::size_t copy = 0;             // of the scene, in a world of several
};

// A convex shape, or a compound of solid convex parts, that moves along a line without turning. No plane, mesh or height field.
struct ShapeCast {
    Shape shape = Sphere{};
    vec3 from{0};                     // of its centre, m; of a hull or compound the origin of its points or parts
    vec4 orientation{0, 0, 0, 1};     // quaternion x, y, z, w of any length but 0
    vec3 along{0, 0, -1};             // unit
    float reach = 1;                  // m, >= 0
    std::uint32_t mask = 0xFFFFFFFF;  // as of a ray
    std::size_t copy = 0;             // likewise
    bool solid = true;  // a body that it overlaps at the start is hit at distance 0; false: only if it moves deeper in,
                        // by more than a thousandth of its way
    std::size_t ignored = no_body;  // a body that it passes through: that of the character which it is cast for, say
};

// Such a shape somewhere.
struct ShapeOverlap {
    Shape shape = Sphere{};
    vec3 position{0};              // as `from` of a cast, m
    vec4 orientation{0, 0, 0, 1};  // quaternion x, y, z, w of any length but 0
    std::uint32_t mask = 0xFFFFFFFF;
    std::size_t copy = 0;           // as of a ray
    std::size_t ignored = no_body;  // as of a cast
};

// The point of any body that is nearest to a point.
struct ClosestQuery {
    vec3 point{0};                    // m
    float reach = 1;                  // m, > 0: what is further away is not found
    std::uint32_t mask = 0xFFFFFFFF;  // as of a ray
    std::size_t copy = 0;             // likewise
};

struct QueryHit {
    std::size_t body = 0;
    std::uint32_t part = 0;  // of a compound the part, of a mesh or height field the triangle
    float distance = 0;      // along the ray or cast, m; 0 if it begins in the body
    vec3 point{0};           // on the surface, m; of a cast where `from` has come to; of a
                             // point in the body that itself
    vec3 normal{0};          // of the surface, unit, outward; where it begins in the body against its direction,
                             // of a cast that is not solid that in which they come apart soonest
};

// Lists of several queries, one after the other.
template <class Item>
struct QueryLists {
    std::vector<std::size_t> starts;  // of each list, and the end of the last
    std::vector<Item> items;
    std::span<const Item> operator[](std::size_t query) const& {
        return std::span(items).subspan(starts[query], starts[query + 1] - starts[query]);
    }
    // Of lists that are about to end a copy: for (... : world.overlaps(shapes)[0]).
    std::vector<Item> operator[](std::size_t query) && {
        const std::span<const Item> list = std::as_const(*this)[query];
        return {list.begin(), list.end()};
    }
};

struct QueryPart {
    std::size_t body = 0;
    std::uint32_t part = 0;
    bool operator==(const QueryPart& o) const { return body == o.body && part == o.part; }
};

// How deep a shape is in a body, of a compound its deepest part. The depth is the least of all directions: between spheres,
// capsules, boxes and planes to rounding; of other convex shapes a search finds it, and may miss it.
struct Penetration {
    std::size_t body = 0;
    std::uint32_t part = 0;  // as of a hit
    float depth = 0;         // m, >= 0
    vec3 normal{0};          // unit, from the body: moved by `depth` along it the shape (of a compound the part) only touches
};

}  // namespace scree
