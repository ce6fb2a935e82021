// Checks that an output file can be written.
#include "demos/program/options/output_check.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

#include "demos/program/exit_status.h"
#include "host/system/files.h"

namespace scree::demos {

namespace {

std::string place_of(const std::string& file) {
    std::error_code ignored;
    const std::filesystem::path place = std::filesystem::weakly_canonical(std::filesystem::absolute(file), ignored);
    return std::filesystem::is_other(place, ignored) ? "" : place.string();  // devices such as /dev/null may be named twice
}

}  // namespace

void require_writable_file(const char* option, const std::string& name) {
    if (name.empty() || name == "-") return;
    const auto refuse = [&](const std::string& why) { throw UsageError(fmt::format("{} {}: {}", option, name, why)); };
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(name, ignored);
    if (std::filesystem::is_directory(status)) refuse("is a folder; name a file in it");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {  // /dev/stdout, a pipe
        if (!host::may_write(name)) refuse(std::string("cannot be written: ") + std::strerror(errno));
        return;
    }
    std::filesystem::path target = std::filesystem::exists(status) ? std::filesystem::canonical(name, ignored) : "";
    if (target.empty()) target = name;  // else the target of symbolic links
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, ignored))
        refuse(fmt::format("there is no folder {}; make it first", folder.string()));
    // Create a file: checking permissions would miss a read-only file system.
    const int made = host::create_nameless(folder);
    if (made < 0) {
        refuse(fmt::format("no file can be made in the folder {}: {}; name another", folder.string(), std::strerror(errno)));
    }
    host::close_file(made);
}

void require_distinct(std::initializer_list<NamedOutput> outputs) {
    std::map<std::string, const char*> taken;
    for (const auto& [option, name] : outputs) {
        const std::string place = name.empty() || name == "-" ? "" : place_of(name);
        if (place.empty()) continue;
        const auto [other, is_new] = taken.emplace(place, option);
        if (!is_new) throw UsageError(fmt::format("{} and {}: both are {}; name another file", other->second, option, name));
    }
}

OutputFolder::OutputFolder(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (std::filesystem::path at = folder; !at.empty() && !std::filesystem::exists(at, ignored); at = at.parent_path())
        made_.push_back(at);
    std::filesystem::create_directories(folder, ignored);
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    for (const std::filesystem::path& one : made_)
        if (!std::filesystem::remove(one, ignored)) return;
}

}  // namespace scree::demos
