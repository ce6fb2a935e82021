// The name of the processor.
#include "host/processor.h"

#include <algorithm>
#include <thread>

#include "host/system/machine.h"

namespace scree::host {

std::string processor() {
    std::string name = processor_name();
    if (name.empty()) name = "unknown processor";
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    return name + " (" + std::to_string(cores) + (cores == 1 ? " core)" : " cores)");
}

}  // namespace scree::host
