// The bodies of a world at one moment, for queries: for each copy of the scene
// a tree over bodies, parts and triangles; planes apart.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compute/queries.h"
#include "compute/scene/meshes/bounds_tree.h"
#include "compute/tables/state.h"
#include "compute/world/queries/query_shapes.h"

namespace scree {

class QueryScene {
public:
    // Refers to both, whose poses must be up to date.
    QueryScene(const Scene& scene, const State& state);

    static float longest(float reach);                         // m, of queries without a limit one that sums can bear
    static bool nearer(const QueryHit& x, const QueryHit& y);  // of two hits the one that counts
    // `any`: not always the nearest one.
    std::optional<QueryHit> nearest(const RayQuery& ray, bool any) const;
    std::vector<QueryHit> all(const RayQuery& ray) const;
    using Pieces = std::span<const QueryShapes::Piece>;
    std::optional<QueryHit> nearest(const ShapeCast& cast, Pieces pieces, physics::Hulls hulls) const;
    std::optional<QueryHit> closest(const ClosestQuery& query) const;
    std::vector<Penetration> penetrated(const ShapeOverlap& query, Pieces pieces, physics::Hulls hulls, bool with_depths) const;

private:
    struct Leaf {
        std::uint32_t row, body, part;
    };
    bool sees(const Leaf& leaf, std::uint32_t mask, std::size_t ignored = no_body) const;
    // `near`: where the ray enters the leaf's box, m.
    std::optional<QueryHit> hit(const Leaf& leaf, const RayQuery& ray, float near) const;
    std::optional<QueryHit> cast_at(const Leaf& leaf, const ShapeCast& cast, const QueryShapes::Piece& piece,
                                    physics::Hulls hulls, float reach) const;
    // Distance of a piece from a leaf, m: at most the true one, and not positive if they overlap; normal from the leaf.
    float gap(const Leaf& leaf, const QueryShapes::Piece& piece, physics::Hulls hulls, vec3* normal = nullptr) const;

    struct Bodies {
        std::vector<Leaf> leaves, planes;
        BoundsTree tree;
    };

    const Scene& scene_;
    const State& state_;
    std::vector<Bodies> of_;  // by copy of the scene
};

}  // namespace scree
