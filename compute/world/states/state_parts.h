// The tables of a world whose ranks have their shares alone (Ranks::share_out) as the bytes of put_state(), of which no rank
// holds more than a piece.
//
// Piece by piece, a range of rows of one table, ranks send the first one the records that they own. Rows are those of the whole
// world, in which a body's is its id.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/tables/state.h"

namespace scree {

class StateParts {
public:
    using Take = std::function<void(std::span<const std::byte>)>;
    // Collective, as all that follows: counts the contacts of all ranks.
    StateParts(const State& share, Exchange& exchange);
    physics::Parameters parameters() const;  // of the whole state
    physics::Counts counts() const;
    bool rows_bounce() const { return rows_bounce_; }
    std::uint64_t bytes() const;  // of the tables that steps change, in all
    // On the first rank, calls take() with these bytes in their order.
    void put_tables(const Take& take) const;

private:
    std::vector<std::pair<Table, std::size_t>> stepped() const;  // the tables that steps change, with their lengths
    void put_rows(Table table, std::uint32_t first, std::uint32_t last, const Take& take) const;
    void put_first_contacts(std::uint32_t first, std::uint32_t last, std::uint32_t& before, const Take& take) const;
    void put_contacts(Table table, std::uint32_t first, std::uint32_t last, const Take& take) const;
    // Calls visit(whole row, index) for the contacts that this rank owns, by the rows that own them.
    template <class Visit>
    void for_each_contact(std::uint32_t first, std::uint32_t last, const Visit& visit) const;
    std::vector<Bytes> gathered(Bytes own) const;  // by rank; empty on all but the first

    const State& state_;
    Exchange& exchange_;
    std::uint32_t rows_ = 0;      // of the whole state
    std::uint64_t contacts_ = 0;  // likewise
    bool rows_bounce_ = false;    // those of some rank
};

}  // namespace scree
