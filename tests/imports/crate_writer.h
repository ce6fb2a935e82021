// Writes crate files (.usdc) for tests: the specs of a layer that was read from text.
#pragma once

#include <string>

#include "compute/scene_file/import/usd/usd_layer.h"

namespace scree::imported {

// Version 0.`minor`, 4 to 10: sizes of arrays, compression of reals and payloads differ.
std::string crate_of(const imports::UsdLayer& layer, int minor);

// A ZIP archive whose files are stored.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, int method = 0);

}  // namespace scree::imported
