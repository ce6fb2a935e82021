// Lockstep of the CPU and a Vulkan device.
#include "demos/program/compare_device.h"

#include "compute/checkpoint.h"
#include "compute/device/lockstep.h"
#include "demos/program/backend.h"
#include "demos/program/exit_status.h"
#include "demos/program/loaded_scene.h"
#include "host/vulkan/device.h"

namespace scree::demos {

DeviceComparison compare_with_device(const Scene& scene, const Settings& settings, const MachineOptions& machine, int steps,
                                     const std::function<bool(int)>& progress, std::size_t copies,
                                     std::span<const std::byte> from) {
    MachineOptions other = machine;
    other.threads = 0;  // those of the processor beside it
    const Backend backend = choose_machine(other, Choice::a_device);
    DeviceComparison found;
    found.device = backend.device->report().name;
    found.arithmetic_fault = backend.arithmetic_fault();
    found.result = at_work([&] {
        try {
            return compare_in_lockstep(scene, settings, backend.device, machine.threads, steps, progress, copies, from);
        } catch (const CheckpointError& error) {
            throw UsageError(std::string("--resume: ") + error.what());
        }
    });
    backend.require_valid();
    return found;
}

}  // namespace scree::demos
