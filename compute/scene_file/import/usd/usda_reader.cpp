// USD's text format. https://openusd.org/release/glossary.html, and the grammar of pxr/usd/sdf.
#include <optional>
#include <utility>

#include "compute/scene_file/import/usd/usd_layer.h"
#include "compute/scene_file/import/usd/usda_text.h"

namespace scree::imports {

namespace {

class Usda : UsdaText {
public:
    Usda(const std::string& text, UsdLayer& layer) : UsdaText(text, layer.shown), layer_(layer) {}
    void read();

private:
    void metadata(UsdSpec& spec);
    void metadatum(UsdSpec& spec, const std::string& edit, const std::string& name);
    UsdSpec& spec_at(const std::string& path, UsdSpec::Kind kind);
    void prim(const std::string& specifier, const std::string& parent, int depth);
    void body(const std::string& path, int depth);
    void variant_set(const std::string& path, int depth);
    void property(const std::string& first, const std::string& path);
    void relationship(const std::string& edit, const std::string& path);
    void keep(UsdSpec& spec, const std::string& name, UsdValue value);

    UsdLayer& layer_;
};

std::optional<UsdEdit> edit_of(const std::string& word) {
    if (word == "add") return UsdEdit::added;
    if (word == "prepend") return UsdEdit::prepended;
    if (word == "append") return UsdEdit::appended;
    if (word == "delete") return UsdEdit::deleted;
    if (word == "reorder") return UsdEdit::ordered;
    return std::nullopt;
}

// As crate files call them.
std::string field_of(const std::string& name) {
    if (name == "variants") return "variantSelection";
    if (name == "variantSets") return "variantSetNames";
    if (name == "inherits") return "inheritPaths";
    return name;
}

void Usda::keep(UsdSpec& spec, const std::string& name, UsdValue value) {
    for (auto& [key, known] : spec.fields) {
        if (key != name) continue;
        if (known.kind == UsdValue::Kind::edits && value.kind == UsdValue::Kind::edits)
            known.edits.all.insert(known.edits.all.end(), value.edits.all.begin(), value.edits.all.end());
        else
            known = std::move(value);
        return;
    }
    constexpr std::size_t most_fields = 1000;
    if (spec.fields.size() >= most_fields) fail("a prim or property has more than 1000 metadata");
    spec.fields.emplace_back(name, std::move(value));
}

void Usda::metadatum(UsdSpec& spec, const std::string& edit, const std::string& name) {
    expect('=');
    const bool lists = name == "references" || name == "payload" || name == "inherits" || name == "specializes" ||
                       name == "apiSchemas" || name == "variantSets" || name == "subLayers";
    if (lists)
        keep(spec, field_of(name), UsdValue::of_edits(edit_of(edit).value_or(UsdEdit::whole), items()));
    else
        keep(spec, field_of(name), value(0));
}

// Between parentheses, if there are any.
void Usda::metadata(UsdSpec& spec) {
    if (!accept('(')) return;
    while (!accept(')')) {
        if (at_string()) {
            string();  // a comment
            continue;
        }
        std::string name = word(), edit;
        if (edit_of(name)) edit = std::exchange(name, word());
        metadatum(spec, edit, name);
        accept(',');
    }
}

UsdSpec& Usda::spec_at(const std::string& path, UsdSpec::Kind kind) {
    UsdSpec& spec = layer_.specs[path];
    spec.kind = kind;
    return spec;
}

void Usda::relationship(const std::string& edit, const std::string& path) {
    const std::string name = word();
    const std::string whole = path + "." + name;
    const bool known = layer_.find(whole) != nullptr;
    UsdSpec& spec = spec_at(whole, UsdSpec::Kind::relationship);
    if (!known) layer_.specs[path].properties.push_back(name);
    if (accept('=')) keep(spec, "targetPaths", UsdValue::of_edits(edit_of(edit).value_or(UsdEdit::whole), items()));
    UsdSpec ignored;
    metadata(ignored);
}

void Usda::property(const std::string& first, const std::string& path) {
    std::string type = first, edit;
    while (type == "custom" || type == "uniform" || type == "varying" || type == "config" || edit_of(type)) {
        if (edit_of(type)) edit = type;
        type = word();
    }
    if (type == "rel") return relationship(edit, path);
    const bool array = accept('[');
    if (array) expect(']');
    const std::string name = word();
    std::string part = "default";
    if (accept_here('.')) part = word();
    const std::string whole = path + "." + name;
    const bool known = layer_.find(whole) != nullptr;
    UsdSpec& spec = spec_at(whole, UsdSpec::Kind::attribute);
    if (!known) layer_.specs[path].properties.push_back(name);
    keep(spec, "typeName", UsdValue::of_text(type + (array ? "[]" : "")));
    if (accept('=')) {
        if (part == "connect")
            keep(spec, "connectionPaths", UsdValue::of_edits(edit_of(edit).value_or(UsdEdit::whole), items()));
        else if (part == "timeSamples")
            keep(spec, part, samples(0));
        else
            keep(spec, part, value(0));
    }
    UsdSpec ignored;
    metadata(ignored);
}

void Usda::variant_set(const std::string& path, int depth) {
    const std::string set = string();
    expect('=');
    expect('{');
    while (!accept('}')) {
        if (!at_string()) fail("expected the name of a variant");
        const std::string choice = string();
        const std::string variant = path + "{" + set + "=" + choice + "}";
        metadata(spec_at(variant, UsdSpec::Kind::variant));
        expect('{');
        body(variant, depth + 1);
    }
}

// Up to its closing brace.
void Usda::body(const std::string& path, int depth) {
    if (depth > deepest) fail("prims lie deeper than 100 within one another");
    while (!accept('}')) {
        const std::string first = word();
        if (first == "def" || first == "over" || first == "class") {
            prim(first, path, depth + 1);
        } else if (first == "variantSet") {
            if (!at_string()) fail("expected the name of a set of variants");
            variant_set(path, depth + 1);
        } else if (first == "reorder") {
            const std::string what = word();
            if (what != "rel" && accept('='))
                items();
            else
                property(first, path);
        } else {
            property(first, path);
        }
    }
}

void Usda::prim(const std::string& specifier, const std::string& parent, int depth) {
    std::string type;
    if (!at_string()) type = word();
    if (!at_string()) fail("expected the name of a prim between quotes");
    const std::string name = string();
    if (name.empty() || name.find_first_of("/.{}[]<>") != name.npos) fail("\"" + name.substr(0, 60) + "\" is no name of a prim");
    const std::string path = usd_child(parent, name);
    if (layer_.find(path)) fail("the prim " + path.substr(0, 200) + " is there twice");
    layer_.specs[parent].children.push_back(name);
    UsdSpec& spec = spec_at(path, UsdSpec::Kind::prim);
    keep(spec, "specifier", UsdValue::of_number(specifier == "def" ? 0 : specifier == "over" ? 1 : 2));
    if (!type.empty()) keep(spec, "typeName", UsdValue::of_text(type));
    const std::string above = std::exchange(here_, path);
    metadata(spec);
    expect('{');
    body(path, depth);
    here_ = above;
}

void Usda::read() {
    metadata(spec_at("/", UsdSpec::Kind::root));
    while (peek() != '\0') {
        const std::string first = word();
        if (first == "reorder") {
            word();
            expect('=');
            items();
        } else if (first == "def" || first == "over" || first == "class") {
            prim(first, "/", 0);
        } else {
            fail("expected def, over or class, not \"" + first.substr(0, 60) + "\"");
        }
    }
    if (!ends()) fail("a byte of 0 is in the text");
}

}  // namespace

std::shared_ptr<UsdLayer> layer_of_usda(const std::string& text, const std::string& shown) {
    auto layer = std::make_shared<UsdLayer>();
    layer->shown = shown;
    Usda(text, *layer).read();
    return layer;
}

}  // namespace scree::imports
