// Moving rows on a device: body tables through a scratch buffer, contacts from one of their two tables to the other.
#include "compute/device/row_mover.h"

#include <algorithm>
#include <array>

#include "host/vulkan/transfer.h"
#include "shaders/embedded.h"
#include "shaders/physics/base/record_groups.h"

namespace scree {

namespace {

enum MovingStep : std::uint32_t { go_to, move_records, follow, count_block, sum_blocks, first_of_rows, move_contacts };
constexpr std::uint32_t bindings_of_moves = 6;  // shaders/queries/move_rows.comp
constexpr std::size_t rows_of_a_thread = 16;    // likewise

}  // namespace

RowMover::RowMover(std::shared_ptr<host::Device> device, std::uint32_t group_size)
    : device_(std::move(device)), group_size_(group_size) {
    layout_ = std::make_shared<host::BindingSetLayout>(device_, bindings_of_moves, sizeof(Push));
    for (const std::uint32_t sums_up : {0u, 1u})
        pipelines_.emplace_back(layout_, "move_rows", shaders::find("move_rows.query"), std::vector{group_size_, sums_up});
}

const host::BindingSet& RowMover::bound(const host::Buffer& table, const host::Buffer& moved) {
    const std::pair key(&table, &moved);
    if (!sets_.contains(key)) {
        const std::vector<const host::Buffer*> buffers{&table, &moved, tables_.first_contacts.buffer, &moves_, &table, &moved};
        sets_.emplace(key, host::BindingSet(layout_, buffers));
    }
    return sets_.at(key);
}

void RowMover::run(std::uint32_t step, std::size_t items, const Records& of, std::size_t first, const host::BindingSet& set) {
    const Push push{step,
                    static_cast<std::uint32_t>(items),
                    tables_.rows,
                    static_cast<std::uint32_t>(of.length),
                    static_cast<std::uint32_t>(of.begin),
                    static_cast<std::uint32_t>(first),
                    tables_.bodies,
                    of.is_grouped ? physics::GROUP_SHIFT : 0};
    commands_->bind(pipelines_[step == count_block || step == sum_blocks ? 1 : 0], set);
    commands_->push(&push, sizeof push);
    const std::size_t groups = (items + group_size_ - 1) / group_size_;
    commands_->dispatch(static_cast<std::uint32_t>(
        std::clamp<std::size_t>(groups, 1, step == sum_blocks ? 1 : device_->limits().maxComputeWorkGroupCount[0])));
    commands_->barrier();
}

void RowMover::prepare(const Tables& tables, std::span<const std::uint32_t> from) {
    tables_ = tables;
    sets_.clear();
    const std::size_t rows = tables.rows, blocks = rows / (group_size_ * rows_of_a_thread) + 1;
    moves_ = {};
    moves_ = host::Buffer(device_, "moves of rows", (3 * rows + 1 + blocks) * sizeof(std::uint32_t));
    std::size_t longest = 1;
    for (const Records& table : tables.of_bodies) longest = std::max(longest, table.length);
    scratch_ = {};
    scratch_ = host::Buffer(device_, "rows in other places", std::max(1u, tables.bodies) * longest * sizeof(std::uint32_t));
    host::upload(device_, std::array{host::Upload{std::as_bytes(from), &moves_}});
    commands_ = std::make_unique<host::CommandBuffer>(device_);
    const std::size_t firsts = tables.first_contacts.begin;
    const host::BindingSet& any = bound(*tables.first_contacts.buffer, scratch_);
    commands_->barrier();
    run(go_to, tables.bodies, {}, 0, any);
    for (const Records& table : tables.of_bodies) {
        run(move_records, tables.bodies, table, firsts, bound(*table.buffer, scratch_));
        const std::size_t word = sizeof(std::uint32_t);
        commands_->copy(scratch_, *table.buffer, tables.bodies * table.length * word, 0, table.begin * word);
        commands_->barrier();
    }
    for (const auto& [table, word] : tables.with_rows) run(follow, table.count, table, word, bound(*table.buffer, scratch_));
    run(count_block, rows, {}, firsts, any);
    run(sum_blocks, 0, {}, firsts, any);
    run(first_of_rows, rows, {}, firsts, any);
    for (const auto& [table, moved] : tables.of_contacts)
        run(move_contacts, table.count, table, firsts, bound(*table.buffer, *moved));
    const std::size_t bytes = (rows + 1) * sizeof(std::uint32_t);
    commands_->copy(moves_, *tables.first_contacts.buffer, bytes, 2 * rows * sizeof(std::uint32_t),
                    firsts * sizeof(std::uint32_t));
    commands_->end();
}

void RowMover::move() {
    device_->submit_and_wait({commands_->handle()});
    commands_.reset();
    sets_.clear();
    moves_ = {};
    scratch_ = {};
}

}  // namespace scree
