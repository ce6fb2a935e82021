// Validation of the settings.
#include "compute/settings.h"

#include <stdexcept>
#include <string>

#include "compute/schema/check.h"
#include "compute/schema/settings.h"

namespace scree {

namespace {

struct SettingName {
    const char* key = "";
    SettingName operator/(const char* inner) const { return {inner}; }
};

[[noreturn]] void refuse(const SettingName& setting, const std::string& reason) {
    throw std::invalid_argument("settings: " + std::string(setting.key) + " " + reason);
}

}  // namespace

Settings checked(const Settings& settings) {
    schema::check_fields(SettingName(), settings);
    return settings;
}

}  // namespace scree
