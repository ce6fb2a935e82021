// Stand-ins for the commands that need Vulkan, which report that the build lacks it.
#include <CLI/CLI.hpp>

#include "demos/program/commands/commands.h"
#include "demos/program/compare_device.h"
#include "demos/program/exit_status.h"

namespace scree::demos {

namespace {

constexpr const char* lacking = "this scree was built without Vulkan; configure it with -DSCREE_VULKAN=ON";

void refuse() {
    throw UsageError(lacking);
}

}  // namespace

void add_devices(CLI::App& program, int&) {
    program.add_subcommand("devices", "Vulkan devices (not in this build)")->callback(refuse);
}

DeviceComparison compare_with_device(const Scene&, const Settings&, const MachineOptions&, int, const std::function<bool(int)>&,
                                     std::size_t, std::span<const std::byte>) {
    throw UsageError(std::string(lacking) + "; without a device: --flush-denormals");
}

}  // namespace scree::demos
