// Version of the public API: the declarations of the installed headers (public_headers.txt).
//
// While the first number is 0 the second rises when programs written for the headers before may no longer compile or behave
// otherwise, the third when declarations were added alone. The library is static and C++: program and library are to have the
// same version, which find_package(scree 0.13) checks, and is_library_of_headers() at run time.
#pragma once

#include <string>

#define SCREE_VERSION_MAJOR 0
#define SCREE_VERSION_MINOR 16
#define SCREE_VERSION_PATCH 0

namespace scree {

// Of the headers.
constexpr int version_major = SCREE_VERSION_MAJOR, version_minor = SCREE_VERSION_MINOR, version_patch = SCREE_VERSION_PATCH;

std::string library_version();  // of the compiled library, "0.16.0"

// Whether the headers of the caller and the library that it is linked with are of one version.
inline bool is_library_of_headers() {
    return library_version() ==
           std::to_string(version_major) + "." + std::to_string(version_minor) + "." + std::to_string(version_patch);
}

}  // namespace scree
