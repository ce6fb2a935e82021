// The version of the compiled library.
#include "compute/version.h"

namespace scree {

std::string library_version() {
    return std::to_string(version_major) + "." + std::to_string(version_minor) + "." + std::to_string(version_patch);
}

}  // namespace scree
