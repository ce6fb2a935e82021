// The bodies of other ranks next to those of this one, and the exchange of what their owners compute.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/distributed/ownership.h"
#include "compute/tables/state.h"

namespace scree {

class Halo {
public:
    // Finds the ghosts of this step, those whose bounds overlap a body of another rank or that touched one in the last step, and
    // sends what the broadphase and narrowphase read of them.
    void find(State& state, const Ownership& ownership, Exchange& exchange, Share& share);
    void forget();  // all ghosts, as rows change

    // Of every ghost, from its owner.
    void send_sleep_states(State& state, Exchange& exchange);
    void send_struck(State& state, Exchange& exchange);  // and of what all ranks have, united
    void send_ends(State& state, Exchange& exchange);    // poses and sweeps, as continuous collision reads them
    void send_stops(State& state, Exchange& exchange);
    void send_kept(State& state, Exchange& exchange);  // of bodies that break

    // Likewise, but it is here only after finish(), with no other exchange in between.
    void start_velocities(State& state, Exchange& exchange);
    void start_motion(State& state, Exchange& exchange);
    void finish(State& state, Exchange& exchange);

    std::size_t ghosts() const;
    std::vector<std::uint32_t> sent_rows() const;   // of bodies here that other ranks have as ghosts, ascending, each once
    std::vector<std::uint32_t> ghost_rows() const;  // ascending

private:
    struct Box {
        physics::vec3 lower{1e30f}, upper{-1e30f};
    };
    Box box_of(const State& state, std::uint32_t row) const;
    void note_reach(const State& state);
    void find_near(const State& state, Exchange& exchange);
    void find_touched(const State& state, const Ownership& ownership, const Exchange& exchange);
    Bytes start_of(const State& state, const std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& known) const;
    void take_ghosts(State& state, Share& share, const std::vector<Bytes>& sent);
    // Of every ghost the record that `of` makes on its owner, which `take` puts into the tables here.
    template <class Record, class Of, class Take>
    void start(const State& state, Exchange& exchange, const Of& of, const Take& take);
    template <class Record, class Of, class Take>
    void send(State& state, Exchange& exchange, const Of& of, const Take& take) {
        start<Record>(state, exchange, of, take);
        finish(state, exchange);
    }

    std::vector<float> reach_;                           // of the parts of a row, m; 0: none; empty: no compound moves
    std::vector<std::vector<std::uint32_t>> to_, from_;  // rows by rank
    std::vector<std::vector<std::uint32_t>> known_;      // ids of the bodies that each rank was sent in the last step, ascending
    std::vector<Bytes> outgoing_, incoming_;
    std::function<void(State&)> taking_;  // puts what has come in into the tables
};

}  // namespace scree
