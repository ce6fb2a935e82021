// Every table of a step on the host: what the reference runner works on, and the image of what a device holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compute/scene.h"
#include "compute/settings.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/collide/shape_data.h"
#include "shaders/stages/lib/tables.h"

namespace scree {

class Threads;  // compute/step/threads.h

// What tables are as long as.
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
    slots,
    hulls,
    parts,
    fractures,
    pieces,
    tyres,
    way_points,
    joints,
    vehicles,
    actions
};

enum class Table : std::uint32_t {
#define SCREE_NAME(buffer, name, block, record, length) name,
    SCREE_TABLES(SCREE_NAME)
#undef SCREE_NAME
};

// The record of each table, by the table's name.
namespace physics::records {
#define SCREE_RECORD(buffer, name, block, record, length) using name = record;
SCREE_TABLES(SCREE_RECORD)
#undef SCREE_RECORD
}  // namespace physics::records

struct TableInfo {
    const char* name;
    std::size_t record_bytes;
    BufferLength length;
    std::size_t buffer;  // of a device, that holds it
};
#define SCREE_COUNT(buffer, name, block, record, length) +1
inline constexpr std::size_t table_count = 0 SCREE_TABLES(SCREE_COUNT);
#undef SCREE_COUNT
const std::array<TableInfo, table_count>& table_infos();  // by Table

// What of the stages a scene needs.
struct SceneFeatures {
    bool convex = false;        // some body is a cylinder, cone or hull
    bool hulls = false;         // some body is a hull
    bool triangles = false;     // there are meshes or height fields
    bool moving_parts = false;  // there are compounds, or meshes, that move
    bool joints = false;
    bool breaking = false;  // some body may break
    bool vehicles = false;
    bool bounces = false;    // some contact may throw back what strikes it
    bool rolls = false;      // some contact resists rolling
    bool round = false;      // there are spheres or capsules
    bool tyres = false;      // with a vehicle or without
    bool reordered = false;  // rows are in another order than ids
    static SceneFeatures everything() {
        return {.convex = true,
                .hulls = true,
                .triangles = true,
                .moving_parts = true,
                .joints = true,
                .breaking = true,
                .vehicles = true,
                .bounces = true,
                .rolls = true,
                .round = true,
                .tyres = true,
                .reordered = true};
    }
    bool operator==(const SceneFeatures&) const = default;
};
static_assert(sizeof(SceneFeatures) == 12 * sizeof(bool));  // as many as everything() names

// Where the tables hold what several bodies share.
struct ShapePlaces {
    std::map<std::shared_ptr<const HullForm>, physics::uint> hulls;
    std::map<std::pair<float, float>, physics::uint> tyres;
    std::map<std::shared_ptr<const Cut>, physics::uint> cuts;  // in pieces
};

struct State {
#define SCREE_VECTOR(buffer, name, block, record, length) std::vector<physics::records::name> name;
    SCREE_TABLES(SCREE_VECTOR)
#undef SCREE_VECTOR
    // What a table is before it is what its name says.
#define SCREE_VIEW(table, view)          \
    std::vector<physics::uint>& view() { \
        return table;                    \
    }
    SCREE_VIEWS(SCREE_VIEW)
#undef SCREE_VIEW

    // The tables of a checked scene before its first step. `all`: every table has its memory here; else only what the scene
    // itself says, and make() brings the others.
    State(const Scene& scene, const Settings& settings, std::uint32_t group_size, bool all);
    void make(Table table);

    // Last step's contacts become those before; called at the start of every step that is not a repetition.
    void turn_over();

    // Makes room for what the last step asked for and half as much again. What is in the tables stays.
    void grow();

    // Puts bodies into other rows, rows[id] being the new one of each. Rows of parts stay, and those of pieces must (their bodies
    // know them). All that lasts from step to step goes with its body, and no bit of what follows changes; what is left of the
    // last step beside it is of no use any more. Everything that lasts must be here, and the runner be attached again. Where
    // memory ends, nothing has changed.
    void reorder(const std::vector<std::uint32_t>& rows, const Threads& threads);
    bool reordered() const {
        return !rows_.empty();
    }
    // Where a body of the scene is, and which body, or part, is there.
    std::uint32_t row_of(std::size_t id) const {
        return id < rows_.size() ? rows_[id] : static_cast<std::uint32_t>(id);
    }
    std::uint32_t id_of(std::uint32_t row) const {
        return rows_.empty() ? row : ids[row];
    }

    // Items of a table as allocated, and those that mean something at present.
    std::size_t allocated(BufferLength length) const;
    std::size_t live(BufferLength length) const;
    SceneFeatures features() const;
    bool has_joints() const;
    // Whether some body may break.
    bool has_fractures() const {
        return row_content_.breaking;
    }
    // The body that a row of the bodies' tables belongs to: rows behind all bodies are parts of them.
    std::uint32_t body_of(std::uint32_t row) const {
        return row < fixed().first_part ? row : properties[row].owner;
    }
    // Where such a row lies in its body.
    const physics::PoseInBody& part_in(std::size_t row) const {
        return parts[row - fixed().first_part];
    }
    std::size_t bytes() const;                 // of all tables on a device
    std::size_t raw_bytes(Table table) const;  // of one that has its memory

    std::span<std::byte> raw(Table table);
    std::span<const std::byte> raw(Table table) const;

    physics::Parameters& fixed() {
        return parameters[0];
    }
    const physics::Parameters& fixed() const {
        return parameters[0];
    }
    physics::Counts& counted() {
        return counts[0];
    }
    const physics::Counts& counted() const {
        return counts[0];
    }

    physics::Hulls hull_table() const {
        return {hulls.data()};
    }

    int substeps = 1;
    std::uint32_t action_room = 64;            // bodies that the user may act upon in one step; grows
    std::vector<std::uint32_t> joint_records;  // of each joint of the scene

    // The plain loops' own, no table: the first partners of each body as they were counted, so that they need not be sought again
    // to be listed. More than any body has in a heap of equal ones; whoever has more seeks again.
    static constexpr std::size_t noted = 15;
    std::vector<std::array<std::uint32_t, noted>> partners;

    ShapePlaces shape_places;
    std::uint32_t body_count =
        0;  // of the scene's bodies; Parameters::first_part has room for more of them where there are parts
    // For the scene compiler and the editor: every table at its length; what rows that are new bring into the content; how many
    // buckets so many bodies want.
    void allocate();
    void note_content(std::uint32_t first_row, std::uint32_t count);
    static std::uint32_t buckets_for(std::uint32_t bodies);
    // One more body, in the row of its id.
    void append_row(std::uint32_t row) {
        if (reordered()) rows_.push_back(row);
    }

private:
    void number_rows();
    std::vector<std::uint32_t> rows_;  // by id; empty: every body is in the row of its id
    SceneFeatures row_content_;
    bool all_ = true;
};

}  // namespace scree
