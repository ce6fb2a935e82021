// The JSON Schema of scene files (draft 2020-12), from the field tables.
#include "compute/scene_file/scene_schema.h"

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/hex_color.h"
#include "compute/scene_file/shapes_json.h"
#include "compute/schema/check.h"

namespace scree {

namespace {

using namespace schema;
using nlohmann::ordered_json;

ordered_json number(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
    return value;
}
ordered_json number(std::integral auto value) {
    return value;
}
ordered_json number(float value) {  // with the float's shortest digits, 0.6, not those of the double next to it
    char digits[64];
    const char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    double wide = 0;
    std::from_chars(digits, end, wide);
    return number(wide);
}
template <glm::length_t size>
ordered_json number(const glm::vec<size, float>& v) {
    ordered_json made = ordered_json::array();
    for (glm::length_t i = 0; i < size; ++i) made.push_back(number(v[i]));
    return made;
}

ordered_json reference(const std::string& name) {
    return {{"$ref", "#/$defs/" + name}};
}

// Unlimited sides are omitted.
void limit(ordered_json& made, const Range& range) {
    if (range.low > -static_cast<double>(unlimited)) made[range.above_low ? "exclusiveMinimum" : "minimum"] = number(range.low);
    if (range.high < static_cast<double>(unlimited)) made[range.below_high ? "exclusiveMaximum" : "maximum"] = number(range.high);
}
ordered_json number_within(const Range& range) {
    if (range.low <= -static_cast<double>(unlimited) && range.high >= static_cast<double>(unlimited)) return reference("number");
    ordered_json made = {{"type", "number"}};
    limit(made, range);
    return made;
}
ordered_json vector_within(const Range& range, glm::length_t size) {
    const ordered_json items = number_within(range);
    if (size == 3 && items.contains("$ref")) return reference("vector");
    return {{"type", "array"}, {"items", items}, {"minItems", size}, {"maxItems", size}};
}
ordered_json integer_within(const Range& range, Refers refers) {
    ordered_json made = {{"type", "integer"}};
    if (refers != Refers::to_nothing) made["type"] = {"integer", "string"};
    made["minimum"] = 0;
    limit(made, range);
    return made;
}
ordered_json list_of(const ordered_json& items, const Range& range) {
    ordered_json made = {{"type", "array"}, {"items", items}};
    if (range.low > 0) made["minItems"] = number(range.low);
    if (range.high < largest) made["maxItems"] = number(range.high);
    return made;
}
ordered_json object_of(const char* about, const ordered_json& required, const ordered_json& properties,
                       const ordered_json& conditions) {
    ordered_json made = {{"description", about}, {"type", "object"}};
    if (!required.empty()) made["required"] = required;
    made["additionalProperties"] = false;
    made["properties"] = properties;
    made.merge_patch(conditions);
    return made;
}
ordered_json one_of(const ordered_json& properties) {
    return {{"type", "object"},
            {"minProperties", 1},
            {"maxProperties", 1},
            {"additionalProperties", false},
            {"properties", properties}};
}

// A field whatever its type, which the compiler takes once. `usual`: its default; null: none.
struct Entry {
    const char* key;
    const char* unit;
    const char* about;
    bool required;
    ordered_json schema, usual;
};
void add_entry(Entry entry, ordered_json& required, ordered_json& properties) {
    ordered_json& made = properties[entry.key] = std::move(entry.schema);
    if (!entry.usual.is_null() && !entry.required) made["default"] = std::move(entry.usual);
    std::string about = entry.about;
    if (*entry.unit) about += " (" + std::string(entry.unit) + ")";
    if (!about.empty()) made["description"] = about;
    if (entry.required) required.push_back(entry.key);
}

// Conditions on an object beyond its fields; null removes a key.
template <class Struct>
ordered_json conditions() {
    if constexpr (std::is_same_v<Struct, Fracture>)
        return ordered_json::parse(R"({"oneOf": [{"required": ["impulse"]}, {"required": ["momentum"]}]})");
    if constexpr (std::is_same_v<Struct, Viewpoint>)
        return ordered_json::parse(R"({"oneOf": [{"required": ["eye", "target"], "not": {"required": ["path"]}},
            {"required": ["path"], "not": {"anyOf": [{"required": ["eye"]}, {"required": ["target"]},
                                                     {"required": ["vertical_fov"]}]}}],
            "properties": {"eye": {"default": null}, "target": {"default": null}}})");
    return ordered_json::object();
}

class Schema {
public:
    // The schema of a struct; structs of its fields are defined in $defs.
    template <class Struct>
    ordered_json object(const char* about) {
        ordered_json required = ordered_json::array(), properties = ordered_json::object();
        add_fields<Struct>(required, properties);
        return object_of(about, required, properties, conditions<Struct>());
    }
    void define(const std::string& name, ordered_json schema) { defs_[name] = std::move(schema); }
    const ordered_json& defs() const { return defs_; }

private:
    template <class Struct>
    ordered_json defined() {
        constexpr auto& known = table<Struct>;
        if (!defs_.contains(known.name)) {
            defs_[known.name] = nullptr;  // reserves its position before nested definitions
            ordered_json made = object<Struct>(known.about);
            defs_[known.name] = std::move(made);
        }
        return reference(known.name);
    }

