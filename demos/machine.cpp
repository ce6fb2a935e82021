// Choosing where to simulate, with Vulkan.
#include "demos/machine.h"

#include "compute/device_runner.h"
#include "demos/failure.h"
#include "host/device.h"

namespace scree::demos {

std::unique_ptr<Runner> Machine::make_runner() const {
    return device ? make_device_runner(device) : make_reference_runner(options.threads);
}

void Machine::require_valid() const {
    if (!device || !options.validate) return;
    const std::vector<std::string> messages = device->validation_messages();
    if (messages.empty()) return;
    throw WorkFailed("Vulkan validation: " + std::to_string(messages.size()) + " messages, the first: " + messages.front());
}

Machine choose_machine(const MachineOptions& options) {
    Machine machine{options, nullptr, ""};
    if (options.backend == "cpu") {
        if (!options.device.empty())
            throw UsageError("--device: the backend cpu has no devices; use --threads, or --backend vulkan");
        return machine;
    }
    const bool insist = options.backend == "vulkan" || !options.device.empty() || options.validate;
    try {
        machine.device = host::Device::open({.which = options.device, .validation = options.validate, .on_message = {}});
    } catch (const host::DeviceError& error) {
        if (insist) throw;
        machine.remark = std::string("no Vulkan device (") + error.what() + "); simulating on the processor";
    }
    return machine;
}

std::shared_ptr<host::Device> device_for_pictures(const Machine& machine) {
    if (machine.device) return machine.device;
    try {
        return host::Device::open({.which = "", .validation = machine.options.validate, .on_message = {}});
    } catch (const host::DeviceError& error) {
        throw UsageError(std::string("--frames and --video need a Vulkan driver, though the simulation does not: ") +
                         error.what());
    }
}

}  // namespace scree::demos
