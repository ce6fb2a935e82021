// Validation by the field table: numbers finite and in range, quaternions normalised.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "compute/schema/field.h"
#include "compute/schema/range_text.h"

namespace scree::schema {

// Kind of axis of a field, which selects between the two units of "m or rad".
enum class Direction { either, along, about };

constexpr std::string_view unit_of(std::string_view unit, Direction direction) {
    const std::size_t both = unit.find(" or ");
    if (direction == Direction::either || both == unit.npos) return unit;
    return direction == Direction::along ? unit.substr(0, both) : unit.substr(both + 4);
}
constexpr Direction direction_within(std::string_view unit, Direction outside) {
    return unit == "m" ? Direction::along : unit == "rad" ? Direction::about : outside;
}

template <class Type>
inline constexpr bool is_optional = false;
template <class Type>
inline constexpr bool is_optional<std::optional<Type>> = true;
template <class Type>
inline constexpr bool is_list = false;
template <class Type>
inline constexpr bool is_list<std::vector<Type>> = true;
template <class Type>
concept Number = std::is_same_v<Type, float> ||(std::is_integral_v<Type> && !std::is_same_v<Type, bool>);

// No rules beyond the table.
struct NoRules {
    template <class... Anything>
    void operator()(const Anything&...) const {}
};

// Normalises in double precision. Vectors of unit length, to rounding, stay: checking twice changes no bit.
template <class At, class Vector>
void make_unit(const At& at, Vector& v, const char* meaning) {
    double squared = 0;
    for (int i = 0; i < Vector::length(); ++i) {
        if (!std::isfinite(v[i])) refuse(at / static_cast<std::size_t>(i), "must be finite, is " + text_of(v[i]));
        squared += static_cast<double>(v[i]) * v[i];
    }
    if (squared < 1e-12) refuse(at, std::string("must not be of length 0: ") + meaning);
    if (std::abs(squared - 1) <= 2.5e-7) return;
    for (int i = 0; i < Vector::length(); ++i) v[i] = static_cast<float>(v[i] / std::sqrt(squared));
}

template <class At, class Struct, class Rules = NoRules>
void check_fields(const At& at, Struct& checked, const Rules& rules = {}, Direction direction = Direction::either);

// Checks one field. `at`: the place of the struct, with `at / key`, `at / index` and refuse(at, reason).
template <class At, class Struct, class Owner, class Member, class Rules = NoRules>
void check_field(const At& at, Struct& checked, const Field<Owner, Member>& field, const Rules& rules = {},
                 Direction direction = Direction::either) {
    auto& value = checked.*field.member;
    const std::string_view unit = unit_of(field.unit, direction);
    const Direction within = direction_within(field.unit, direction);
    const auto check_number = [&](auto number) {
        if (!field.range.holds(number)) refuse(at / field.key, out_of_range(number, field.range, unit));
    };
    if constexpr (Number<Member>) {
        if (value != Owner{}.*field.member) check_number(value);
    } else if constexpr (std::is_same_v<Member, glm::vec2> || std::is_same_v<Member, glm::vec3>) {
        if (field.by_length) {
            double squared = 0;
            for (int i = 0; i < Member::length(); ++i) squared += static_cast<double>(value[i]) * value[i];
            const double length = std::sqrt(squared);
            if (!(length <= field.range.high * (1 + 1e-6)))  // rounded where it was turned
                refuse(at / field.key, "must be at most " + plain(field.range.high) + ' ' + std::string(unit) + " long, is " +
                                           text_of(static_cast<float>(length)));
            return;
        }
        for (int i = 0; i < Member::length(); ++i)
            if (!field.range.holds(value[i]))
                refuse(at / field.key / static_cast<std::size_t>(i), out_of_range(value[i], field.range, unit));
    } else if constexpr (std::is_same_v<Member, glm::vec4>) {
        make_unit(at / field.key, value, "a quaternion x, y, z, w; no turn is [0, 0, 0, 1]");
    } else if constexpr (is_optional<Member>) {
        if constexpr (Number<typename Member::value_type>) {
            if (value) check_number(*value);
        } else if constexpr (std::is_same_v<typename Member::value_type, glm::vec3>) {
            for (int i = 0; value && i < 3; ++i)
                if (!field.range.holds((*value)[i]))
                    refuse(at / field.key / static_cast<std::size_t>(i), out_of_range((*value)[i], field.range, unit));
        } else if constexpr (HasTable<typename Member::value_type>) {
            if (value) check_fields(at / field.key, *value, rules, within);
        }
    } else if constexpr (is_list<Member>) {
        if (!value.empty() || field.presence == Presence::required) {
            if (!field.range.holds(value.size()) && field.range.low > 0)
                refuse(at / field.key,
                       "must be " +
                           (field.range.high < no_limit ? plain(field.range.low) + " to " + plain(field.range.high)
                                                        : "at least " + plain(field.range.low)) +
                           " " + field.unit + ", not " + std::to_string(value.size()));
        }
        if constexpr (HasTable<typename Member::value_type>) {
            const auto list = at / field.key;
            for (std::size_t i = 0; i < value.size(); ++i) check_fields(list / i, value[i], rules, within);
        }
    } else if constexpr (HasAlternatives<Member>) {
        const auto kind = at / field.key;
        std::visit([&](auto& one) { check_fields(kind / alternatives<Member>.keys[value.index()], one, rules, within); }, value);
    } else if constexpr (HasTable<Member>) {
        if (field.embedded())
            check_fields(at, value, rules, within);
        else
            check_fields(at / field.key, value, rules, within);
    }
}

// Checks all fields of a struct, then its rules beyond ranges.
template <class At, class Struct, class Rules>
void check_fields(const At& at, Struct& checked, const Rules& rules, Direction direction) {
    for_each_field<Struct>([&](const auto& field) { check_field(at, checked, field, rules, direction); });
    rules(at, checked, direction);
}

}  // namespace scree::schema
