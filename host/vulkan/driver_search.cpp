// Vulkan drivers in folders that the loader does not search.
#include "host/vulkan/driver_search.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "host/system/machine.h"

namespace scree::host {
namespace {

std::vector<std::filesystem::path> manifests_in(const std::vector<std::filesystem::path>& folders) {
    std::vector<std::filesystem::path> found;
    for (const std::filesystem::path& folder : folders) {
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".json") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

std::optional<std::string> driver_files(const std::vector<std::filesystem::path>& listed,
                                        const std::vector<std::filesystem::path>& unlisted) {
    std::string files;
    std::set<std::string> names;
    const auto add = [&](const std::filesystem::path& manifest) {
        if (!names.insert(manifest.filename().string()).second) return false;
        files += (files.empty() ? "" : ":") + manifest.string();
        return true;
    };
    bool more = false;
    for (const std::filesystem::path& manifest : manifests_in(listed)) add(manifest);
    for (const std::filesystem::path& manifest : manifests_in(unlisted)) more |= add(manifest);
    if (!more) return std::nullopt;
    return files;
}

void show_unlisted_drivers() {
    for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"})
        if (std::getenv(name)) return;
    std::vector<std::filesystem::path> listed;
    for (const char* folder : {"/usr/local/etc", "/usr/local/share", "/etc", "/usr/share"})
        listed.push_back(std::filesystem::path(folder) / "vulkan" / "icd.d");
    const char* const home = std::getenv("HOME");
    if (const char* const data = std::getenv("XDG_DATA_HOME"))
        listed.push_back(std::filesystem::path(data) / "vulkan" / "icd.d");
    else if (home)
        listed.push_back(std::filesystem::path(home) / ".local" / "share" / "vulkan" / "icd.d");
    const auto files = driver_files(listed, {"/usr/local/nvidia/share/vulkan/icd.d"});
    if (!files) return;
    // Loaders before 1.3.207 know the second name alone.
    set_environment("VK_DRIVER_FILES", *files);
    set_environment("VK_ICD_FILENAMES", *files);
}

}  // namespace scree::host
