// Which contacts and joints of a rank need ghosts: passes go over the others while the ghosts' records travel.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/step/state.h"

namespace scree {

class Border {
public:
    // Of this step, once its contacts are prepared: orders contacts_to_solve so that those with a ghost come last, and notes the
    // blocks of joints with a body on such a contact, which joints solve after its contacts.
    void find(State& state);
    std::uint32_t inner_contacts() const { return inner_contacts_; }  // the first ones

private:
    std::uint32_t inner_contacts_ = 0;
    std::vector<std::uint32_t> border_contacts_;
    std::vector<bool> touches_ghost_;  // by row
};

}  // namespace scree
