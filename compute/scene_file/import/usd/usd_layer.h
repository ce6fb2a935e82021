// One USD file, not yet composed with others: its specs by their paths.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compute/scene_file/import/notes.h"
#include "compute/scene_file/import/usd/usd_value.h"

namespace scree::imports {

// What a file says of a prim, a property or a variant. Names of fields are those of crate files.
struct UsdSpec {
    enum class Kind { root, prim, attribute, relationship, variant, variant_set } kind = Kind::prim;
    std::vector<std::pair<std::string, UsdValue>> fields;
    std::vector<std::pair<std::string, std::uint64_t>> packed;  // of a crate, not yet read
    std::vector<std::string> children, properties;              // in order
    const UsdValue* find(const std::string& name) const;
};

struct UsdLayer {
    std::string shown;                               // for messages
    std::string place;                               // path of the file; within a package PACKAGE[NAME]
    std::unordered_map<std::string, UsdSpec> specs;  // "/" is the layer itself; /a/b, /a/b.property, /a{set=choice}b
    std::function<UsdValue(std::uint64_t)> unpack;   // of a crate's fields

    const UsdSpec* find(const std::string& path) const;
    UsdValue value(const UsdSpec& spec, const std::string& name) const;
    UsdValue value(const std::string& path, const std::string& name) const;
    bool has(const UsdSpec& spec, const std::string& name) const;
};

// Path of a child prim, from that of its parent.
std::string usd_child(const std::string& parent, const std::string& name);

// Without choices of variants.
std::string usd_plain(const std::string& path);
// Of a path that may begin at a prim, as "../other".
std::string usd_absolute(const std::string& path, const std::string& prim);

// Throw ImportError.
std::shared_ptr<UsdLayer> layer_of_usda(const std::string& text, const std::string& shown);
std::shared_ptr<UsdLayer> layer_of_crate(std::string bytes, const std::string& shown);
// By its first bytes.
std::shared_ptr<UsdLayer> layer_of_usd(std::string bytes, const std::string& shown);

}  // namespace scree::imports
