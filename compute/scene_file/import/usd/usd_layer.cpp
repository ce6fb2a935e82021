// Specs of a USD file by path.
#include "compute/scene_file/import/usd/usd_layer.h"

#include <algorithm>

namespace scree::imports {

const UsdValue* UsdSpec::find(const std::string& name) const {
    for (const auto& [key, value] : fields)
        if (key == name) return &value;
    return nullptr;
}

const UsdSpec* UsdLayer::find(const std::string& path) const {
    const auto found = specs.find(path);
    return found == specs.end() ? nullptr : &found->second;
}

UsdValue UsdLayer::value(const UsdSpec& spec, const std::string& name) const {
    if (const UsdValue* known = spec.find(name)) return *known;
    for (const auto& [key, rep] : spec.packed)
        if (key == name) return unpack(rep);
    return {};
}

UsdValue UsdLayer::value(const std::string& path, const std::string& name) const {
    const UsdSpec* spec = find(path);
    return spec ? value(*spec, name) : UsdValue{};
}

bool UsdLayer::has(const UsdSpec& spec, const std::string& name) const {
    if (spec.find(name)) return true;
    for (const auto& [key, rep] : spec.packed)
        if (key == name) return true;
    return false;
}

std::string usd_child(const std::string& parent, const std::string& name) {
    return parent + (parent.ends_with('/') || parent.ends_with('}') ? "" : "/") + name;
}

std::string usd_plain(const std::string& path) {
    std::string plain;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (path[i] != '{') {
            plain += path[i];
            continue;
        }
        i = std::min(path.find('}', i), path.size() - 1);
        if (i + 1 < path.size() && path[i + 1] != '/' && path[i + 1] != '.' && path[i + 1] != '{') plain += '/';
    }
    return plain;
}

std::string usd_absolute(const std::string& path, const std::string& prim) {
    if (path.starts_with('/')) return path;
    std::string base = usd_plain(prim), rest = path;
    while (rest.starts_with("../")) {
        rest = rest.substr(3);
        base = base.substr(0, base.rfind('/'));
    }
    return base + (rest.empty() || rest.starts_with('.') ? "" : "/") + rest;
}

std::shared_ptr<UsdLayer> layer_of_usd(std::string bytes, const std::string& shown) {
    if (bytes.starts_with("PXR-USDC")) return layer_of_crate(std::move(bytes), shown);
    if (bytes.starts_with("#usda ") || bytes.starts_with("#sdf ")) return layer_of_usda(bytes, shown);
    refuse({shown, 0, ""}, "is no USD file: it begins with neither #usda nor PXR-USDC");
}

}  // namespace scree::imports
