// Transfers between a rank's device and the host's tables.
#include "compute/distributed/device_side.h"

#include <algorithm>

#include "compute/tables/table_layout.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

constexpr std::uint32_t marks = physics::ROW_FOREIGN | physics::ROW_ELSEWHERE;

// A range for each run of rows that follow each other.
void append_rows(TableRanges& ranges, Table table, const std::vector<std::uint32_t>& rows) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k > 0 && rows[k] == rows[k - 1] + 1)
            ++ranges.back().count;
        else
            ranges.push_back({table, rows[k], 1});
    }
}

// Of rows, what only their owners send: ghosts are sent the rest, at the start of each step.
std::vector<Table> tables_without_ghosts() {
    std::vector<Table> found;
    for (const Table table : row_tables)
        if (std::find(tables_of_ghosts().begin(), tables_of_ghosts().end(), table) == tables_of_ghosts().end())
            found.push_back(table);
    return found;
}

TableRange whole(const State& state, Table table) {
    return {table, 0, state.raw_bytes(table) / record_bytes(table)};
}

}  // namespace

void DeviceSide::attach(State& state) {
    state_ = &state;
    if (!device_) return;
    state.marks_foreign = true;
    state.allocate_all();
    device_->attach(state);
    adapted_ = TableLengths::of(state);
    marks_.clear();
}

void DeviceSide::attach_anew() {
    if (!device_) return;
    std::unique_ptr<StagedRunner> fresh = make_();  // or none: then the old one stays
    device_ = std::move(fresh);
    attach(*state_);
}

void DeviceSide::adapt() {
    if (!device_) return;
    state_->allocate_all();
    device_->adapt();
    adapted_ = TableLengths::of(*state_);
}

void DeviceSide::adapt_if_changed() {
    if (device_ && !(TableLengths::of(*state_) == adapted_)) adapt();
}

void DeviceSide::take_rows(const Halo& halo) {
    if (!device_) return;
    sent_ = halo.sent_rows();
    ghosts_ = halo.ghost_rows();
}

TableRanges DeviceSide::ranges(const Tables& tables, Rows rows) const {
    TableRanges wanted;
    for (const Table table : tables) {
        if (rows == Rows::all)
            wanted.push_back(whole(*state_, table));
        else
            append_rows(wanted, table, rows == Rows::sent ? sent_ : ghosts_);
    }
    return wanted;
}

void DeviceSide::fetch(const Tables& tables, Rows rows) {
    if (device_) fetch(ranges(tables, rows));
}

void DeviceSide::store(const Tables& tables, Rows rows) {
    if (device_) store(ranges(tables, rows));
}

void DeviceSide::fetch(const TableRanges& ranges) {
    if (!device_ || ranges.empty()) return;
    device_->download(ranges);
    for (const TableRange& range : ranges) {
        if (range.table != Table::properties) continue;
        for (physics::BodyProperties& row : std::span(state_->properties).subspan(range.first, range.count)) row.flags &= ~marks;
    }
}

// Marks are on the device alone, so that no rank sends or saves them.
void DeviceSide::store(const TableRanges& ranges) {
    if (!device_ || ranges.empty()) return;
    const auto with_marks = [&](auto change) {
        for (const TableRange& range : ranges) {
            if (range.table != Table::properties) continue;
            for (std::size_t row = range.first; row < std::min(range.first + range.count, marks_.size()); ++row)
                change(state_->properties[row].flags, physics::uint{marks_[row]});
        }
    };
    with_marks([](physics::uint& flags, physics::uint mark) { flags |= mark; });
    device_->upload(ranges);
    with_marks([](physics::uint& flags, physics::uint) { flags &= ~marks; });
}

TableRanges DeviceSide::contacts_of(std::size_t count) const {
    TableRanges ranges;
    for (const Table table : contact_tables) {
        const bool is_here = state_->allocated(table_infos()[static_cast<std::size_t>(table)].length) > 0;
        ranges.push_back({table, 0, is_here ? count : 0});
    }
    return ranges;
}
TableRanges DeviceSide::contacts_before_of(std::size_t count) const {
    TableRanges ranges = contacts_of(count);
    for (TableRange& range : ranges) range.table = other_parity(range.table);
    return ranges;
}

void DeviceSide::fetch_contacts() {
    if (!device_) return;
    fetch_counts();
    fetch({Table::first_contacts});
    const std::size_t count = state_->counted().contacts;
    TableRanges wanted = contacts_of(count);
    if (state_->features().sums) wanted.push_back({Table::carried, 0, count});
    fetch(wanted);
}

void DeviceSide::store_contacts() {
    const std::size_t count = state_->counted().contacts;
    store_counts();
    store(contacts_of(count));
    store({Table::first_contacts});
}

void DeviceSide::fetch_contacts_of_sleepers() {
    if (!device_) return;
    State& state = *state_;
    bool some_sleep = false;
    for (std::uint32_t row = 0; row < state.fixed().first_part && !some_sleep; ++row)
        some_sleep = state.is_owned(row) && physics::is_asleep(state.sleep_states[row], state.fixed().sleep_steps);
    if (!some_sleep) {
        state.first_contacts[state.fixed().bodies] = 0;
        return;
    }
    fetch({Table::first_contacts});
    fetch({{Table::contacts_before, 0, state.first_contacts[state.fixed().bodies]}});
}

void DeviceSide::fetch_for_new_rows() {
    if (!device_) return;
    fetch(tables_without_ghosts());
    fetch({Table::slot_ends, Table::first_contacts});
    const std::size_t count = state_->first_contacts[state_->fixed().bodies];
    fetch(contacts_before_of(count));
}

void DeviceSide::store_new_rows(const Share::Changes& changes) {
    if (!device_) return;
    if (!changes.moved) {
        std::vector<std::uint32_t> rows = changes.rows;
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        TableRanges records;
        append_rows(records, Table::ids, rows);
        for (const Table table : tables_without_ghosts()) append_rows(records, table, rows);
        return store(records);
    }
    marks_.clear();
    adapt();
    const std::size_t count = state_->first_contacts[state_->fixed().bodies];
    store(Tables(row_tables.begin(), row_tables.end()));
    store({Table::ids, Table::forces, Table::slot_ends, Table::first_contacts});
    store(contacts_before_of(count));
    device_->resume_step();
}

void DeviceSide::mark_presence() {
    if (!device_) return;
    marks_.resize(state_->fixed().bodies);
    std::vector<std::uint32_t> changed;
    for (std::uint32_t row = 0; row < state_->fixed().bodies; ++row) {
        std::uint32_t mark = 0;
        if (!state_->is_here(row))
            mark = marks;
        else if (!state_->is_stepped(row))
            mark = physics::ROW_FOREIGN;
        if (marks_[row] == mark) continue;
        marks_[row] = static_cast<std::uint8_t>(mark);
        changed.push_back(row);
    }
    TableRanges rows;
    append_rows(rows, Table::properties, changed);
    store(rows);
}

}  // namespace scree
