// What a lockstep has to find: no difference. The first one is told where the test fails.
#pragma once

#include <catch2/catch.hpp>

#include "compute/device/lockstep.h"

namespace scree::tests {

inline void require_equal(const LockstepResult& result) {
    INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                 << result.detail);
    REQUIRE(result.equal);
}

}  // namespace scree::tests
