// Composition: local opinions, inherits, variants, references, payloads, specializes, in this order of strength.
#include "compute/scene_file/import/usd/usd_stage.h"

#include <algorithm>
#include <set>

namespace scree::imports {

namespace {

constexpr int deepest_arcs = 60, deepest_prims = 200;
constexpr std::size_t most_prims = 500'000, most_sites = 4'000'000;

bool lies_under(const std::string& path, const std::string& above) {
    return above == "/" ||
           (path.starts_with(above) && (path.size() == above.size() || path[above.size()] == '/' || path[above.size()] == '.'));
}

// As the stage calls it; empty if it does not reach there.
std::string renamed(std::string path, const UsdRename* rename) {
    for (; rename; rename = rename->next.get()) {
        if (lies_under(path, rename->from))
            path = rename->to + path.substr(rename->from == "/" ? 0 : rename->from.size());
        else if (!rename->keeps_others)
            return "";
    }
    return path;
}

std::vector<UsdItem> items_of(const UsdValue& value) {
    std::vector<UsdItem> items;
    for (const std::string& text : value.texts) items.push_back({text, "", 0, 1});
    return items;
}

// A list that the layers of a stack edit.
std::vector<UsdItem> composed_list(const UsdSite& site, const std::string& field) {
    std::vector<UsdItem> list;
    const auto& layers = site.stack->layers;
    for (auto one = layers.rbegin(); one != layers.rend(); ++one) {
        const UsdSpec* spec = one->layer->find(site.path);
        if (!spec || !one->layer->has(*spec, field)) continue;
        const UsdValue value = one->layer->value(*spec, field);
        if (value.kind == UsdValue::Kind::edits) apply_edits(value.edits, list);
        if (value.kind == UsdValue::Kind::texts) list = items_of(value);
    }
    return list;
}

}  // namespace

void UsdStage::look(const UsdPrim& prim, std::size_t times) const {
    constexpr std::size_t most_looks = 100'000'000;
    if ((looks_ += times) > most_looks) refuse(at(prim), "the scene's layers would be asked more than 100000000 times");
}

bool UsdStage::says(const UsdPrim& prim, const UsdSite& site) const {
    look(prim, site.stack->layers.size());
    return std::any_of(site.stack->layers.begin(), site.stack->layers.end(),
                       [&](const UsdStack::Entry& one) { return one.layer->find(site.path) != nullptr; });
}

bool UsdPrim::applies(const std::string& schema) const {
    return std::find(schemas.begin(), schemas.end(), schema) != schemas.end();
}

struct UsdStage::Expansion {
    const UsdPrim& prim;
    std::vector<UsdSite>& sites;
    std::vector<std::pair<const UsdStack*, std::string>> open{};  // to find circles
};

void UsdStage::add_layer(UsdStack& stack, const std::shared_ptr<UsdLayer>& layer, double offset, double scale,
                         std::vector<const UsdLayer*>& above, const Origin& at) {
    if (std::find(above.begin(), above.end(), layer.get()) != above.end()) refuse(at, "its sublayers are a circle");
    if (above.size() > static_cast<std::size_t>(deepest_arcs) || stack.layers.size() > 1000)
        refuse(at, "has more than 1000 sublayers, or deeper than 60");
    above.push_back(layer.get());
    stack.layers.push_back({layer, offset, scale});
    const UsdValue names = layer->value("/", "subLayers"), times = layer->value("/", "subLayerOffsets");
    std::vector<UsdItem> items = items_of(names);
    if (names.kind == UsdValue::Kind::edits) apply_edits(names.edits, items);
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (times.width == 2 && times.numbers.size() > 2 * i + 1 && times.numbers[2 * i + 1] != 0)
            items[i].offset = times.numbers[2 * i], items[i].scale = times.numbers[2 * i + 1];
        add_layer(stack, files_.beside(*layer, at, items[i].text), offset + scale * items[i].offset, scale * items[i].scale,
                  above, at);
    }
    above.pop_back();
}

std::shared_ptr<const UsdStack> UsdStage::stack_of(const std::shared_ptr<UsdLayer>& layer, const Origin& at) {
    std::shared_ptr<const UsdStack>& known = stacks_[layer->place];
    if (known) return known;
    auto made = std::make_shared<UsdStack>();
    std::vector<const UsdLayer*> above;
    add_layer(*made, layer, 0, 1, above, at);
    const UsdValue name = layer->value("/", "defaultPrim");
    if (!name.texts.empty()) made->default_prim = (name.texts[0].starts_with('/') ? "" : "/") + name.texts[0];
    return known = made;
}

