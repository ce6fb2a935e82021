// Reference broadphase: bodies sorted by bucket, pairs by owner and partner.
#include <algorithm>
#include <atomic>
#include <bit>
#include <span>
#include <tuple>

#include "compute/cpu/cells.h"
#include "compute/cpu/near_rows.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/filter.h"
#include "shaders/physics/collide/grid.h"

namespace scree::reference {

namespace {

bool still(const State& state, std::uint32_t body) {
    return (state.bounds[body].level & physics::INACTIVE) != 0;
}

bool near_large(const State& state, std::size_t body, physics::CellEntry other) {
    const physics::Bounds& own = state.bounds[body];
    const auto plane_reached = [&](std::size_t plane, physics::vec3 lower, physics::vec3 upper) {
        return physics::reaches_plane(lower, upper, state.properties[plane].size, state.poses[plane].position);
    };
    if (state.properties[other.body].shape == physics::SHAPE_PLANE) return plane_reached(other.body, own.lower, own.upper);
    if (state.properties[body].shape == physics::SHAPE_PLANE) return plane_reached(body, other.lower, other.upper);
    if (state.is_periodic()) {
        const vec3 apart = physics::middle_of(other.lower, other.upper) - physics::middle_of(own.lower, own.upper);
        const physics::Image image =
            physics::image_of_b(state.properties[body], state.properties[other.body], apart, state.fixed());
        other.lower = physics::lower_at_image(other.lower, image, state.fixed());
        other.upper = physics::upper_at_image(other.upper, image, state.fixed());
    }
    return physics::boxes_overlap(own.lower, own.upper, other.lower, other.upper);
}

// physics::can_touch of a row and an entry of the grid, where there are no planes: of two bodies without a look at the other.
bool can_touch(const State& state, std::uint32_t body, const physics::BodyProperties& own, const physics::CellEntry& other) {
    if (std::max(body, other.body) >= state.fixed().first_part) return physics::can_touch(own, state.properties[other.body]);
    return body != other.body && (physics::motion_of(own) == physics::MOTION_DYNAMIC || (other.level & physics::MOVES) != 0);
}

// Part of the rows above which inactive ones are too many to search from as well: 1/8.
constexpr std::size_t most_still = 8;

// Pairs of inactive bodies are those of last step's contacts, if one of them is dynamic still.
template <typename Found>
void for_each_carried_over(const State& state, std::uint32_t body, const Found& found) {
    if (!still(state, body)) return;
    const auto moves = [&](std::uint32_t row) { return physics::motion_of(state.properties[row]) == physics::MOTION_DYNAMIC; };
    const bool moves_itself = moves(body);
    for (std::size_t k = state.first_contacts[body]; k < state.first_contacts[body + 1]; ++k) {
        const physics::Contact& contact = state.contacts_before[k];
        const std::uint32_t other = contact.a == body ? contact.b : contact.a;
        if (still(state, other) && (moves_itself || moves(other))) found(other);
    }
}

// Whether a joint disables collision between two bodies. Only bodies that joints move have a list of joints.
bool kept_apart(const State& state, std::uint32_t body, std::uint32_t other) {
    if (state.properties[body].joints == physics::NONE) std::swap(body, other);
    for (std::uint32_t j = state.properties[body].joints; j != physics::NONE;) {
        const physics::Joint& joint = state.joints[j];
        const bool joins = (joint.a == body && joint.b == other) || (joint.a == other && joint.b == body);
        if (joins && !joint.broken && !(joint.flags & physics::JOINT_COLLIDES)) return true;
        j = joint.a == body ? joint.next_a : joint.next_b;
    }
    return false;
}

// Whether filters and excluded pairs allow two rows to collide.
bool may_collide(const State& state, std::uint32_t row, std::uint32_t other) {
    if (!physics::filters_allow(state.filters[row], state.filters[other])) return false;
    const std::uint32_t partner = state.id_of(state.body_of(other));
    for (std::uint32_t k = state.filters[row].w; k != physics::NONE; k = state.exclusions[k].y)
        if (state.exclusions[k].x == partner) return false;
    return true;
}

// Calls visit(bounds, periods) for a body, and for those images of it that may overlap bodies of a level.
template <typename Visit>
void for_each_image(const State& state, const physics::Bounds& around, std::uint32_t level, const Visit& visit) {
    if (!state.is_periodic()) return visit(around, vec3(0));
    const physics::ImageRange images = physics::images_in_reach(around.lower, around.upper, level, state.fixed());
    for (physics::ivec3 at = images.first; at.z <= images.last.z; at = physics::next_image(at, images)) {
        const physics::Image image = physics::image_at(vec3(at), state.fixed());
        physics::Bounds there = around;
        there.lower = physics::lower_at_image(there.lower, image, state.fixed());
        there.upper = physics::upper_at_image(there.upper, image, state.fixed());
        visit(there, image.periods);
    }
}
bool is_nearest_image(const State& state, const vec3& periods, const physics::Bounds& own, const physics::CellEntry& other) {
    const vec3 apart = physics::middle_of(other.lower, other.upper) - physics::middle_of(own.lower, own.upper);
    return physics::is_nearest_image(periods, apart, state.fixed());
}

// Where a body looks for partners on its own level: in all cells in reach, for pairs that it owns; or only in the cells
// from its own on, in the order of their coordinates, for pairs that either owns; or on all levels in the list of rows that were
// near it (near_rows.h), for the same.
enum class Search { around, ahead, listed };

bool is_ahead(const physics::ivec3& cell, std::uint32_t body, const physics::ivec3& own_cell, std::uint32_t own) {
    return std::tie(cell.z, cell.y, cell.x, body) > std::tie(own_cell.z, own_cell.y, own_cell.x, own);
}

// Calls list(owner, partner) for each pair that a search from `body` finds.
template <Search search, typename List>
void for_each_pair(const State& state, std::uint32_t body, const List& list) {
    const physics::Parameters& p = state.fixed();
    const physics::BodyProperties& own = state.properties[body];
    const std::uint32_t id = state.id_of(body);
    const bool joined = state.has_joints(), filtered = !state.filters.empty();
    const bool is_shared = !state.presence.empty(), is_periodic = state.is_periodic();
    const auto found_by = [&](std::uint32_t owner, std::uint32_t other) {
        if (is_shared && !state.is_owned(owner) && !state.is_owned(other)) return;
        if (filtered && !may_collide(state, owner, other)) return;
        if (!joined || !kept_apart(state, state.body_of(owner), state.body_of(other))) list(owner, other);
    };
    const auto found = [&](std::uint32_t other) { found_by(body, other); };
    const physics::Bounds& around = state.bounds[body];
    if ((around.level & physics::NOT_IN_GRID) != 0) return;
    for_each_carried_over(state, body, found);
    if (still(state, body) && !physics::any_stirs(state.counted())) return;
    const physics::uint of_copy = around.level & physics::COPY_BITS, copy = of_copy >> physics::COPY_SHIFT;
    if (still(state, body) && state.has_copies() && (state.copy_states[copy] & physics::COPY_STIRS) == 0) return;
    for (const physics::CellEntry& other : bucket(state, p.buckets + copy)) {
        if (!physics::finds_large(id, around.level, physics::is_large(own), state.id_of(other.body), other.level)) continue;
        if (physics::can_touch(own, state.properties[other.body]) && near_large(state, body, other)) found(other.body);
    }
    if (physics::is_large(own)) return;
    const auto found_by_either = [&](std::uint32_t other, std::uint32_t other_level) {
        const std::uint32_t other_id = state.id_of(other);
        if (physics::finds(id, around.level, other_id, other_level))
            found_by(body, other);
        else if (physics::finds(other_id, other_level, id, around.level))
            found_by(other, body);
    };
    if (search == Search::listed) {
        for_each_near(state, body, [&](const physics::CellEntry& other) {
            if (can_touch(state, body, own, other)) found_by_either(other.body, other.level & ~physics::MOVES);
        });
        return;
    }
    for (std::uint32_t levels = physics::levels_to_search(around.level, state.counted()); levels != 0; levels &= levels - 1) {
        const auto level = static_cast<std::uint32_t>(std::countr_zero(levels));
        if (search == Search::ahead && level == (around.level & physics::LEVEL_BITS)) continue;
        const std::uint32_t key = level | of_copy;
        for_each_image(state, around, level, [&](const physics::Bounds& there, const vec3& periods) {
            const physics::CellRange range = physics::cells_in_reach(there.lower, there.upper, level, p);
            const auto cells = static_cast<std::uint32_t>(range.last.x - range.first.x + 1);
            RowOfCells cell_row{state, range.first};
            physics::ivec3& from = cell_row.from;
            const auto visit = [&](std::span<const physics::CellEntry> row) {
                for (const physics::CellEntry& other : row) {
                    if (!(int{overlap(there, other)} & int{key_of(other) == key} & int{cell_row.has(cell_row.cell_of(other))}))
                        continue;
                    if (!physics::finds(id, around.level, state.id_of(other.body), other.level & ~physics::MOVES)) continue;
                    if (is_periodic && !is_nearest_image(state, periods, around, other)) continue;
                    if (can_touch(state, body, own, other)) found(other.body);
                }
            };
            for (from.z = range.first.z; from.z <= range.last.z; ++from.z)
                for (from.y = range.first.y; from.y <= range.last.y; ++from.y) for_each_in_row(state, from, cells, key, visit);
        });
    }
    if (search == Search::around) return;
    const std::uint32_t level = around.level & physics::LEVEL_BITS, key = level | of_copy;
    const physics::CellRange range = physics::cells_in_reach(around.lower, around.upper, level, p);
    const physics::ivec3 own_cell = physics::cell_of(around.lower, around.upper, level, p.inverse_cell);
    RowOfCells cell_row{state, own_cell};
    physics::ivec3& from = cell_row.from;
    const auto visit = [&](std::span<const physics::CellEntry> row) {
        for (const physics::CellEntry& other : row) {
            const physics::ivec3& cell = cell_row.cell_of(other);
            if (!(int{overlap(around, other)} & int{key_of(other) == key} & int{cell_row.has(cell)})) continue;
            if (!is_ahead(cell, other.body, own_cell, body) || !can_touch(state, body, own, other)) continue;
            found_by_either(other.body, other.level & ~physics::MOVES);
        }
    };
    for (; from.z <= range.last.z; ++from.z)
        for (from.y = from.z == own_cell.z ? own_cell.y : range.first.y; from.y <= range.last.y; ++from.y) {
            from.x = from.z == own_cell.z && from.y == own_cell.y ? own_cell.x : range.first.x;
            for_each_in_row(state, from, static_cast<std::uint32_t>(range.last.x - from.x + 1), key, visit);
        }
}

}  // namespace

void fill_cells(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        if (state.bounds[i].bucket == physics::NONE) return;
        const std::uint32_t entry = taken(threads, state.cell_starts()[state.bounds[i].bucket]);
        state.cell_entries[entry].body = static_cast<std::uint32_t>(i);
    });
}

