// Ranks: runners that share one world's bodies and take every decision alike, and what World asks of its own one.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "compute/distributed/exchange.h"

namespace scree {

struct State;  // compute/tables/state.h

// Two ranks or more. All of them call the same functions in the same order.
class Ranks {
public:
    virtual Exchange& exchange() const = 0;
    // Copies the contacts that this rank alone has to the host.
    virtual void download_own_contacts() = 0;
    // Copies all that this rank has of a shared-out world to the host.
    virtual void download_share() = 0;
    // Between steps: whether each rank can keep its share of the attached tables alone; drops the rest; fetches the rest again.
    virtual bool can_share_out() const = 0;
    virtual void share_out() = 0;
    virtual void make_whole() = 0;
    // Instead of Runner::attach(), of a world that is shared out from its start: from the places of its dynamic bodies on the
    // Morton curve (compute/tables/memory_order.h), the first place of every rank but the first; and taking over a state with
    // rows of what every rank has, and the owners by id. It makes rows for this rank's own bodies, by their ids, and then
    // calls fill().
    virtual std::vector<std::uint64_t> borders_of(std::vector<std::uint64_t> places) = 0;
    virtual void attach_share(State& state, std::vector<int> owners, std::span<const std::uint32_t> own,
                              const std::function<void()>& fill) = 0;

protected:
    ~Ranks() = default;
};

}  // namespace scree
