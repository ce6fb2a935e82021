// Lengths, memory and growth of the tables.
#include "compute/tables/state.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "compute/tables/lasting.h"
#include "compute/tables/table_layout.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/bond/bond.h"
#include "shaders/physics/contact/material.h"
#include "shaders/physics/contact/tyre.h"

namespace scree {

std::uint32_t State::buckets_for(std::uint32_t bodies) {
    return std::bit_ceil(std::max(64u, 2 * bodies));
}

std::size_t State::allocated(BufferLength length) const {
    const physics::Parameters& p = parameters[0];
    const std::size_t pair_blocks = physics::pair_blocks_of(p.pair_capacity);
    const std::size_t pair_types = physics::PAIR_TYPES * pair_blocks + 1;
    const std::size_t block = std::size_t{p.group_size} << physics::SCAN_SHIFT;
    switch (length) {
        case BufferLength::one:
            return 1;
        case BufferLength::bodies:
        case BufferLength::entries:  // at least one
            return std::max(1u, p.bodies);
        case BufferLength::bodies_and_end:
            return p.bodies + 1;
        case BufferLength::buckets:
            return physics::buckets_in_all(p) + 1;
        case BufferLength::pairs:
            return p.pair_capacity;
        case BufferLength::pairs_and_end:
            return std::size_t{p.pair_capacity} + 1;
        case BufferLength::pair_types:
            return pair_types;
        case BufferLength::candidates:
            return p.pair_capacity;
        case BufferLength::scan_blocks:  // for the longest scanned list
            return std::max({pair_types, std::size_t{p.pair_capacity}, std::size_t{physics::buckets_in_all(p)}}) / block + 2;
        case BufferLength::contacts:
            return p.contact_capacity;
        case BufferLength::impacts:
            return bounces() ? p.contact_capacity : 0;
        case BufferLength::contact_sides:
            return 2 * std::size_t{p.contact_capacity};
        case BufferLength::attractions:
            return row_content_.cohesion ? 2 * std::size_t{p.contact_capacity} : 0;
        case BufferLength::slots:
            return 2 * std::size_t{p.contact_capacity} + block_bodies.size();
        case BufferLength::joints:
            return std::max<std::size_t>(1, joints.size());
        case BufferLength::joint_blocks:
            return std::max<std::size_t>(1, joint_blocks.size());
        case BufferLength::block_bodies:
            return std::max<std::size_t>(1, block_bodies.size());
        case BufferLength::vehicles:
            return std::max<std::size_t>(1, vehicles.size());
        case BufferLength::hulls:
            return std::max<std::size_t>(1, hulls.size());
        case BufferLength::parts:
            return parts.size();
        case BufferLength::fractures:
            return fractures.size();
        case BufferLength::pieces:
            return pieces.size();
        case BufferLength::tyres:
            return tyres.size();
        case BufferLength::surfaces:
            return surfaces.size();
        case BufferLength::immersions:
            return immersions.size();
        case BufferLength::way_points:
            return way_points.size();
        case BufferLength::filters:
            return filters.empty() ? 0 : p.bodies;
        case BufferLength::exclusions:
            return exclusions.size();
        case BufferLength::copies:
            return has_copies() ? p.copies : 0;
        case BufferLength::gravities:
            return gravities.size();
        case BufferLength::bonds:
            return bonds.size();
        case BufferLength::bond_ends:
            return bond_ends.size();
        case BufferLength::bond_changes:
            return 2 * physics::BOND_WORDS * bonds.size();
        case BufferLength::actions:
            return action_room;
    }
    return 0;
}

std::size_t State::live(BufferLength length) const {
    const physics::Counts& c = counts[0];
    switch (length) {
        case BufferLength::bodies:
            return fixed().bodies;
        case BufferLength::entries:
            return cell_ends[physics::buckets_in_all(fixed()) - 1];
        case BufferLength::pairs:
            return c.pairs;
        case BufferLength::pairs_and_end:
            return c.pairs + 1;
        case BufferLength::pair_types:
            return physics::PAIR_TYPES * physics::pair_blocks_of(c.pairs);
        case BufferLength::contacts:
            return c.contacts;
        case BufferLength::impacts:
            return bounces() ? c.contacts : 0;
        case BufferLength::contact_sides:
            return 2 * std::size_t{c.contacts};
        case BufferLength::attractions:
            return row_content_.cohesion ? 2 * std::size_t{c.contacts} : 0;
        case BufferLength::slots:
            return fixed().bodies ? slot_ends[fixed().bodies - 1] : 0;
        case BufferLength::candidates:  // unused once pairs are sorted
        case BufferLength::scan_blocks:
            return 0;
        default:
            return allocated(length);
    }
}

SceneFeatures State::features() const {
    SceneFeatures found = row_content_;
    found.joints = has_joints();
    found.vehicles = fixed().vehicles != 0;
    found.reordered = reordered();
    found.fields = fixed().air_density > 0 || fixed().water_density > 0 || fixed().attractors > 0;
    found.surfaces = !surfaces.empty();
    found.filters = !filters.empty();
    found.sums = found.breaking || sums_impulses;
    found.bounces = bounces();
    found.copies = has_copies();
    found.gravities = !gravities.empty();
    found.ghosts = marks_foreign;
    found.bonds = fixed().bonds != 0;
    found.periodic = physics::is_periodic(fixed());
    return found;
}

void State::note_content(std::uint32_t first_row, std::uint32_t count) {
    note_content(std::span(properties).subspan(first_row, count));
}

void State::note_content(std::span<const physics::BodyProperties> rows) {
    SceneFeatures& found = row_content_;
    for (const physics::BodyProperties& row : rows) {
        found.breaking |= row.fracture != physics::NONE;
        found.bounces |= row.restitution > 0;
        found.rolls |= row.rolling_resistance > 0;
        found.tyres |= physics::tyre_of(row) != 0;
        const physics::uint surface = physics::surface_of(row);
        found.cohesion |= surface != 0 && surfaces[surface - 1].cohesion > 0;
        found.round |= physics::has_round_core(row.shape);
        found.hulls |= row.shape == physics::SHAPE_HULL;
        found.convex |= physics::is_general_convex(row.shape);
        found.blocks |= physics::is_part(row) && row.shape != physics::SHAPE_TRIANGLE;
        found.triangles |= row.shape == physics::SHAPE_TRIANGLE;
        found.moving_parts |= physics::is_part(row) && physics::motion_of(row) != physics::MOTION_FIXED;
    }
    fit_tables();
}

void State::fit_tables() {
    for (const Table table : {Table::impacts, Table::impacts_before, Table::attractions})
        if (all_ || !raw(table).empty()) make(table);
}

void State::clear_impacts() {
    make(Table::impacts);
    std::fill(impacts.begin(), impacts.end(), physics::no_impact());
}

void State::index_surfaces() {
    shape_places.surfaces.clear();
    spare.surfaces.clear();
    spare.surface_users.assign(surfaces.size(), 0);
    for (const physics::BodyProperties& row : properties)
        if (const physics::uint surface = physics::surface_of(row)) ++spare.surface_users[surface - 1];
    for (physics::uint i = 0; i < surfaces.size(); ++i)
        if (spare.surface_users[i] == 0)
            spare.surfaces.push_back(i);
        else
            shape_places.surfaces[std::bit_cast<std::array<physics::uint, 12>>(surfaces[i])] = i;
}

void State::make(Table table) {
    switch (table) {
#define SCREE_RESIZE(buffer, name, block, record, length) \
    case Table::name:                                     \
        name.resize(allocated(BufferLength::length));     \
        break;
        SCREE_TABLES(SCREE_RESIZE)
#undef SCREE_RESIZE
    }
}

// The CPU keeps manifolds by pair.
static bool is_of_devices(Table table) {
    return table == Table::manifolds || table == Table::manifold_places;
}

void State::allocate() {
    const std::size_t numbered = ids.size();  // number of rows
    using enum Table;
    for (const Table table : row_tables) make(table);
    for (const Table table : {parameters, counts, actions, hulls, joints, joint_blocks, block_bodies, vehicles, ids, births})
        make(table);
    if (!this->filters.empty()) this->filters.resize(fixed().bodies, no_filter);
    for (std::size_t row = numbered; row < this->ids.size(); ++row) this->ids[row] = static_cast<std::uint32_t>(row);
    for (std::size_t i = 0; i < table_count; ++i)
        if ((all_ && !is_of_devices(static_cast<Table>(i))) || !raw(static_cast<Table>(i)).empty()) make(static_cast<Table>(i));
}

void State::allocate_all() {
    if (!std::exchange(all_, true)) allocate();
}

void State::turn_over() {
#define SCREE_SWAP(name) name.swap(name##_before);
    SCREE_LASTING_OF_CONTACTS(SCREE_SWAP)
#undef SCREE_SWAP
}

// A quarter more; of a long list a sixteenth, as each repeated step costs little beside the steps between.
std::uint32_t State::with_reserve(std::uint64_t need) {
    constexpr std::uint64_t most = 1u << 31, is_long = 1u << 12;
    if (need > most) throw std::length_error("more than 2,147,483,648 pairs of bodies overlap; spread them out");
    return static_cast<std::uint32_t>(std::min(need + std::max(std::min(need, is_long) / 4, need / 16), most));
}

std::pair<std::uint32_t, std::uint32_t> State::grown_capacities() const {
    const physics::Counts& c = counted();
    return {c.overflow & physics::OVERFLOW_PAIRS ? with_reserve(c.required_pairs) : fixed().pair_capacity,
            c.overflow & physics::OVERFLOW_CONTACTS ? with_reserve(c.required_contacts) : fixed().contact_capacity};
}

void State::grow() {
    std::tie(fixed().pair_capacity, fixed().contact_capacity) = grown_capacities();
    allocate();
    counted().overflow = 0;
}

void State::shrink_contacts(std::uint32_t capacity) {
    fixed().contact_capacity = capacity;
    allocate();
    const auto shrink = [](auto& table, BufferLength length) {
        using enum BufferLength;
        const bool follows = length == impacts || length == contact_sides || length == attractions || length == slots;
        if (length == contacts || follows) table.shrink_to_fit();
    };
#define SCREE_SHRINK(buffer, name, block, record, length) shrink(name, BufferLength::length);
    SCREE_TABLES(SCREE_SHRINK)
#undef SCREE_SHRINK
}

bool State::has_joints() const {
    return parameters[0].joint_blocks != 0;
}

std::size_t State::raw_bytes(Table table) const {
    const TableInfo& info = table_infos()[static_cast<std::size_t>(table)];
    return allocated(info.length) * info.record_bytes;
}

std::size_t State::bytes() const {
    const TableOffsets offsets = table_offsets(*this);
    return std::accumulate(offsets.bytes.begin(), offsets.bytes.end(), std::size_t{0});
}

std::size_t State::bytes_of_loops() const {
    return scratch.bytes();
}

std::size_t State::bytes_on_host() const {
    std::size_t bytes = 0;  // tables share no memory here
    for (std::size_t i = 0; i < table_count; ++i)
        if (!is_of_devices(static_cast<Table>(i))) bytes += raw_bytes(static_cast<Table>(i));
    const std::size_t of_pair = CpuScratch::bytes_of_pair;
    const std::size_t of_contact = (sizeof(physics::Constraint) + sizeof(physics::Impulse)) * 17 / 16;  // lane_contacts
    constexpr std::size_t of_body = 56;                                                                 // lane_bodies
    return bytes + of_pair * fixed().pair_capacity + of_contact * fixed().contact_capacity + of_body * fixed().bodies;
}

std::size_t State::bytes_when_grown(bool on_host) {
    physics::Parameters& p = fixed();
    const std::pair before{p.pair_capacity, p.contact_capacity};
    std::tie(p.pair_capacity, p.contact_capacity) = grown_capacities();
    const std::size_t found = on_host ? bytes_on_host() : bytes();
    std::tie(p.pair_capacity, p.contact_capacity) = before;
    return found;
}

}  // namespace scree
