// Which rank moves which body: ranges of a Morton curve, and bodies that change ranks with all that lasts.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/distributed/share.h"
#include "compute/tables/lasting.h"
#include "compute/tables/state.h"

namespace scree {

// The owner of every body, known to every rank. Bodies that joints connect have one owner, so no joint crosses a border.
class Ownership {
public:
    // Of a world that is shared out from its start: as many bodies to each rank, by their places on the curve; returns the
    // borders.
    const std::vector<std::uint64_t>& divide(std::vector<std::uint64_t> places, int ranks);
    void begin(std::vector<int> owners);
    // Follows bodies and joints that have come or gone; new bodies go where their place is.
    void adapt(const State& state, const Exchange& exchange);
    bool knows(const State& state) const { return owner_.size() == state.body_count; }
    bool will_follow_joints() const { return regrouped_; }  // in follow_joints()
    bool any_stopped(const State& state) const;             // bodies that are no longer dynamic, which place() will send
    // Sets the presence of every row by its motion and owner, with no ghosts. Bodies that are no longer dynamic are sent to all.
    void place(State& state, Exchange& exchange);
    // Moves the borders by the cost that was measured, and the bodies that have crossed one. Between turning over and begin_step.
    void balance(State& state, Exchange& exchange, Share& share);
    // Whether bodies have become dynamic since the last step. All ranks have moved them alike, but only owners of what touches
    // them know their contacts, which give_contacts() brings to the owners of these bodies. The latter between turning over and
    // begin_step.
    bool any_started(const State& state) const;
    void give_contacts(State& state, Exchange& exchange);
    // Bodies that new joints have tied to one of another rank follow it.
    void follow_joints(State& state, Exchange& exchange, Share& share);
    // After a share has ended, and before what is edited then: ranks knew the motions of the bodies in their shares alone.
    void note_motions(const State& state);
    // In a share no joints connect bodies.
    void forget_groups() { std::vector<std::uint32_t>().swap(group_); }
    // Fragments belong to the owner of what has broken.
    void inherit(const State& state, std::uint32_t row);
    int owner_of(const State& state, std::uint32_t row) const { return owner_[state.id_of(row)]; }
    std::uint64_t migrations() const { return migrations_; }  // bodies so far, over all ranks

private:
    using Moves = std::vector<std::pair<std::uint32_t, int>>;  // id, new owner
    void move(State& state, Exchange& exchange, Share& share, const Moves& own_moves);
    std::uint64_t place_of(const State& state, std::uint32_t id) const;  // on the curve
    void group(const State& state);
    bool has_started(const State& state, std::uint32_t row) const;

    std::vector<int> owner_;            // by id of the body
    std::vector<std::uint32_t> group_;  // likewise: the lowest id that joints connect it with; empty: none are connected
    std::vector<std::uint8_t> was_dynamic_, was_everywhere_;
    std::vector<std::uint64_t> borders_;  // first place of every rank but the first
    bool regrouped_ = false;
    std::uint64_t migrations_ = 0;
};

// A contact of the last step, with the row that owned its pair; in messages with ids in place of rows.
struct OwnedContact {
    std::uint32_t owner = 0;
    ContactRecords records;
};
OwnedContact by_ids(const State& state, OwnedContact contact);
OwnedContact by_rows(const State& state, OwnedContact contact);
// Adds contacts to those of the last step that are kept, each once.
void merge_contacts(State& state, const std::vector<OwnedContact>& more,
                    const std::function<bool(const physics::Contact&)>& keeps);

}  // namespace scree
