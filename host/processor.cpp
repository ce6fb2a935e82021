// The name of the processor, from Linux's list of processors.
#include "host/processor.h"

#include <algorithm>
#include <fstream>
#include <thread>

namespace scree::host {

std::string processor() {
#ifdef __EMSCRIPTEN__
    std::string name = "WebAssembly";
#else
    std::string name = "unknown processor";
#endif
    std::ifstream list("/proc/cpuinfo");
    for (std::string line; std::getline(list, line);) {
        const std::size_t colon = line.find(": ");
        if (!line.starts_with("model name") || colon == line.npos) continue;
        name = line.substr(colon + 2);
        break;
    }
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    return name + " (" + std::to_string(cores) + (cores == 1 ? " core)" : " cores)");
}

}  // namespace scree::host
