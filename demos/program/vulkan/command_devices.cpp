// scree devices: Vulkan devices and their missing requirements.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "compute/device/arithmetic_check.h"
#include "compute/parallel/threads.h"
#include "demos/program/commands/commands.h"
#include "demos/program/outputs/table.h"
#include "host/processor.h"
#include "host/vulkan/device.h"

namespace scree::demos {

namespace {

const char* kind_of(const host::DeviceReport& device) {
    switch (device.kind) {
        case host::DeviceKind::discrete:
            return "GPU, discrete";
        case host::DeviceKind::integrated:
            return "GPU, integrated";
        case host::DeviceKind::virtual_gpu:
            return "GPU, virtual";
        case host::DeviceKind::processor:
            return "software";
        case host::DeviceKind::other:
            break;
    }
    return "GPU";
}

// The cell of a device's arithmetic check; what it failed is added to `notes`.
std::string arithmetic_of(const host::DeviceReport& device, std::string& notes) {
    if (!device.lacks.empty()) return "";
    try {
        const ArithmeticReport report = check_arithmetic(host::Device::open({.which = std::to_string(device.index)}));
        if (!report.is_exact()) {
            notes += fmt::format("device {} is not exact, so its state hashes are not comparable: its {}\n", device.index,
                                 report.fault);
            return "not exact";
        }
        return report.denormals == Denormals::kept ? "exact" : "exact, denormals flushed";
    } catch (const host::DeviceError& error) {
        notes += fmt::format("device {} does not run: {}\n", device.index, error.what());
        return "unknown";
    }
}

}  // namespace

void add_devices(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("devices", "List Vulkan devices and what each lacks");
    command->callback([] {
        std::vector<Cells> rows = {{"index", "device", "driver", "Vulkan", "kind", "memory", "usable", "arithmetic"}};
        std::string notes;
        for (const host::DeviceReport& device : host::list_devices()) {
            rows.push_back({std::to_string(device.index), device.name, device.driver, device.api_version, kind_of(device),
                            fmt::format("{:.1f} GB", static_cast<double>(device.memory_bytes) / 1e9),
                            device.lacks.empty() ? "yes" : "no", arithmetic_of(device, notes)});
            for (const std::string& lack : device.lacks) notes += fmt::format("device {} lacks {}\n", device.index, lack);
            if (device.lacks.empty() && !device.has_graphics)
                notes += fmt::format("device {} computes only; its pictures are drawn with OpenGL ES\n", device.index);
        }
        fmt::print("processor: {}, up to {} SIMD lanes\n\n{}{}", host::processor(), widest_lanes(), table(rows), notes);
    });
}

}  // namespace scree::demos
