// The processor of this machine, for figures that name it.
#pragma once

#include <string>

namespace scree::host {

// Its maker's name, "unknown" where the system has none, and the number of cores: "AMD EPYC 9B14 (2 cores)".
std::string processor();

}  // namespace scree::host
