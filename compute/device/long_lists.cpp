// Lists that one thread sorts (shaders/stages/lib/sort.glsl), and that a software device may leave unsorted without a word: its
// loops end after 65,535 rounds in all. Their ends are copied out of each step, and a step with too long a list is refused by
// name.
#include <array>
#include <cstring>
#include <span>
#include <string>

#include "compute/device/device_runner.h"
#include "shaders/physics/base/work_counts.h"

namespace scree {

namespace {

constexpr std::uint32_t longest_list = 20000;  // 3.25 rounds an item

struct SortedList {
    const char* stage;  // that sorts it
    Table ends;         // of all such lists
    const char *owner, *items;
};
constexpr std::array<SortedList, 2> sorted_lists{{{"sort_cells", Table::cell_ends, "a cell of the broadphase", "bodies"},
                                                  {"sort_slots", Table::slot_ends, "a body", "contacts and joints"}}};

std::uint32_t longest_of(std::span<const std::uint32_t> ends) {
    std::uint32_t longest = 0, begin = 0;
    for (const std::uint32_t end : ends) {
        longest = std::max(longest, end - begin);
        begin = end;
    }
    return longest;
}

}  // namespace

void DeviceRunner::copy_list_ends(host::CommandBuffer& commands, const Stage& stage) {
    const physics::Parameters& p = state_->fixed();
    const std::array<std::size_t, 2> items{p.bodies, state_->allocated(BufferLength::slots)};
    const std::array<std::size_t, 2> lists{physics::buckets_in_all(p), p.bodies};
    for (std::size_t i = 0; i < sorted_lists.size(); ++i) {
        if (stage.name != sorted_lists[i].stage) continue;
        host::Buffer& back = list_ends_[parity_][i];
        const bool may_be_long = device_->report().is_processor && items[i] > longest_list;
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
        const std::uint32_t longest = longest_of(ends);
        if (longest > longest_list)
            throw host::DeviceError(std::string(sorted_lists[i].owner) + " has " + std::to_string(longest) + " " +
                                    sorted_lists[i].items + ", and a software device such as " + device_->report().name +
                                    " sorts at most " + std::to_string(longest_list) + ": simulate with --backend cpu");
    }
}

}  // namespace scree
