// The tables of a step by name: their records, lengths and buffers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "shaders/physics/base/copies.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/collide/shape_data.h"
#include "shaders/stages/lib/tables.h"

namespace scree {

// Lengths of tables.
enum class BufferLength {
    one,
    bodies,
    entries,
    bodies_and_end,
    buckets,
    pairs,
    pairs_and_end,
    pair_types,
    candidates,
    scan_blocks,
    contacts,
    impacts,
    contact_sides,
    attractions,
    slots,
    hulls,
    parts,
    fractures,
    pieces,
    tyres,
    surfaces,
    immersions,
    way_points,
    filters,
    exclusions,
    joints,
    joint_blocks,
    block_bodies,
    vehicles,
    copies,
    gravities,
    bonds,
    bond_ends,
    bond_changes,
    actions
};

enum class Table : std::uint32_t {
#define SCREE_NAME(buffer, name, block, record, length) name,
    SCREE_TABLES(SCREE_NAME)
#undef SCREE_NAME
};

// The record type of each table, by the table's name.
namespace physics::records {
#define SCREE_RECORD(buffer, name, block, record, length) using name = record;
SCREE_TABLES(SCREE_RECORD)
#undef SCREE_RECORD
}  // namespace physics::records

struct TableInfo {
    const char* name;
    std::size_t record_bytes;
    BufferLength length;
    std::size_t buffer;       // index of the device buffer that holds it
    bool is_grouped = false;  // on a device (shaders/physics/base/record_groups.h)
};
#define SCREE_COUNT(buffer, name, block, record, length) +1
inline constexpr std::size_t table_count = 0 SCREE_TABLES(SCREE_COUNT);
#undef SCREE_COUNT
const std::array<TableInfo, table_count>& table_infos();  // by Table

// contacts <-> contacts_before and so on, which are swapped after every step.
Table other_parity(Table table);

}  // namespace scree
