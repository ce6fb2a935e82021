// State: every table of a step on the host, which the reference runner works on and which mirrors a device's.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/tables/cpu_scratch.h"
#include "compute/tables/joint_groups.h"
#include "compute/tables/scene_features.h"
#include "compute/tables/shared_records.h"
#include "compute/tables/table_vectors.h"
#include "shaders/physics/base/contact_impulse.h"
#include "shaders/physics/base/copies.h"
#include "shaders/physics/body/periodic_cell.h"

namespace scree {

class Threads;  // compute/parallel/threads.h

inline const physics::uvec4 no_filter{1u, 0xFFFFFFFFu, 0u, physics::NONE};  // filter.h

// Where a row is, if ranks share the world (compute/distributed).
enum class Presence : std::uint8_t {
    elsewhere,   // on other ranks: its records here are out of date
    ghost,       // of another rank, near a body of this one: its records are sent before they are read
    everywhere,  // not dynamic: every rank has it and moves it alike
    owned
};

struct State : TableVectors {
    // The initial tables of a checked scene. `all`: allocates every table; else only those that the scene defines, and
    // make() allocates others. `copies`: the scene is made of as many copies (scene/copies.h); 0: of none. `ranks` that share
    // the world have a share of its contacts each.
    State(const Scene& scene, const Settings& settings, std::uint32_t group_size, bool all, std::uint32_t copies = 0,
          std::uint32_t ranks = 1);
    void make(Table table);

    // Swaps contacts and contacts_before; called at the start of every step that is not a repetition.
    void turn_over();

    // Grows the lists to what the last step required, with a reserve. Contents stay. Throws std::bad_alloc.
    void grow();
    std::pair<std::uint32_t, std::uint32_t> grown_capacities() const;  // of pairs and of contacts
    static std::uint32_t with_reserve(std::uint64_t need);
    // Returns the memory of contacts beyond a capacity, which those in use fit into.
    void shrink_contacts(std::uint32_t capacity);

    // Moves bodies to other rows: rows[id] is the new one. Rows of parts stay, and those of fragments must (their
    // bodies refer to them). All lasting data moves with its body, and later results stay bit-identical; other data of
    // the last step becomes invalid. Needs all lasting tables here, and the runner to be attached again; or, if the runner moves
    // them in its own tables (Runner::move_rows), only those that the host knows by itself, `contacts_too` false. Strong
    // exception guarantee.
    void reorder(const std::vector<std::uint32_t>& rows, const Threads& threads, bool contacts_too = true);
    // Of all rows, those that reorder() takes their records from.
    std::vector<std::uint32_t> rows_before(const std::vector<std::uint32_t>& rows) const;
    bool reordered() const { return !rows_.empty(); }
    // Row of a body of the scene, and id of a body or part in a row.
    std::uint32_t row_of(std::size_t id) const { return id < rows_.size() ? rows_[id] : static_cast<std::uint32_t>(id); }
    std::uint32_t id_of(std::uint32_t row) const { return rows_.empty() ? row : ids[row]; }
    // For checkpoints: the rows by id (empty: equal to ids). Taking them numbers the rows and notes their features anew, but for
    // restitution that some body may have had.
    const std::vector<std::uint32_t>& rows() const { return rows_; }
    void take_rows(std::vector<std::uint32_t> rows, bool rows_bounce);

    // Set in a rank's share of a world, which has rows of some bodies only (compute/distributed/share.h): the id of the first
    // part.
    std::optional<std::uint32_t> first_part_id;
    bool is_share() const { return first_part_id.has_value(); }
    // Row of a body or part; NONE: a share has none.
    std::uint32_t row_with(std::uint32_t id) const {
        const std::uint32_t first = first_part_id.value_or(fixed().first_part);
        return id < first ? row_of(id) : fixed().first_part + (id - first);
    }
    // For shares, whose `ids` are the caller's: the rows by id.
    void assign_rows(std::vector<std::uint32_t> rows) { rows_ = std::move(rows); }
    void assign_row(std::uint32_t id, std::uint32_t row) { rows_[id] = row; }

