// World: when to reorder bodies in memory.
#include <utility>

#include "compute/tables/memory_order.h"
#include "compute/world/world_impl.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

// With fewer all tables fit into a cache. A settled pile on two cores, reordered against as created: solver passes over
// 10,000 boxes take 0.77 of the time on the CPU and 0.82 to 0.85 on lavapipe, those over 100,000 0.8 on the CPU.
constexpr std::size_t fewest_bodies = 4096;
constexpr double share_of_time = 0.02;
constexpr double worth_it = 1.25;  // reorder if neighbours in memory are farther apart by this factor than after sorting

double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

}  // namespace

bool World::Impl::keeps_order() const {
    return settings.reordering && scene.bodies.size() / copies() >= fewest_bodies;
}

void World::Impl::begin_in_order() {
    if (!keeps_order()) return;
    const auto begin = Clock::now();
    state.reorder(rows_by_place(scene, state, runner->threads()), runner->threads());
    looked = Clock::now();
    seconds_to_look = seconds_since(begin);
}

// A runner with tables of its own moves them there, if it has memory for it.
void World::Impl::move_to(const std::vector<std::uint32_t>& rows) {
    if (runner->prepare_to_move(state.rows_before(rows))) {
        state.reorder(rows, runner->threads(), /* contacts_too */ false);
        runner->move_rows();
        runner->adapt();
    } else {
        bring(lasting_ranges);
        state.reorder(rows, runner->threads());
        runner->adapt();
        TableRanges moved = lasting_ranges(state);
        append(moved, joint_structure_ranges(state));
        runner->upload(moved);
    }
    runner->upload({{Table::ids, 0, state.fixed().bodies}, {Table::filters, 0, state.filters.size()}});
}

void World::Impl::keep_order() {
    const bool asked = std::exchange(reorder_now, false);
    if (!asked && ranks) return;  // clocks differ
    if (!asked && (!keeps_order() || (looked && seconds_since(*looked) * share_of_time < seconds_to_look))) return;
    const auto begin = Clock::now();
    runner->download({{Table::poses, 0, state.fixed().bodies}});
    const std::vector<std::uint32_t> rows = rows_by_place(scene, state, runner->threads());
    if (asked || stride_in_space(scene, state) > worth_it * stride_in_space(scene, state, rows)) {
        move_to(rows);
        ++reorderings;
        ++arrangements;
        if (timeline) timeline->instant("bodies were reordered in memory", begin);
    }
    looked = Clock::now();
    seconds_to_look = seconds_since(begin);
    if (timeline) timeline->slice(Timeline::caller, "look after memory order", begin, Clock::now());
}

void World::reorder() {
    whole().reorder_now = true;
}
std::uint64_t World::reorderings() const {
    return whole().reorderings;
}
std::size_t World::row_of(std::size_t body) const {
    whole().require_body(body);
    return whole().state.row_of(body);
}

}  // namespace scree
