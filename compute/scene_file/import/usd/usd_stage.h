// A USD scene composed of its layers: prims with the opinions that hold.
// https://openusd.org/release/glossary.html#livrps-strength-ordering
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene_file/import/notes.h"
#include "compute/scene_file/import/solid_mass.h"
#include "compute/scene_file/import/usd/usd_files.h"

namespace scree::imports {

struct UsdStack {  // a layer and its sublayers, strongest first
    struct Entry {
        std::shared_ptr<UsdLayer> layer;
        double offset = 0, scale = 1;  // from its time to that of the stack
    };
    std::vector<Entry> layers;
    std::string default_prim;
};

// A path there is one here, if it lies under `from`.
struct UsdRename {
    std::string from, to;
    bool keeps_others = false;  // other paths stay as they are
    std::shared_ptr<const UsdRename> next{};
};

struct UsdSite {  // opinions on a prim
    std::shared_ptr<const UsdStack> stack;
    std::string path;
    std::shared_ptr<const UsdRename> rename;
    double offset = 0, scale = 1;  // from the stack's time to the stage's
    bool own = false;              // of the root file itself
};

struct UsdPrim {
    std::string path, name, type;
    std::vector<UsdSite> sites;  // strongest first
    std::vector<std::string> schemas;
    std::vector<std::unique_ptr<UsdPrim>> children;
    const UsdPrim* parent = nullptr;
    bool defined = false, abstract = false, instance = false;
    bool applies(const std::string& schema) const;
};

class UsdStage {
public:
    UsdStage(const std::string& name, Folder& folder, Notes& notes);

    const UsdPrim& root() const { return *root_; }
    const UsdPrim* find(const std::string& path) const;
    Origin at(const UsdPrim& prim) const { return {shown_ + ": " + prim.path, 0, ""}; }
    // Of the first layer that has it; none else.
    UsdValue metadata(const std::string& name) const;
    double metadata(const std::string& name, double otherwise) const;
    std::string metadata(const std::string& name, const std::string& otherwise) const;

    // The strongest value of an attribute at the stage's time.
    UsdValue value(const UsdPrim& prim, const std::string& name) const;
    bool moves(const UsdPrim& prim, const std::string& name) const;  // has samples of several times
    double number(const UsdPrim& prim, const std::string& name, double otherwise) const;
    bool flag(const UsdPrim& prim, const std::string& name, bool otherwise) const;
    std::string text(const UsdPrim& prim, const std::string& name, const std::string& otherwise) const;
    std::optional<dvec3> vector(const UsdPrim& prim, const std::string& name) const;
    std::optional<dquat> turn(const UsdPrim& prim, const std::string& name) const;  // normalised; none of length 0
    std::vector<std::string> targets(const UsdPrim& prim, const std::string& name) const;
    std::vector<std::string> properties(const UsdPrim& prim) const;
    // Of a prim in its parent, and whether it leaves out what lies above.
    glm::dmat4 local(const UsdPrim& prim, bool& resets) const;
    glm::dmat4 world(const UsdPrim& prim) const;

    std::optional<double> time{};  // none: the start of the scene, or the first sample

private:
    struct Expansion;
    void expand(Expansion& all, const UsdSite& site, int depth);
    void arcs(Expansion& all, const UsdSite& site, const std::string& field, int depth);
    void variants(Expansion& all, const UsdSite& site, int depth);
    void compose(UsdPrim& prim, int depth);
    void describe(UsdPrim& prim);
    std::shared_ptr<const UsdStack> stack_of(const std::shared_ptr<UsdLayer>& layer, const Origin& at);
    void add_layer(UsdStack& stack, const std::shared_ptr<UsdLayer>& layer, double offset, double scale,
                   std::vector<const UsdLayer*>& above, const Origin& at);
    glm::dmat4 operation(const UsdPrim& prim, const std::string& name) const;

    Notes& notes_;
    UsdFiles files_;
    std::string shown_;
    std::map<std::string, std::shared_ptr<const UsdStack>> stacks_;
    std::unique_ptr<UsdPrim> root_;
    std::map<std::string, const UsdPrim*> prims_;
    // Looks at layers, and their numbers in part: what is small on disk may refer to itself a billion times over.
    void look(const UsdPrim& prim, std::size_t times) const;
    bool says(const UsdPrim& prim, const UsdSite& site) const;
    mutable std::size_t looks_ = 0;
    std::size_t sites_ = 0;
};

}  // namespace scree::imports
