// World: states kept for going back.
//
// The host keeps what it alone knows, as a checkpoint has it; tables that steps change stay with a runner that has its own.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "compute/world/world_impl.h"

namespace scree {

void World::Impl::drop_kept() {
    kept.clear();
    kept_memory.clear();
    runner->drop_kept();
}

void World::keep_state() {
    Impl& in = whole();
    if (in.broken) throw std::logic_error("a previous step ran out of memory; the world can be read but not kept");
    Impl::Kept next;
    const auto same = std::ranges::find(in.kept, in.steps, &Impl::Kept::steps);
    if (same != in.kept.end() || in.kept.size() == most_kept_states) {
        const auto replaced = same != in.kept.end() ? same : in.kept.begin();
        next = std::move(*replaced);  // its memory is used again
        in.kept.erase(replaced);
    } else {
        while (std::ranges::find(in.kept, next.slot, &Impl::Kept::slot) != in.kept.end()) ++next.slot;
        if (!in.kept_memory.empty()) {
            next.bytes = std::move(in.kept_memory.back());
            in.kept_memory.pop_back();
        }
    }
    next.steps = in.steps;
    const TableRanges ranges = lasting_ranges(in.state);
    if (in.runner->in_place())
        in.runner->download(ranges);
    else if (in.state.changes_motions())
        in.runner->download({{Table::properties, 0, in.state.fixed().bodies}});
    ByteWriter out(std::move(next.bytes));
    in.put(out, in.kept_by_host());
    next.bytes = std::move(out.bytes());
    if (!in.runner->in_place()) in.runner->keep(next.slot, ranges);
    in.kept.push_back(std::move(next));
}

void World::roll_back(std::uint64_t steps) {
    Impl& in = whole();
    const auto found =
        std::ranges::find_if(in.kept, [&](const Impl::Kept& one) { return steps <= in.steps && one.steps == in.steps - steps; });
    if (found == in.kept.end()) {
        std::string there;
        for (const Impl::Kept& one : in.kept) there += (there.empty() ? "" : ", ") + std::to_string(one.steps);
        throw std::out_of_range("no state is kept " + std::to_string(steps) + " steps before step " + std::to_string(in.steps) +
                                ": " + (there.empty() ? "none is kept" : "those of steps " + there + " are"));
    }
    in.take(found->bytes, in.kept_by_host(), found->slot);
    for (auto later = found + 1; later != in.kept.end(); ++later) in.kept_memory.push_back(std::move(later->bytes));
    in.kept.erase(found + 1, in.kept.end());
}

std::vector<std::uint64_t> World::kept_states() const {
    std::vector<std::uint64_t> steps;
    for (const Impl::Kept& one : whole().kept) steps.push_back(one.steps);
    return steps;
}

void World::drop_states() {
    whole().drop_kept();
}

}  // namespace scree
