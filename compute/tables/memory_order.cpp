// Sorting bodies along a Morton curve, and moving them in the tables.
#include "compute/tables/memory_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <utility>

#include "compute/tables/lasting.h"

namespace scree {

namespace {

bool may_move(const Body& body) {
    return body.piece_of == no_body;  // fragments stay: their body refers to their rows
}

// Spreads 21 bits to every third bit.
std::uint64_t spread_out(std::uint64_t x) {
    x &= 0x1FFFFF;
    x = (x | x << 32) & 0x1F00000000FFFF;
    x = (x | x << 16) & 0x1F0000FF0000FF;
    x = (x | x << 8) & 0x100F00F00F00F00F;
    x = (x | x << 4) & 0x10C30C30C30C30C3;
    return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

// Morton code (1966): interleaved bits of three coordinates. Cells beyond two million from the origin are clamped.
std::uint64_t place_on_curve(vec3 position, float inverse_cell) {
    constexpr double middle = 1 << 20;
    std::uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double cell = std::floor(static_cast<double>(position[axis]) * inverse_cell) + middle;
        const double within = std::isfinite(cell) ? std::clamp(cell, 0.0, 2 * middle - 1) : 0.0;
        place |= spread_out(static_cast<std::uint64_t>(within)) << axis;
    }
    return place;
}

std::vector<std::uint32_t> rows_by_place(const Scene& scene, const State& state, const Threads& threads) {
    const std::size_t n = scene.bodies.size();
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(n);
    threads.for_each(n, [&](std::size_t id) {
        order[id] = {place_on_curve(state.poses[state.row_of(id)].position, state.fixed().inverse_cell),
                     static_cast<std::uint32_t>(id)};
    });
    std::erase_if(order, [&](const auto& one) { return !may_move(scene.bodies[one.second]); });
    const std::size_t copies = state.fixed().copies;
    if (copies > 1) {  // one behind the other, because all are at the same place
        std::vector<std::size_t> begins;
        for (std::size_t copy = 0; copy <= copies; ++copy)
            begins.push_back(static_cast<std::size_t>(
                std::partition_point(order.begin(), order.end(),
                                     [&](const auto& one) { return one.second < copy * state.fixed().bodies_of_copy; }) -
                order.begin()));
        threads.for_each(copies, [&](std::size_t copy) {
            std::sort(order.begin() + static_cast<std::ptrdiff_t>(begins[copy]),
                      order.begin() + static_cast<std::ptrdiff_t>(begins[copy + 1]));
        });
    } else {
        threads.sort(order);
    }
    std::vector<std::uint32_t> rows(n);
    std::iota(rows.begin(), rows.end(), 0u);
    auto next = order.begin();
    for (std::uint32_t row = 0; row < n; ++row)
        if (may_move(scene.bodies[row])) rows[(next++)->second] = row;
    return rows;
}

double stride_in_space(const Scene& scene, const State& state, const std::vector<std::uint32_t>& rows) {
    std::vector<std::uint32_t> ids(scene.bodies.size());
    for (std::uint32_t id = 0; id < ids.size(); ++id) ids[rows.empty() ? state.row_of(id) : rows[id]] = id;
    std::erase_if(ids,
                  [&](std::uint32_t id) { return !may_move(scene.bodies[id]) || scene.bodies[id].motion != Motion::dynamic; });
    if (ids.size() < 2) return 0;
    const double most = 64.0 * state.fixed().cell;
    double sum = 0;
    for (std::size_t k = 1; k < ids.size(); ++k) {
        const vec3 apart = state.poses[state.row_of(ids[k])].position - state.poses[state.row_of(ids[k - 1])].position;
        const double distance = glm::length(glm::dvec3(apart));
        sum += distance < most ? distance : most;  // also for values that are not finite
    }
    return sum / static_cast<double>(ids.size() - 1);
}

std::vector<std::uint32_t> contacts_by_id(const State& state) {
    const std::uint32_t contacts = state.counted().contacts;
    std::vector<std::uint32_t> order;
    order.reserve(contacts);
    // A copy of the scene that was reset since has none.
    const auto is_over = [&](std::uint32_t contact) { return state.is_newborn(state.copy_of(state.contacts[contact].a)); };
    if (!state.reordered() || state.is_share()) {  // of a share in the order of its rows
        order.resize(contacts);
        std::iota(order.begin(), order.end(), 0u);
        if (state.has_copies()) std::erase_if(order, is_over);
        return order;
    }
    for (std::uint32_t id = 0; id < state.fixed().bodies; ++id) {
        const std::uint32_t row = state.row_of(id);
        for (std::uint32_t k = state.first_contacts[row]; k < std::min(contacts, state.first_contacts[row + 1]); ++k)
            order.push_back(k);
    }
    if (state.has_copies()) std::erase_if(order, is_over);
    return order;
}

void State::number_rows() {
    std::iota(ids.begin(), ids.end(), 0u);
    for (std::uint32_t id = 0; id < rows_.size(); ++id) ids[rows_[id]] = id;
}

void State::take_rows(std::vector<std::uint32_t> rows, bool rows_bounce) {
    rows_ = std::move(rows);
    number_rows();
    row_content_ = {.bounces = rows_bounce};
    note_content(0, fixed().bodies);
    spare.parts.clear();
    spare.fractures.clear();
    const std::uint32_t first = fixed().first_part;
    for (std::uint32_t row = first; row < fixed().bodies; ++row)
        if (properties[row].motion == physics::MOTION_PENDING) spare.add_parts(row - first, 1);
}

std::vector<std::uint32_t> State::rows_before(const std::vector<std::uint32_t>& rows) const {
    std::vector<std::uint32_t> from(fixed().bodies);
    std::iota(from.begin(), from.end(), 0u);
    for (std::uint32_t id = 0; id < body_count; ++id) from[rows[id]] = row_of(id);
    return from;
}

void State::reorder(const std::vector<std::uint32_t>& rows, const Threads& threads, bool contacts_too) {
    const std::uint32_t n = body_count, all = fixed().bodies;
    const std::vector<std::uint32_t> from = rows_before(rows);
    std::vector<std::uint32_t> to(all);  // rows
    for (std::uint32_t row = 0; row < all; ++row) to[from[row]] = row;
    // Allocate first, for the strong exception guarantee.
    std::vector<std::uint32_t> by_id = rows;
    // One scratch buffer for all tables: allocation takes longer than the permutation.
    std::vector<std::byte> scratch(n * sizeof(physics::BodyProperties));
    const auto follow = [&](physics::uint& row) {
        if (row < n) row = to[row];
    };
    // Contacts are grouped by the row of their owner, within an owner in the order of ids.
    std::vector<physics::uint> first_in_rows;
    const bool with_contacts = contacts_too && contacts.size() >= counted().contacts && first_contacts.size() > all;
    if (with_contacts) {
#define SCREE_RESIZE(name) name##_before.resize(name.size());
        SCREE_LASTING_OF_CONTACTS(SCREE_RESIZE)
#undef SCREE_RESIZE
        first_in_rows.resize(first_contacts.size());
        for (std::uint32_t row = 0; row < all; ++row)
            first_in_rows[row + 1] = first_in_rows[row] + first_contacts[from[row] + 1] - first_contacts[from[row]];
        threads.for_each(all, [&](std::size_t row) {
            std::uint32_t place = first_in_rows[row];
            for (std::uint32_t k = first_contacts[from[row]]; k < first_contacts[from[row] + 1]; ++k, ++place) {
                ContactRecords::of(*this, k).put_before(*this, place);
                follow(contacts_before[place].a);
                follow(contacts_before[place].b);
            }
        });
    }
    const auto take = [&](auto& table) {
        if (table.size() < all) return;  // the table is only on the device
        constexpr std::size_t bytes = sizeof table[0];
        static_assert(bytes <= sizeof(physics::BodyProperties));
        threads.for_each(n, [&](std::size_t row) { std::memcpy(&scratch[row * bytes], &table[from[row]], bytes); });
        threads.for_each(n, [&](std::size_t row) { std::memcpy(&table[row], &scratch[row * bytes], bytes); });
    };
#define SCREE_TAKE(name, travel) take(name);
    SCREE_LASTING_OF_ROWS(SCREE_TAKE)
#undef SCREE_TAKE
    take(filters);
    for (physics::BodyProperties& row : properties) follow(row.owner);
    for (physics::Joint& joint : joints)
        for (physics::uint* row : {&joint.a, &joint.b}) follow(*row);
    for (physics::BlockBody& member : block_bodies) follow(member.body);
    for (physics::Bond& bond : bonds)
        for (physics::uint* row : {&bond.a, &bond.b}) follow(*row);
    for (physics::Vehicle& vehicle : vehicles) {
        follow(vehicle.dynamics.chassis);
        for (physics::VehicleWheel& wheel : vehicle.wheel) follow(wheel.body);
    }
    if (with_contacts) {
        turn_over();
        first_contacts.swap(first_in_rows);
    }
    rows_.swap(by_id);
    number_rows();
}

}  // namespace scree
