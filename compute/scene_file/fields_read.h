// Reading a struct from JSON by its field table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "compute/scene_file/json_reading.h"
#include "compute/schema/check.h"
#include "compute/schema/field.h"

namespace scree::json_reading {

// The index of what has a name, and that of another thing of this name.
struct Named {
    std::size_t index;
    std::optional<std::size_t> namesake = std::nullopt;
};
using Numbers = std::map<std::string, Named>;
struct NamedThings {
    Numbers bodies, joints;
};
template <class Things>
Numbers numbers_of(const Things& things) {
    Numbers numbers;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (!things[i].name.empty())
            if (const auto [named, is_new] = numbers.try_emplace(things[i].name, Named{i}); !is_new) named->second.namesake = i;
    return numbers;
}

// Index of a body or joint, given by index or name. `or_world`: may be omitted for the world, or be "world".
std::size_t index_of(const json& value, const Place& place, schema::Refers refers, bool or_world, const NamedThings& named);

// The keys of a struct, with those of embedded structs.
template <schema::HasTable Struct>
const Names& keys_of() {
    static const Names keys = [] {
        Names made;
        schema::for_each_field<Struct>([&]<class Member>(const schema::Field<Struct, Member>& field) {
            if constexpr (schema::HasTable<Member>) {
                if (field.embedded()) return void(made.insert(made.end(), keys_of<Member>().begin(), keys_of<Member>().end()));
            }
            made.emplace_back(field.key);
        });
        return made;
    }();
    return keys;
}

template <class Value>
void read_value(const json& value, const Place& place, Value& out, const char* unit, const NamedThings& named);
template <schema::HasTable Struct>
void read_fields(const json& object, const Place& place, Struct& out, const NamedThings& named = {});

// Reads one field.
template <class Struct, class Member>
void read_field(const json& object, const Place& place, const schema::Field<Struct, Member>& field, Struct& out,
                const NamedThings& named) {
    Member& member = out.*field.member;
    if constexpr (schema::HasTable<Member>) {
        if (field.embedded()) return read_fields(object, place, member, named);
    }
    const json* found = value_of(object, place, field.key, field.presence == schema::Presence::required, schema::is_list<Member>);
    if (!found) return;
    if constexpr (std::is_same_v<Member, std::size_t>) {
        if (field.refers != schema::Refers::to_nothing) {
            const bool or_world = field.presence != schema::Presence::required;
            member = index_of(*found, place / field.key, field.refers, or_world, named);
            return;
        }
    }
    if constexpr (std::is_same_v<Member, std::optional<glm::vec3>>) {
        if (field.is_color) return read_color(*found, place / field.key, member.emplace());
    }
    read_value(*found, place / field.key, member, field.unit, named);
}

// Reads all fields of an object whose keys are known; ignores other keys.
template <schema::HasTable Struct>
void read_fields(const json& object, const Place& place, Struct& out, const NamedThings& named) {
    schema::for_each_field<Struct>([&](const auto& field) { read_field(object, place, field, out, named); });
}

template <class Value>
void read_value(const json& value, const Place& place, Value& out, const char* unit, const NamedThings& named) {
    if constexpr (schema::is_optional<Value>) {
        read_value(value, place, out.emplace(), unit, named);
    } else if constexpr (schema::is_list<Value>) {
        if (!value.is_array()) refuse(place, std::string("must be an array of ") + unit + ", is " + kind(value));
        for (std::size_t i = 0; i < value.size(); ++i) read_value(value[i], place / i, out.emplace_back(), "", named);
    } else if constexpr (schema::HasTable<Value>) {
        only(value, place, keys_of<Value>());
        read_fields(value, place, out, named);
    } else if constexpr (schema::HasWords<Value>) {
        std::string word;
        read(value, place, word);
        const Names known(schema::words<Value>.begin(), schema::words<Value>.end());
        out = static_cast<Value>(index_among(known, word, place.key ? place.key : "word", place));
    } else if constexpr (schema::HasAlternatives<Value>) {
        constexpr auto& kinds = schema::alternatives<Value>;
        const Names known(kinds.keys.begin(), kinds.keys.end());
        if (!value.is_object() || value.size() != 1)
            refuse(place, "must be an object with one key (" + listed(known) + "), such as {\"" + known.at(1) + "\": {}}; is " +
                              kind(value));
        const std::string& key = value.begin().key();
        const std::size_t index = index_among(known, key, kinds.noun, place);
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            ((i == index ? read_value(value.begin().value(), place / key.c_str(), out.template emplace<i>(), unit, named)
                         : void()),
             ...);
        }
        (std::make_index_sequence<std::variant_size_v<Value>>());
    } else {
        read(value, place, out);
    }
}

}  // namespace scree::json_reading
