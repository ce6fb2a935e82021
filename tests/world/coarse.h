// Few substeps, for tests of equal bits, whose time goes into dispatches: each substep runs the same code.
#pragma once

#include "compute/settings.h"

namespace scree::tests {

inline Settings coarse() {
    Settings settings;
    settings.substeps = 4;
    return settings;
}

}  // namespace scree::tests
