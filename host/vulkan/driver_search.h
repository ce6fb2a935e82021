// Vulkan drivers in folders that the loader does not search. Internal to VulkanFunctions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::host {

// What VK_DRIVER_FILES must be for the loader to find the drivers (*.json) in `unlisted` as well as those in `listed`; none if
// `unlisted` has no driver whose file name is not among those of `listed`.
std::optional<std::string> driver_files(const std::vector<std::filesystem::path>& listed,
                                        const std::vector<std::filesystem::path>& unlisted);

// Shows the loader the drivers of containers on clusters (/usr/local/nvidia), unless the environment says which to use.
// To be called before the first instance is made, by one thread.
void show_unlisted_drivers();

}  // namespace scree::host
