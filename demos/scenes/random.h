// Pseudo-random numbers of the demos: those of the library.
#pragma once

#include "compute/scene/random.h"

namespace scree::demos {

using Random = SeededRandom;

}  // namespace scree::demos