    template <class Variant>
    ordered_json one_of_kinds() {
        constexpr auto& kinds = alternatives<Variant>;
        ordered_json properties = ordered_json::object();
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            ((properties[kinds.keys[i]] = defined<std::variant_alternative_t<i, Variant>>()), ...);
        }
        (std::make_index_sequence<std::variant_size_v<Variant>>());
        define(kinds.name, one_of(properties));
        return reference(kinds.name);
    }

    template <class Struct>
    void add_fields(ordered_json& required, ordered_json& properties) {
        const Struct by_default{};
        for_each_field<Struct>([&]<class Member>(const Field<Struct, Member>& field) {
            if constexpr (HasTable<Member>) {
                if (field.embedded()) return add_fields<Member>(required, properties);
            }
            constexpr bool has_unit = !is_list<Member> && !is_optional<Member> && !HasTable<Member>;
            Entry entry{field.key,
                        has_unit ? field.unit : "",
                        field.about,
                        field.presence == schema::Presence::required,
                        type_of<Member>(field.range, field.refers),
                        nullptr};
            if (field.is_color) {
                const ordered_json hex = {{"type", "string"}, {"pattern", hex_color_pattern}};
                entry.schema = {{"anyOf", ordered_json::array({entry.schema, hex})}};
            }
            const Member& usual = by_default.*field.member;
            if constexpr (Number<Member>) {
                if (field.refers == Refers::to_nothing && field.range.holds(usual)) entry.usual = number(usual);
            } else if constexpr (requires { Member::length(); }) {
                entry.usual = number(usual);
            } else if constexpr (HasWords<Member>) {
                entry.usual = words<Member>[static_cast<std::size_t>(usual)];
            } else if constexpr (std::is_same_v<Member, bool> || std::is_same_v<Member, std::string>) {
                entry.usual = usual;
            }
            add_entry(std::move(entry), required, properties);
        });
        if constexpr (std::is_same_v<Struct, Joint>) {
            ordered_json optional = ordered_json::array();
            add_fields<JointPlacement>(optional, properties);
        }
    }
    template <class Member>
    ordered_json type_of(const Range& range, Refers refers) {
        if constexpr (is_optional<Member>) {
            return type_of<typename Member::value_type>(range, refers);
        } else if constexpr (is_list<Member>) {
            return list_of(type_of<typename Member::value_type>({}, Refers::to_nothing), range);
        } else if constexpr (HasTable<Member>) {
            return defined<Member>();
        } else if constexpr (HasAlternatives<Member>) {
            return one_of_kinds<Member>();
        } else if constexpr (HasWords<Member>) {
            return {{"enum", words<Member>}};
        } else if constexpr (std::is_same_v<Member, float>) {
            return number_within(range);
        } else if constexpr (requires { Member::length(); }) {
            return vector_within(range, Member::length());
        } else if constexpr (std::is_same_v<Member, bool>) {
            return {{"type", "boolean"}};
        } else if constexpr (std::is_same_v<Member, std::string>) {
            return {{"type", "string"}};
        } else if constexpr (std::is_same_v<Member, Shape>) {
            return reference("shape");
        } else {
            return integer_within(range, refers);
        }
    }

    ordered_json defs_ = ordered_json::object();
};

// Prints an object or array: `before` it, `between` its elements, printed by `show`, and `after` it.
template <class Show>
void print_elements(std::string& text, const ordered_json& value, const std::string& before, const std::string& between,
                    const std::string& after, const Show& show) {
    text += (value.is_object() ? "{" : "[") + (value.empty() ? "" : before);
    bool first = true;
    for (const auto& [key, one] : value.items()) {
        if (!std::exchange(first, false)) text += between;
        if (value.is_object()) text += ordered_json(key).dump() + ": ";
        show(one);
    }
    text += (value.empty() ? "" : after) + (value.is_object() ? "}" : "]");
}
std::string on_one_line(const ordered_json& value) {
    if (!value.is_structured()) return value.dump();
    std::string text;
    print_elements(text, value, "", ", ", "", [&](const ordered_json& one) { text += on_one_line(one); });
    return text;
}
// Prints on one line what fits.
void print(std::string& text, const ordered_json& value, std::size_t indent) {
    const std::string line = on_one_line(value), inside = "\n" + std::string(indent + 4, ' ');
    if (!value.is_structured() || indent + line.size() <= 110) {
        text += line;
        return;
    }
    print_elements(text, value, inside, "," + inside, "\n" + std::string(indent, ' '),
                   [&](const ordered_json& one) { print(text, one, indent + 4); });
}

}  // namespace

std::string scene_schema() {
    Schema schema;
    schema.define("number", {{"type", "number"}, {"minimum", -3.4e38}, {"maximum", 3.4e38}});
    schema.define("vector", {{"type", "array"}, {"items", reference("number")}, {"minItems", 3}, {"maxItems", 3}});
    schema.define("size", {{"type", "number"}, {"minimum", 0.001}, {"maximum", 100000}, {"description", "m"}});
    schema.define("shape", shape_schema());
    schema.define("material", schema.object<Material>(table<Material>.about));
    const auto& document = table<SceneDocument>;
    ordered_json whole = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "scree scene"}};
    whole.update(schema.object<SceneDocument>(document.about));
    whole["$defs"] = schema.defs();
    std::string text;
    print(text, whole, 0);
    return text + "\n";
}

}  // namespace scree
