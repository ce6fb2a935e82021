// What the plan of a step costs a device before any work: dispatches, barriers, and dispatches whose size the device counts
// itself.
#include <algorithm>
#include <catch2/catch.hpp>

#include "compute/plan/plan.h"

using namespace scree;

namespace {

struct Launches {
    std::size_t dispatches = 0, barriers = 0, indirect = 0;
};

Launches launches_of(int substeps, const SceneFeatures& features) {
    Launches all;
    for (const Stage& stage : plan(substeps, features)) {
        ++all.dispatches;
        all.barriers += stage.barrier_after ? 1 : 0;
        all.indirect += is_indirect(stage.domain) ? 1 : 0;
    }
    return all;
}

// Of the first substep and of each further one.
void require_launches(const SceneFeatures& features, const Launches& one, const Launches& more) {
    for (const int substeps : {1, 2, 12}) {
        const Launches all = launches_of(substeps, features);
        const auto further = static_cast<std::size_t>(substeps - 1);
        CAPTURE(substeps);
        CHECK(all.dispatches == one.dispatches + further * more.dispatches);
        CHECK(all.barriers == one.barriers + further * more.barriers);
        CHECK(all.indirect == one.indirect + further * more.indirect);
    }
}

}  // namespace

TEST_CASE("a step of boxes launches no more than it needs") {
    require_launches({}, {66, 66, 42}, {4, 4, 2});
}

TEST_CASE("a step with every feature launches no more than it needs") {
    require_launches(SceneFeatures::everything(), {97, 95, 50}, {9, 9, 3});
}
