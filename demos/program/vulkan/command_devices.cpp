// scree devices: Vulkan devices and their missing requirements.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "demos/program/commands.h"
#include "demos/program/table.h"
#include "host/vulkan/device.h"

namespace scree::demos {

void add_devices(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("devices", "List Vulkan devices and what each lacks");
    command->callback([] {
        std::vector<Cells> rows = {{"index", "device", "driver", "Vulkan", "kind", "memory", "usable"}};
        std::string lacks;
        for (const host::DeviceReport& device : host::list_devices()) {
            rows.push_back({std::to_string(device.index), device.name, device.driver, device.api_version,
                            device.is_processor ? "software" : "GPU",
                            fmt::format("{:.1f} GB", static_cast<double>(device.memory_bytes) / 1e9),
                            device.lacks.empty() ? "yes" : "no"});
            for (const std::string& lack : device.lacks) lacks += fmt::format("device {} lacks {}\n", device.index, lack);
        }
        fmt::print("{}{}", table(rows), lacks);
    });
}

}  // namespace scree::demos
