// A rank's share of the tables: rows of the bodies that it moves, of those near them, and of those that every rank has.
//
// Rows change, ids do not: messages name bodies by ids. Bodies that come take rows that have become free; if there are none, the
// tables grow, and the rows of parts, which lie behind those of bodies, move on.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/tables/state.h"

namespace scree {

// The properties of a body that has come, in its row here.
inline physics::BodyProperties owned_by(std::uint32_t row, physics::BodyProperties properties) {
    properties.owner = row;
    return properties;
}

class Share {
public:
    // Whether the tables have what a share can go without. What parts, joints, fragments, copies and fields refer to stays whole.
    static bool can_be_made(const State& state);
    // Before a step: drops the rows of bodies that are elsewhere. Needs the presence of all rows.
    void make(State& state);
    // Instead, of a state that has rows of what every rank has: makes rows for these bodies and free ones. Needs the presence of
    // the rows that it has.
    void begin(State& state, std::span<const std::uint32_t> ids);
    // Between steps: the tables have all rows again, those of bodies that are not owned as their owners say.
    void end(State& state, Exchange& exchange);

    // What take_in() has done to rows since changes() was last asked.
    struct Changes {
        bool moved = false;               // tables grew, and the rows of parts moved
        std::vector<std::uint32_t> rows;  // that have come to another body, or to none
        bool any() const { return moved || !rows.empty(); }
    };
    Changes changes() { return std::exchange(changes_, {}); }
    // Called before rows are taken from bodies elsewhere, or tables grow; may be null.
    std::function<void()> before_change;
    // While a step begins: gives rows to bodies that come. Their records are the caller's; until then they are absent.
    void take_in(State& state, std::span<const std::uint32_t> ids);

private:
    void reclaim(State& state);
    void grow(State& state, std::uint32_t rows);

    std::vector<std::uint32_t> free_;
    Changes changes_;
};

}  // namespace scree
