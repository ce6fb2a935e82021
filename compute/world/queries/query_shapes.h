// The shapes of a batch of queries as convex pieces: a convex shape is one, a compound has one for each solid part.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compute/queries.h"
#include "compute/scene/validation/shape_validation.h"
#include "compute/tables/state.h"

namespace scree {

class QueryShapes {
public:
    struct Piece {
        physics::BodyProperties form;  // shape and size
        physics::Pose pose;
    };

    // Of the next query. Throws std::invalid_argument, naming it by `kind` and its number.
    void add(const char* kind, const Shape& shape, vec3 position, vec4 orientation);
    // After all of them: puts their hulls behind those of the bodies, which the pieces then share a table with.
    void join(const State& state);

    std::span<const Piece> of(std::size_t query) const {
        return std::span(pieces_).subspan(starts_[query], starts_[query + 1] - starts_[query]);
    }
    physics::Hulls hulls() const { return {table_}; }

private:
    void add_piece(const char* kind, const SimpleShape& shape, vec3 position, vec4 orientation);

    std::vector<Piece> pieces_;
    std::vector<std::size_t> starts_{0};  // of each query's pieces, and the end of the last
    CheckedShapes shapes_;                // hulls by their points
    std::map<const HullForm*, physics::uint> places_;
    std::vector<physics::uvec4> own_hulls_, joined_;
    const physics::uvec4* table_ = nullptr;
};

}  // namespace scree
