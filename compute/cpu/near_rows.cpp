// Rows that are near each other: boxes and the list.
#include "compute/cpu/near_rows.h"

#include <atomic>
#include <limits>
#include <mutex>

namespace scree::reference {

namespace {

using Place = NearRows::Place;

constexpr float margin_in_cells =
    0.0625f;                              // of a box, of its level's cells. A heap at rest stays within; 0.25 lists twice as many
constexpr std::size_t most_outside = 16;  // a part of 1/16 of the rows is searched for in the grid
constexpr std::uint32_t levels_apart = 2;  // a row that has left its box searches cells of up to so many finer levels
constexpr float farthest = 2.0e4f;         // cells from the origin, where the grid is sure to find all that overlaps (grid.h)

bool in_grid(const State& state, std::size_t row) {
    return state.bounds[row].bucket < state.fixed().buckets && (state.bounds[row].level & physics::NOT_IN_GRID) == 0;
}
float margin_of(const State& state, std::uint32_t level) {
    return margin_in_cells * state.fixed().cell * physics::power_of_two(static_cast<int>(level));
}
std::uint32_t level_of(const State& state, std::size_t row) {
    return state.bounds[row].level & physics::LEVEL_BITS;
}
bool is_within(const physics::Bounds& bounds, const NearRows::Box& box) {
    return glm::all(glm::greaterThanEqual(bounds.lower, box.lower)) && glm::all(glm::lessThanEqual(bounds.upper, box.upper));
}

void draw_boxes(State& state, const Threads& threads) {
    NearRows& near = state.scratch.near_rows;
    near.is_listed = false;
    near.boxes.resize(state.fixed().bodies);
    const physics::vec3 far(farthest * state.fixed().cell);
    threads.for_each(near.boxes.size(), [&](std::size_t i) {
        const physics::Bounds& bounds = state.bounds[i];
        const physics::vec3 margin(margin_of(state, level_of(state, i)));
        const NearRows::Box box{bounds.lower - margin, bounds.upper + margin};
        const bool has_box =
            in_grid(state, i) && glm::all(glm::greaterThan(box.lower, -far)) && glm::all(glm::lessThan(box.upper, far));
        near.boxes[i] = has_box ? box : NearRows::Box{physics::vec3(1), physics::vec3(-1)};
    });
}

// The rows whose boxes overlap that of row i: on its own level those behind it, on coarser ones all. Boxes of this step.
void list_row(const State& state, std::uint32_t i, std::vector<std::uint32_t>& found) {
    const NearRows& near = state.scratch.near_rows;
    const NearRows::Box& box = near.boxes[i];
    const std::uint32_t own = level_of(state, i);
    for (std::uint32_t levels = state.counted().levels & ~((1u << own) - 1u); levels != 0; levels &= levels - 1) {
        const auto level = static_cast<std::uint32_t>(std::countr_zero(levels));
        const physics::vec3 margin(margin_of(state, level));
        const physics::CellRange range = physics::cells_in_reach(box.lower - margin, box.upper + margin, level, state.fixed());
        for_each_in_cells(state, range, level, [&](const physics::CellEntry& other) {
            if ((level > own || other.body > i) && overlap(box, near.boxes[other.body])) found.push_back(other.body);
        });
    }
}

void list_near_rows(State& state, const Threads& threads) {
    NearRows& near = state.scratch.near_rows;
    const std::size_t bodies = state.fixed().bodies;
    near.firsts.resize(bodies);
    near.ends.resize(bodies);
    near.others.clear();
    std::mutex mutex;
    threads.for_ranges(bodies, [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = first; i < last; ++i) {
            near.firsts[i] = static_cast<std::uint32_t>(found.size());
            if (near.places[i] == Place::in_box) list_row(state, static_cast<std::uint32_t>(i), found);
            near.ends[i] = static_cast<std::uint32_t>(found.size());
        }
        const std::lock_guard lock(mutex);
        const auto place = static_cast<std::uint32_t>(near.others.size());
        near.others.insert(near.others.end(), found.begin(), found.end());
        for (std::size_t i = first; i < last; ++i) {
            near.firsts[i] += place;
            near.ends[i] += place;
        }
    });
    near.is_listed = true;
}

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr physics::CellEntry no_entry{physics::vec3(infinite), 0, physics::vec3(-infinite), 0};

struct Outside {
    std::size_t rows = 0;
    bool reaches_far = false;  // one is on a level much coarser than the finest
};
Outside place_rows(State& state, const Threads& threads) {
    NearRows& near = state.scratch.near_rows;
    const auto finest = static_cast<std::uint32_t>(std::countr_zero(state.counted().levels));
    std::atomic<std::size_t> outside = 0;
    std::atomic<bool> reaches_far = false;
    near.places.resize(state.fixed().bodies);
    near.entries.resize(state.fixed().bodies);
    threads.for_ranges(near.places.size(), [&](std::size_t first, std::size_t last) {
        std::size_t found = 0;
        for (std::size_t i = first; i < last; ++i) {
            near.places[i] = !in_grid(state, i)                          ? Place::not_in_grid
                             : is_within(state.bounds[i], near.boxes[i]) ? Place::in_box
                                                                         : Place::outside;
            near.entries[i] = near.places[i] == Place::in_box ? entry_of(state, static_cast<std::uint32_t>(i)) : no_entry;
            if (near.places[i] != Place::outside) continue;
            ++found;
            if (level_of(state, i) > finest + levels_apart) reaches_far.store(true, std::memory_order_relaxed);
        }
        outside.fetch_add(found, std::memory_order_relaxed);
    });
    return {outside, reaches_far};
}

}  // namespace

bool find_near_rows(State& state, const Threads& threads) {
    NearRows& near = state.scratch.near_rows;
    if (state.has_copies() || !state.presence.empty()) return false;
    const std::size_t bodies = state.fixed().bodies;
    if (near.boxes.size() != bodies) {
        draw_boxes(state, threads);
        return false;
    }
    Outside outside = place_rows(state, threads);
    const bool few = outside.rows <= bodies / most_outside;
    if (!few || !near.is_listed) draw_boxes(state, threads);
    if (!few) return false;
    if (!near.is_listed) {
        outside = place_rows(state, threads);
        list_near_rows(state, threads);
    }
    return !outside.reaches_far;
}

}  // namespace scree::reference
