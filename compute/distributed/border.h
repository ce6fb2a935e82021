// Which blocks of joints of a rank wait for ghosts: passes go over the others while the ghosts' records travel.
#pragma once

#include <vector>

#include "compute/tables/state.h"

namespace scree {

class Border {
public:
    // Of this step, once its contacts are prepared: notes the blocks of joints with a body on a contact with a ghost, which
    // joints solve after their contacts. Those contacts are the last ones of contacts_to_solve (State::inner_contacts).
    void find(State& state);

private:
    std::vector<bool> touches_ghost_;  // by row
};

}  // namespace scree
