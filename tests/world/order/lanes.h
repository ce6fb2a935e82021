// The numbers of SIMD lanes that tests compare with the plain loops.
#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "compute/parallel/threads.h"

namespace scree::tests {

// Those of `all` that run here, on this processor and with this SCREE_LANES; the others are named in the test's output.
inline std::vector<int> lanes_here(const std::vector<int>& all = {4, 8, 16}) {
    std::vector<int> here;
    for (const int lanes : all)
        if (lanes <= widest_lanes())
            here.push_back(lanes);
        else
            WARN("not compared: " << lanes << " lanes, since the widest here are " << widest_lanes());
    return here;
}

}  // namespace scree::tests
