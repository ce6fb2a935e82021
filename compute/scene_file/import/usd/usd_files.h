// The files of a USD scene: layers by the names that others give them, also within .usdz packages.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/import/usd/usd_layer.h"

namespace scree::imports {

class UsdFiles {
public:
    explicit UsdFiles(Folder& folder) : folder_(folder) {}
    std::shared_ptr<UsdLayer> root(const std::string& name);
    // That a layer names. Refuses what cannot be read.
    std::shared_ptr<UsdLayer> beside(const UsdLayer& layer, const Origin& at, const std::string& asset);

private:
    struct Package {
        std::string bytes, first;
        std::map<std::string, std::pair<std::size_t, std::size_t>> files;  // start and size
    };
    std::shared_ptr<UsdLayer> read(const Origin& at, const std::string& file, const std::string& inside);
    const Package& package(const Origin& at, const std::string& file);

    Folder& folder_;
    std::map<std::string, std::shared_ptr<UsdLayer>> layers_;
    std::map<std::string, Package> packages_;
};

}  // namespace scree::imports