void UsdStage::arcs(Expansion& all, const UsdSite& site, const std::string& field, int depth) {
    const bool inside = field == "inheritPaths" || field == "specializes";
    for (const UsdItem& item : composed_list(site, field)) {
        UsdSite target{site.stack, "", nullptr, site.offset, site.scale, false};
        if (!item.text.empty() && !inside) {
            // The layer that names it says where names begin; one of the stack that has the field.
            const UsdLayer* named_by = site.stack->layers[0].layer.get();
            for (const UsdStack::Entry& one : site.stack->layers) {
                const UsdSpec* spec = one.layer->find(site.path);
                if (!spec || !one.layer->has(*spec, field)) continue;
                std::vector<UsdItem> own;
                const UsdValue value = one.layer->value(*spec, field);
                apply_edits(value.edits, own);
                if (std::find(own.begin(), own.end(), item) == own.end()) continue;
                named_by = one.layer.get();
                break;
            }
            target.stack = stack_of(files_.beside(*named_by, at(all.prim), item.text), at(all.prim));
        }
        target.offset = site.offset + site.scale * item.offset;
        target.scale = site.scale * item.scale;
        target.path = item.path.empty() ? target.stack->default_prim : usd_plain(item.path);
        if (target.path.empty()) {
            notes_.add(at(all.prim), field, "of a file without a default prim brings nothing");
            continue;
        }
        const std::string here = usd_plain(site.path);
        if (target.stack == site.stack && lies_under(here, target.path))
            refuse(at(all.prim), "refers to itself, or to what it lies in");
        target.rename = std::make_shared<UsdRename>(UsdRename{target.path, here, target.stack == site.stack, site.rename});
        if (!says(all.prim, target)) {
            if (!inside) notes_.add(at(all.prim), field, "to " + target.path + " bring nothing: that prim is not there");
            continue;
        }
        expand(all, target, depth + 1);
    }
}

void UsdStage::variants(Expansion& all, const UsdSite& site, int depth) {
    for (const UsdItem& set : composed_list(site, "variantSetNames")) {
        std::string choice;
        for (const UsdSite& strong : all.sites) {
            look(all.prim, strong.stack->layers.size());
            for (const UsdStack::Entry& one : strong.stack->layers) {
                const UsdValue chosen = one.layer->value(strong.path, "variantSelection");
                if (!choice.empty() || !chosen.members) continue;
                const auto found = chosen.members->find(set.text);
                if (found != chosen.members->end() && !found->second.texts.empty()) choice = found->second.texts[0];
            }
        }
        if (choice.empty()) {
            notes_.add(at(all.prim), "variants", "of the set \"" + set.text.substr(0, 60) + "\": none is chosen");
            continue;
        }
        UsdSite target = site;
        target.path = site.path + "{" + set.text + "=" + choice + "}";
        if (says(all.prim, target)) expand(all, target, depth + 1);
    }
}

void UsdStage::expand(Expansion& all, const UsdSite& site, int depth) {
    if (depth > deepest_arcs || all.sites.size() > 1000) refuse(at(all.prim), "has references deeper than 60, or more than 1000");
    const std::pair<const UsdStack*, std::string> here{site.stack.get(), site.path};
    if (std::find(all.open.begin(), all.open.end(), here) != all.open.end()) refuse(at(all.prim), "its references are a circle");
    if ((sites_ += site.stack->layers.size()) > most_sites)
        refuse(at(all.prim), "the scene has more than 4000000 opinions on prims");
    all.open.push_back(here);
    all.sites.push_back(site);
    arcs(all, site, "inheritPaths", depth);
    variants(all, site, depth);
    arcs(all, site, "references", depth);
    arcs(all, site, "payload", depth);
    arcs(all, site, "specializes", depth);
    all.open.pop_back();
}

void UsdStage::describe(UsdPrim& prim) {
    std::optional<double> active, instanceable;
    std::vector<UsdItem> schemas;
    for (const UsdSite& site : prim.sites) {
        for (const UsdStack::Entry& one : site.stack->layers) {
            const UsdSpec* spec = one.layer->find(site.path);
            if (!spec) continue;
            const auto number = [&](const char* name, std::optional<double>& into) {
                const UsdValue value = one.layer->value(*spec, name);
                if (!into && value.kind == UsdValue::Kind::numbers && !value.numbers.empty()) into = value.numbers[0];
            };
            std::optional<double> specifier;
            number("specifier", specifier);
            number("active", active);
            number("instanceable", instanceable);
            if (specifier == 0 && !prim.abstract) prim.defined = true;
            if (specifier == 2 && !prim.defined) prim.abstract = true;
            const UsdValue type = one.layer->value(*spec, "typeName");
            if (prim.type.empty() && !type.texts.empty()) prim.type = type.texts[0];
        }
    }
    for (auto site = prim.sites.rbegin(); site != prim.sites.rend(); ++site)
        for (auto one = site->stack->layers.rbegin(); one != site->stack->layers.rend(); ++one) {
            const UsdValue value = one->layer->value(site->path, "apiSchemas");
            if (value.kind == UsdValue::Kind::edits) apply_edits(value.edits, schemas);
        }
    for (const UsdItem& schema : schemas) prim.schemas.push_back(schema.text);
    if (active == 0) prim.defined = false, prim.sites.clear();
    prim.instance = instanceable == 1 && prim.sites.size() > 1;
}

