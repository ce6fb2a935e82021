// Tables that edits alone change, in their order in a checkpoint.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "compute/tables/state.h"

namespace scree {

// A checkpoint holds those of joints as a whole, and of shapes what lies behind the lengths at the start.
#define SCREE_EDITED_OF_JOINTS(X) X(joints) X(joint_blocks) X(block_bodies) X(vehicles)
// clang-format off
#define SCREE_EDITED_OF_SHAPES(X)                                   \
    X(hulls) X(parts) X(fractures) X(pieces) X(tyres) X(filters)    \
    X(exclusions) X(surfaces) X(immersions) X(births) X(gravities) \
    X(bonds) X(bond_states)
// clang-format on

// Lengths of tables whose records never change, in the scene with which the world was made: edits append to them. Other tables
// may change from their first record on.
struct StartLengths {
    std::size_t hulls = 0, pieces = 0, tyres = 0;
    static StartLengths of(const State& state) { return {state.hulls.size(), state.pieces.size(), state.tyres.size()}; }
    std::size_t of(Table table) const {
        return table == Table::hulls ? hulls : table == Table::pieces ? pieces : table == Table::tyres ? tyres : 0;
    }
    bool operator==(const StartLengths&) const = default;
};

// A list of records as bytes, which may lie at any address.
template <class Record>
class RecordBytes {
public:
    RecordBytes(std::span<const std::byte> bytes = {}) : bytes_(bytes) {}  // NOLINT(google-explicit-constructor)
    std::size_t size() const { return bytes_.size() / sizeof(Record); }
    Record operator[](std::size_t i) const {
        Record record;
        std::memcpy(&record, bytes_.data() + i * sizeof(Record), sizeof(Record));
        return record;
    }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
};

// In a checkpoint, by the names of the tables.
struct EditedTables {
#define SCREE_MEMBER(name) RecordBytes<physics::records::name> name;
    SCREE_EDITED_OF_JOINTS(SCREE_MEMBER)
    SCREE_EDITED_OF_SHAPES(SCREE_MEMBER)
#undef SCREE_MEMBER
};

}  // namespace scree
