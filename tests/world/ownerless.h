// Joints and vehicles of which no body is any rank's any more: scenes, and what scripts tell of them, which must be alike on one
// processor and on ranks.
#pragma once

#include "compute/scene.h"
#include "tests/world/on_ranks.h"

namespace scree::tests {

// Pairs of boxes on springs, far from each other, so that ranks have some each.
Scene pairs_on_springs(int pairs);

struct Ownerless {
    Scene scene;
    TellingScript script;
    Poison poison;  // that puts bodies into quarantine
};
Ownerless joints_in_quarantine();
Ownerless joints_of_broken_bodies();
Ownerless joint_in_quarantine_that_migrates();  // with the rest of its block
Ownerless joint_in_quarantine_cut_off();        // by an edit, from the rest of its block
Ownerless vehicle_in_quarantine();
Ownerless broken_vehicle();

}  // namespace scree::tests
