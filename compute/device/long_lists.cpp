// Lists that are longer than a software device can do: it ends a shader's loops after 65,535 rounds in all without a word. The
// ends of lists are copied out of each step, and a step with too long a list is refused by name.
#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string>

#include "compute/device/device_runner.h"
#include "shaders/physics/base/work_counts.h"

namespace scree {

namespace {

// A workgroup sorts the lists of its threads one after the other (shaders/stages/lib/sort.glsl); besides, a thread takes one
// round an item of a list.
constexpr std::uint32_t most_rounds_of_a_list = 60000;
constexpr std::uint32_t short_range = 32, compared_a_round = 4;  // sort.glsl

// Rounds of a thread in which its workgroup sorts a list.
std::uint64_t sorting_rounds(std::uint64_t items, std::uint32_t group_size) {
    if (items <= short_range) return 0;
    const auto shared = [&](std::uint64_t work) { return work / (std::uint64_t{compared_a_round} * group_size) + 2; };
    std::uint64_t rounds = shared(items), steps = 1;
    for (std::uint64_t reach = 1; reach < items; reach *= 2, ++steps) rounds += steps * (shared((items + 2 * reach) / 2) + 1);
    return rounds;
}

struct SortedList {
    const char* stage;  // that sorts it
    Table ends;         // of all such lists
    // A body looks through nine rows of three neighbouring lists, and the bodies of a vector of threads through others.
    std::uint32_t rows, neighbours;
    const char *owner, *items;

    std::uint64_t rounds(std::uint64_t length) const { return rows * length; }
};
constexpr std::array<SortedList, 2> sorted_lists{
    {{"sort_cells", Table::cell_ends, 9, 3, "a row of cells of the broadphase", "bodies"},
     {"sort_slots", Table::slot_ends, 1, 1, "a body", "contacts and joints"}}};

// The length of a list with its neighbours, if it is too long alone or with those that its workgroup sorts too; else 0.
std::uint32_t too_long(const SortedList& list, std::span<const std::uint32_t> ends, std::uint32_t group_size) {
    std::uint32_t longest = 0, begin = 0;
    std::uint64_t rounds = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (i % group_size == 0) rounds = longest = 0;
        const std::uint32_t length = ends[i] - begin;
        begin = ends[i];
        longest = std::max(longest, ends[i] - (i < list.neighbours ? 0 : ends[i - list.neighbours]));
        rounds += sorting_rounds(length, group_size);
        if (std::max(rounds, list.rounds(longest)) > most_rounds_of_a_list) return longest;
    }
    return 0;
}

}  // namespace

void DeviceRunner::copy_list_ends(host::CommandBuffer& commands, const Stage& stage) {
    const physics::Parameters& p = state_->fixed();
    const std::array<std::size_t, 2> items{p.bodies, state_->allocated(BufferLength::slots)};
    const std::array<std::size_t, 2> lists{physics::buckets_in_all(p), p.bodies};
    for (std::size_t i = 0; i < sorted_lists.size(); ++i) {
        if (stage.name != sorted_lists[i].stage) continue;
        host::Buffer& back = list_ends_[parity_][i];
        // All items in one list, or short lists of one workgroup, are what takes most.
        const bool may_be_long =
            device_->report().is_processor &&
            std::max(sorting_rounds(items[i], p.group_size), sorted_lists[i].rounds(items[i])) > most_rounds_of_a_list;
        if (!may_be_long) back = {};
        if (!may_be_long) continue;
        const std::size_t bytes = lists[i] * sizeof(std::uint32_t);
        if (back.bytes() != bytes) back = host::Buffer(device_, "ends of lists", bytes, host::BufferUse::readback);
        commands.barrier();
        commands.copy(buffer(sorted_lists[i].ends), back, bytes, range(sorted_lists[i].ends).offset);
        commands.barrier();
    }
}

void DeviceRunner::require_short_lists(std::size_t parity) const {
    for (std::size_t i = 0; i < sorted_lists.size(); ++i) {
        const host::Buffer& back = list_ends_[parity][i];
        if (!back) continue;
        std::vector<std::uint32_t> ends(back.bytes() / sizeof(std::uint32_t));
        std::memcpy(ends.data(), back.mapped(), back.bytes());
        if (const std::uint32_t longest = too_long(sorted_lists[i], ends, state_->fixed().group_size))
            throw host::DeviceError(std::string(sorted_lists[i].owner) + " has " + std::to_string(longest) + " " +
                                    sorted_lists[i].items + ", more than a software device such as " + device_->report().name +
                                    " can search and sort: simulate with --backend cpu");
    }
}

}  // namespace scree
