// The tables of a state as bytes and back, for checkpoints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "compute/tables/state.h"
#include "compute/tables/table_ranges.h"
#include "compute/world/states/byte_stream.h"
#include "compute/world/states/edited_tables.h"

namespace scree {

// XXH64 over what a new state has from its scene; equal for all settings, backends and threads.
std::uint64_t fingerprint_of(const State& state);
// Likewise, with the hash over the properties, poses and velocities of all bodies and then parts, by id, given.
std::uint64_t fingerprint_of(const State& state, std::uint64_t hash_of_rows);
// XXH64 over the names and record sizes of the tables: those of another one cannot be read.
std::uint64_t layout_of_tables();

// What bytes have of the tables that steps change (lasting_ranges).
enum class SteppedTables {
    all,
    on_device,  // only the properties: the runner keeps the others itself
};
void put_state(ByteWriter& out, const State& state, const StartLengths& at_start, SteppedTables which = SteppedTables::all);
// Its three parts: numbers of the whole state, the tables that steps change with their lengths, and those of shapes and joints.
// `rows_bounce`: of the whole state.
void put_numbers(ByteWriter& out, const State& state, const physics::Parameters& parameters, const physics::Counts& counts,
                 bool rows_bounce);
std::vector<std::pair<Table, std::size_t>> stepped_tables(std::size_t rows, std::size_t contacts, bool bounces,
                                                          SteppedTables which = SteppedTables::all);
void put_shapes(ByteWriter& out, const State& state, const StartLengths& at_start);

// Brings a state, made from the scene with which the saved world was, to what a checkpoint says. Commands that were to come with
// the next step, and grips, are left out. Throws CheckpointError for damaged bytes and those of another scene.
void restore_tables(State& state, std::span<const std::byte> saved);

// The tables in a checkpoint, not yet restored. Refers to the reader's bytes.
class StateBytes {
public:
    // `own`: the state that is to take them. Throws CheckpointError where lengths contradict each other, or indices lead out
    // of their tables (state_check.h).
    StateBytes(ByteReader& in, const State& own, const StartLengths& at_start, SteppedTables which = SteppedTables::all);
    std::uint32_t bodies() const { return body_count_; }
    std::size_t joints() const { return joint_records_.size(); }
    std::size_t vehicles() const { return parameters_.vehicles; }
    // Whether the step's parameters are those of the settings.
    bool follow_from(const Settings& settings, vec3 gravity) const;
    std::uint32_t rows() const { return parameters_.bodies; }
    std::uint32_t first_part() const { return parameters_.first_part; }
    // Replaces all lasting tables of a state with the same `at_start`. Capacities only grow; the runner is to be adapted,
    // and the returned ranges to be uploaded: without those that it keeps itself. Throws std::bad_alloc alone.
    TableRanges restore(State& state) const;

private:
    void check(const State& own) const;

    physics::Parameters parameters_;
    physics::Counts counts_;
    int substeps_;
    std::uint32_t body_count_;
    bool rows_bounce_;
    std::vector<std::uint32_t> rows_, joint_records_;
    std::vector<std::pair<Table, std::span<const std::byte>>> tables_;
    EditedTables edited_;
    StartLengths at_start_;
    SteppedTables which_;
};

}  // namespace scree