    // Records allocated, and records in use at present.
    std::size_t allocated(BufferLength length) const;
    std::size_t live(BufferLength length) const;
    SceneFeatures features() const;
    bool has_joints() const;
    bool is_periodic() const { return physics::is_periodic(fixed()); }
    // Whether steps change motions: bodies break, or are put into quarantine.
    bool changes_motions() const { return has_fractures() || counted().quarantined > 0; }
    // Whether some body is breakable.
    bool has_fractures() const { return row_content_.breaking; }
    // The slots of a body are those from here up to slot_ends[body].
    std::uint32_t first_slot_of(std::size_t body) const { return body == 0 ? 0 : slot_ends[body - 1]; }
    // The row of the body that a row belongs to: rows behind all bodies are parts.
    std::uint32_t body_of(std::uint32_t row) const { return row < fixed().first_part ? row : properties[row].owner; }
    // Whether contacts may have impacts: tables of impacts have a record for each contact, else none.
    bool bounces() const { return rows_bounce() || fixed().least_restitution > 0; }
    // Whether some body has or has had restitution: it may have ended while impacts last.
    bool rows_bounce() const { return row_content_.bounces; }
    // The impulse of a contact, and of one of the last step, with its impact.
    physics::Impulse impulse(std::size_t contact) const {
        return physics::whole_impulse(impulses[contact], bounces() ? impacts[contact] : physics::no_impact());
    }
    physics::Impulse impulse_before(std::size_t contact) const {
        return physics::whole_impulse(impulses_before[contact], bounces() ? impacts_before[contact] : physics::no_impact());
    }
    void keep_impulse(std::size_t contact, const physics::Impulse& impulse) {
        impulses[contact] = physics::contact_impulse_of(impulse);
        if (bounces()) impacts[contact] = physics::contact_impact_of(impulse);
    }
    // Gives the tables of impacts and attractions that are here the length that follows from bounces() and from cohesion;
    // records added are 0.
    void fit_tables();
    // For bounces() that begins between two steps: impacts of the contacts that are there already, none.
    void clear_impacts();
    bool has_copies() const { return physics::has_copies(fixed()); }
    // The copy of the scene that a row belongs to.
    std::uint32_t copy_of(std::uint32_t row) const { return has_copies() ? id_of(body_of(row)) / fixed().bodies_of_copy : 0; }
    // Whether the next step is the first of a copy: contacts before it are those of a life before.
    bool is_newborn(std::uint32_t copy) const { return has_copies() && births[copy] == counted().steps; }
    // The pose of a part in its body.
    const physics::PoseInBody& part_in(std::size_t row) const { return parts[row - fixed().first_part]; }
    bool marks_foreign = false;  // on a rank's device, ROW_FOREIGN and ROW_ELSEWHERE tell the presence
    // By row, if ranks share the world; else empty: all is here.
    std::vector<Presence> presence;
    bool is_here(std::size_t row) const { return presence.empty() || presence[row] != Presence::elsewhere; }
    bool is_stepped(std::size_t row) const {  // here, and not as a ghost
        return presence.empty() || presence[row] >= Presence::everywhere;
    }
    bool is_owned(std::size_t row) const { return presence.empty() || presence[row] == Presence::owned; }
    // Whether this rank counts, saves and sends a contact, which at a border two have.
    bool owns_contact(const physics::Contact& contact) const {
        const std::uint32_t a = body_of(contact.a);
        return is_owned(a) || (presence[a] == Presence::everywhere && is_owned(body_of(contact.b)));
    }
    // Whether this rank solves a block of joints. Bodies of a block have one owner; those that broke are nobody's.
    bool owns_block(const physics::JointBlock& block) const {
        const std::span members = std::span(block_bodies).subspan(block.first_body, block.bodies);
        return presence.empty() || std::any_of(members.begin(), members.end(),
                                               [&](const physics::BlockBody& member) { return is_owned(member.body); });
    }
    std::size_t bytes() const;           // of all tables, as on a device
    std::size_t bytes_of_loops() const;  // of what the CPU loops have beside the tables, by the length in use
    std::size_t bytes_on_host() const;   // of all tables and long caches of a runner that is in_place(), at most
    // What they would be after grow(), before it is called. `on_host`: those of bytes_on_host().
    std::size_t bytes_when_grown(bool on_host);
    std::size_t raw_bytes(Table table) const;  // of an allocated table

    physics::Parameters& fixed() { return parameters[0]; }
    const physics::Parameters& fixed() const { return parameters[0]; }
    physics::Counts& counted() { return counts[0]; }
    const physics::Counts& counted() const { return counts[0]; }

    physics::Hulls hull_table() const { return {hulls.data()}; }

    int substeps = 1;
    bool sums_impulses = false;                // contacts sum their impulses over the step, for events (Table::carried)
    std::uint32_t action_room = 64;            // capacity of the table of actions; grows
    std::vector<std::uint32_t> joint_records;  // record index by joint of the scene

    JointGroups joint_groups;  // made anew with the tables of joints and blocks

    CpuScratch scratch;

    // The contacts of a pass: those of contacts_to_solve from `first` up to `last`, if there are so many; and of the blocks of
    // joints all, or those with none of their contacts at the border of a rank, or the others. By default everything.
    enum class Blocks { all, inner, border };
    struct PassRange {
        std::uint32_t first = 0, last = physics::NONE;
        Blocks blocks = Blocks::all;
    };
    PassRange pass_range;
    std::uint32_t passed_first() const { return std::min(pass_range.first, counted().solver_contacts); }
    std::uint32_t passed_last() const { return std::min(pass_range.last, counted().solver_contacts); }
    std::vector<bool> border_blocks;  // by block of joints; empty: none
    bool passes_block(std::size_t block) const {
        if (pass_range.blocks == Blocks::all) return true;
        const bool at_border = !border_blocks.empty() && border_blocks[block];
        return at_border == (pass_range.blocks == Blocks::border);
    }
    std::uint32_t inner_contacts = 0;  // the first ones of contacts_to_solve, without ghosts of other ranks
    bool is_watched = false;           // tables are read after every stage

    ShapePlaces shape_places;
    SpareRecords spare;
    void index_surfaces();         // notes surfaces and their places anew, from the tables
    std::uint32_t body_count = 0;  // bodies of the scene; with parts, Parameters::first_part has room for more

    // For the scene compiler and editor: allocates every table; notes features of new rows; number of buckets for a
    // number of bodies.
    void allocate();
    void allocate_all();  // and from now on every table
    void note_content(std::uint32_t first_row, std::uint32_t count);
    void note_content(std::span<const physics::BodyProperties> rows);  // of rows that are elsewhere, too
    static std::uint32_t buckets_for(std::uint32_t bodies);
    // Appends a body whose row is its id.
    void append_row(std::uint32_t row) {
        if (reordered()) rows_.push_back(row);
    }

private:
    void number_rows();
    std::vector<std::uint32_t> rows_;  // row by id; empty: rows equal ids
    SceneFeatures row_content_;
    bool all_ = true;
};

}  // namespace scree
