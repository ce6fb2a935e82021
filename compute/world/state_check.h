// Checks of the tables in a checkpoint: what a step would read beyond a table, or without end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "compute/tables/state.h"

namespace scree {

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

private:
    std::span<const std::byte> bytes_;
};

// What a checkpoint says of a state; hulls, pieces and tyres as far as they lie behind those of the start.
struct SavedTables {
    const physics::Parameters& parameters;
    const physics::Counts& counts;
    std::uint32_t body_count = 0;
    const std::vector<std::uint32_t>& rows;  // by id; empty: equal to the ids
    RecordBytes<physics::BodyProperties> properties;
    RecordBytes<physics::Pose> poses;
    RecordBytes<physics::Velocity> velocities;
    RecordBytes<physics::uint> first_contacts;
    RecordBytes<physics::Contact> contacts;
    RecordBytes<physics::Joint> joints;
    RecordBytes<physics::JointBlock> joint_blocks;
    RecordBytes<physics::BlockBody> block_bodies;
    RecordBytes<physics::Vehicle> vehicles;
    RecordBytes<physics::uvec4> hulls;
    RecordBytes<physics::PoseInBody> parts;
    RecordBytes<physics::Fracturing> fractures;
    RecordBytes<physics::PoseInBody> pieces;
    RecordBytes<physics::Tyre> tyres;
    RecordBytes<physics::uvec4> filters, exclusions;
    RecordBytes<physics::Surface> surfaces;
    RecordBytes<physics::Immersion> immersions;
    std::size_t hulls_at_start = 0, pieces_at_start = 0, tyres_at_start = 0;
};

// Throws CheckpointError, which names the table and the record, where an index, a count or a list leads out of its table or
// into a circle, and where a body is nowhere. `own`: the state that is to take the tables, from whose scene they are.
void check_tables(const SavedTables& saved, const State& own);

}  // namespace scree