void sort_cells(State& state, const Threads& threads, std::uint32_t) {
    std::atomic<std::uint32_t> still_entries = 0;
    state.scratch.entry_cells.resize(state.cell_entries.size());
    threads.for_ranges(physics::buckets_in_all(state.fixed()), [&](std::size_t begin, std::size_t end) {
        std::uint32_t inactive = 0;
        for (std::size_t b = begin; b < end; ++b) {
            const auto first = state.cell_entries.begin() + (b == 0 ? 0 : state.cell_ends[b - 1]);
            const auto last = state.cell_entries.begin() + state.cell_ends[b];
            std::sort(first, last, [](const auto& x, const auto& y) { return x.body < y.body; });
            for (auto at = first; at != last; ++at) {
                physics::CellEntry& entry = *at;
                entry = entry_of(state, entry.body);
                inactive += (entry.level & physics::INACTIVE) != 0;
                state.scratch.entry_cells[static_cast<std::size_t>(&entry - state.cell_entries.data())] =
                    physics::cell_of(entry.lower, entry.upper, entry.level & physics::LEVEL_BITS, state.fixed().inverse_cell);
            }
        }
        still_entries.fetch_add(inactive, std::memory_order_relaxed);
    });
    state.scratch.still_entries = still_entries;
}

void count_pairs(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::size_t bodies = state.fixed().bodies;
    state.scratch.partners.resize(bodies);
    const std::span counts = state.pair_counts();
    const auto note = [&](std::uint32_t owner, std::uint32_t other, std::uint32_t place) {
        if (place < CpuScratch::noted) state.scratch.partners[owner][place] = other;
    };
    if (state.scratch.still_entries < bodies / most_still && !state.is_periodic()) {
        const auto list = [&](std::uint32_t owner, std::uint32_t other) { note(owner, other, taken(threads, counts[owner])); };
        const bool listed = find_near_rows(state, threads);
        threads.for_each(bodies, [&](std::size_t i) {
            const auto body = static_cast<std::uint32_t>(i);
            listed ? for_each_pair<Search::listed>(state, body, list) : for_each_pair<Search::ahead>(state, body, list);
        });
    } else {
        threads.for_each(bodies, [&](std::size_t i) {
            for_each_pair<Search::around>(state, static_cast<std::uint32_t>(i),
                                          [&](std::uint32_t owner, std::uint32_t other) { note(owner, other, counts[owner]++); });
        });
    }
    std::atomic_ref coarse(state.counted().pairs_coarse);
    threads.for_ranges(bodies, [&](std::size_t begin, std::size_t end) {
        std::uint32_t parts = 0;
        for (std::size_t i = begin; i < end; ++i) parts += (counts[i] + 255) / 256;
        coarse.fetch_add(parts, std::memory_order_relaxed);
    });
}

void fill_pairs(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const auto owner = static_cast<std::uint32_t>(i);
        auto next = state.candidates.begin() + state.pair_starts[i];
        const auto list = [&](std::uint32_t other) { *next++ = {owner, other}; };
        const std::size_t count = state.pair_starts[i + 1] - state.pair_starts[i];
        if (count <= CpuScratch::noted)
            std::for_each_n(state.scratch.partners[i].begin(), count, list);
        else
            for_each_pair<Search::around>(state, owner, [&](std::uint32_t, std::uint32_t other) { list(other); });
    });
}

}  // namespace scree::reference
