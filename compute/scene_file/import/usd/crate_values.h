// Values of a crate file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compute/scene_file/import/usd/crate_bytes.h"
#include "compute/scene_file/import/usd/usd_value.h"

namespace scree::imports {

struct Crate {
    std::string bytes;
    int minor = 8;  // of version 0.minor
    std::vector<std::string> tokens, paths;
    std::vector<std::uint32_t> strings;  // tokens

    const std::string& token(std::uint64_t index) const;
    const std::string& string(std::uint64_t index) const;
    const std::string& path(std::uint64_t index) const;
    // A representation of 8 bytes: bit 63 array, 62 inlined, 61 compressed, 48 to 55 the type, below the value or where it lies.
    // Throws CrateError.
    UsdValue value(std::uint64_t rep, int depth = 0) const;
};

}  // namespace scree::imports
