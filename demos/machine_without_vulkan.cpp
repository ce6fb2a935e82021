// Choosing where to simulate, in a build without Vulkan: the processor.
#include "demos/failure.h"
#include "demos/machine.h"

namespace scree::demos {

namespace {
constexpr const char* cure = "this scree was built without Vulkan; configure it with -DSCREE_VULKAN=ON";
}

std::unique_ptr<Runner> Machine::make_runner() const {
    return make_reference_runner(options.threads);
}

void Machine::require_valid() const {}

Machine choose_machine(const MachineOptions& options) {
    if (options.backend == "vulkan") throw UsageError(std::string("--backend vulkan: ") + cure);
    if (!options.device.empty()) throw UsageError(std::string("--device: ") + cure);
    return {options, nullptr, ""};
}

std::shared_ptr<host::Device> device_for_pictures(const Machine&) {
    throw UsageError(std::string("--frames and --video need Vulkan: ") + cure);
}

}  // namespace scree::demos
