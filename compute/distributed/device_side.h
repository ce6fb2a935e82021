// The device of a rank and the host's tables, through which ranks exchange bodies: only rows near borders pass between
// the two in a substep.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "compute/distributed/halo.h"
#include "compute/staged_runner.h"
#include "compute/tables/state.h"
#include "compute/tables/table_ranges.h"

namespace scree {

// Without a device, on a rank of the CPU, fetch() and store() do nothing: its stages work in the host's tables.
class DeviceSide {
public:
    using Make = std::function<std::unique_ptr<StagedRunner>()>;
    explicit DeviceSide(Make make) : make_(std::move(make)), device_(make_ ? make_() : nullptr) {}
    explicit operator bool() const { return device_ != nullptr; }
    StagedRunner& runner() const { return *device_; }

    void attach(State& state);
    void attach_anew();  // with as much memory as the tables take now, which the host has whole
    void adapt();
    void adapt_if_changed();  // tables became longer or shorter since

    enum class Rows {
        all,
        sent,   // of bodies here that are ghosts elsewhere
        ghosts  // of this rank
    };
    void take_rows(const Halo& halo);  // of this step
    // From the device into the host's tables, and back.
    using Tables = std::vector<Table>;
    void fetch(const Tables& tables, Rows rows = Rows::all);
    void store(const Tables& tables, Rows rows = Rows::all);
    void fetch(const TableRanges& ranges);
    void store(const TableRanges& ranges);
    void fetch_counts() { fetch({{Table::counts, 0, 1}}); }
    void store_counts() { store({{Table::counts, 0, 1}}); }
    // The contacts of the last step (before the tables are turned over), with all that lasts of them.
    void fetch_contacts();
    void store_contacts();
    // Those that keep bodies asleep in touch, once the tables were turned over; none if no body of this rank is asleep.
    void fetch_contacts_of_sleepers();

    // Within a step, around Halo::find() in a share: brings what share.take_in() moves and asks of contacts, and takes over the
    // rows that it has changed.
    void fetch_for_new_rows();
    void store_new_rows(const Share::Changes& changes);

    // Tells the device which rows other ranks move (ROW_FOREIGN, ROW_ELSEWHERE), where that has changed.
    void mark_presence();

private:
    TableRanges ranges(const Tables& tables, Rows rows) const;
    // The contacts of this step, and of the last one, with their impulses.
    TableRanges contacts_of(std::size_t count) const;
    TableRanges contacts_before_of(std::size_t count) const;

    Make make_;
    std::unique_ptr<StagedRunner> device_;
    State* state_ = nullptr;
    TableLengths adapted_;
    std::vector<std::uint32_t> sent_, ghosts_;  // rows, ascending
    std::vector<std::uint8_t> marks_;           // by row, as the device has them
};

}  // namespace scree