void UsdStage::compose(UsdPrim& prim, int depth) {
    if (depth > deepest_prims) refuse(at(prim), "prims lie deeper than 200 within one another");
    std::vector<std::string> names;
    std::set<std::string> known;
    for (auto site = prim.sites.rbegin(); site != prim.sites.rend(); ++site) {
        if (prim.instance && site->own) continue;
        for (auto one = site->stack->layers.rbegin(); one != site->stack->layers.rend(); ++one)
            if (const UsdSpec* spec = one->layer->find(site->path))
                for (const std::string& name : spec->children)
                    if (known.insert(name).second) names.push_back(name);
    }
    for (const std::string& name : names) {
        auto child = std::make_unique<UsdPrim>();
        child->name = name;
        child->path = usd_child(prim.path, name);
        child->parent = &prim;
        if (prims_.size() >= most_prims) refuse(at(prim), "the scene has more than 500000 prims");
        Expansion all{*child, child->sites};
        for (const UsdSite& site : prim.sites) {
            if (prim.instance && site.own) continue;
            UsdSite below = site;
            below.path = usd_child(site.path, name);
            if (says(*child, below)) expand(all, below, 0);
        }
        describe(*child);
        prims_[child->path] = child.get();
        compose(*child, depth + 1);
        prim.children.push_back(std::move(child));
    }
}

UsdStage::UsdStage(const std::string& name, Folder& folder, Notes& notes)
    : notes_(notes), files_(folder), shown_(folder.shown()) {
    const auto layer = files_.root(name);
    const auto stack = stack_of(layer, {shown_, 0, ""});
    root_ = std::make_unique<UsdPrim>();
    root_->path = "/";
    root_->defined = true;
    root_->sites.push_back({stack, "/", nullptr, 0, 1, true});
    const UsdValue start = metadata("startTimeCode");
    if (start.kind == UsdValue::Kind::numbers && !start.numbers.empty()) time = start.numbers[0];
    compose(*root_, 0);
}

const UsdPrim* UsdStage::find(const std::string& path) const {
    const auto found = prims_.find(path.substr(0, path.find('.')));
    return found == prims_.end() ? nullptr : found->second;
}

UsdValue UsdStage::metadata(const std::string& name) const {
    for (const UsdStack::Entry& one : root_->sites[0].stack->layers) {
        const UsdValue value = one.layer->value("/", name);
        if (value.kind != UsdValue::Kind::none) return value;
    }
    return {};
}

std::vector<std::string> UsdStage::targets(const UsdPrim& prim, const std::string& name) const {
    std::vector<UsdItem> list;
    for (auto site = prim.sites.rbegin(); site != prim.sites.rend(); ++site)
        for (auto one = site->stack->layers.rbegin(); one != site->stack->layers.rend(); ++one) {
            look(prim, 1);
            UsdValue value = one->layer->value(site->path + "." + name, "targetPaths");
            for (const auto& [edit, items] : value.edits.all) look(prim, items.size());
            for (auto& [edit, items] : value.edits.all) {
                for (UsdItem& item : items) item.path = renamed(usd_plain(item.path), site->rename.get());
                std::erase_if(items, [](const UsdItem& item) { return item.path.empty(); });
            }
            apply_edits(value.edits, list);
        }
    std::vector<std::string> paths;
    for (const UsdItem& item : list) paths.push_back(item.path);
    return paths;
}

std::vector<std::string> UsdStage::properties(const UsdPrim& prim) const {
    std::set<std::string> names;
    for (const UsdSite& site : prim.sites)
        for (const UsdStack::Entry& one : site.stack->layers)
            if (const UsdSpec* spec = one.layer->find(site.path)) names.insert(spec->properties.begin(), spec->properties.end());
    return {names.begin(), names.end()};
}

}  // namespace scree::imports
