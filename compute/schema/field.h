// Field tables: key, range, unit and meaning of each member of a struct. JSON reading and writing, the JSON Schema,
// validation and the ranges of command line options follow from them. A new scalar property needs its member with a
// default and one line in a table.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>

namespace scree::schema {

constexpr double largest = std::numeric_limits<float>::max();
constexpr double no_limit = std::numeric_limits<double>::infinity();

// Range of a number, of each component of a vector, or of the size of a list. By default any finite number. A member's
// default is always allowed, even outside: 0 for "none", say.
struct Range {
    double low = -largest, high = largest;
    bool above_low = false, below_high = false;  // exclusive limits

    template <class Number>
    constexpr bool holds(Number value) const {
        // Compared as float with the limit rounded to float: 0.9f is below 0.9.
        using Limit = std::conditional_t<std::is_same_v<Number, float>, float, double>;
        const auto v = static_cast<Limit>(value), least = static_cast<Limit>(low), most = static_cast<Limit>(high);
        return (above_low ? v > least : v >= least) && (below_high ? v < most : v <= most);
    }
};
constexpr Range between(double low, double high) {
    return {low, high};
}
constexpr Range within(double of_zero) {
    return {-of_zero, of_zero};
}
constexpr Range at_least(double low) {
    return {low, no_limit};
}
constexpr Range above(double low, double high = largest) {
    return {low, high, true};
}
constexpr Range from_to_below(double low, double high) {
    return {low, high, false, true};
}

enum class Presence {
    optional,  // omitted when it has its default
    written,   // may be omitted in a file; always written
    required,  // required in a file; always written
};

// What a std::size_t index refers to; scene files may use the name instead.
enum class Refers { to_nothing, to_body, to_joint };

template <class Struct, class Member>
struct Field {
    const char* key;  // "": an embedded struct, whose keys are among those of this one
    Member Struct::*member;
    Range range{};
    const char* unit = "";  // of a list the noun for its elements. "m or rad": along or about an axis
    const char* about = "";
    Presence presence = Presence::optional;
    Refers refers = Refers::to_nothing;
    bool by_length = false;  // of a vector that validation turns: the range is that of its length, not of its components
    bool is_color = false;   // in sRGB; scene files may say "#rrggbb" or "#rgb" instead

    constexpr bool embedded() const { return *key == '\0'; }
    constexpr Field required() const { return with(Presence::required); }
    constexpr Field written() const { return with(Presence::written); }
    constexpr Field of_length() const {
        Field field = *this;
        field.by_length = true;
        return field;
    }
    constexpr Field of_color() const {
        Field field = *this;
        field.is_color = true;
        return field;
    }
    constexpr Field index_of(Refers what) const {
        Field field = *this;
        field.refers = what;
        return field;
    }

private:
    constexpr Field with(Presence now) const {
        Field field = *this;
        field.presence = now;
        return field;
    }
};

template <class Struct, class Member>
constexpr Field<Struct, Member> field(const char* key, Member Struct::*member, const char* about = "") {
    return {key, member, {}, "", about};
}
template <class Struct, class Member>
constexpr Field<Struct, Member> field(const char* key, Member Struct::*member, Range range, const char* unit, const char* about) {
    return {key, member, range, unit, about};
}

template <class... Fields>
struct Table {
    const char* name;  // in the schema's $defs
    const char* about;
    std::tuple<Fields...> fields;
};
template <class... Fields>
constexpr Table<Fields...> table_of(const char* name, const char* about, Fields... fields) {
    return {name, about, {fields...}};
}

// Specialised for each struct with fields, each enum (its words), and each variant (keys of its alternatives).
template <class Struct>
inline constexpr std::nullptr_t table = nullptr;
template <class Enum>
inline constexpr std::nullptr_t words = nullptr;
template <class Variant>
inline constexpr std::nullptr_t alternatives = nullptr;

template <std::size_t count>
struct Alternatives {
    const char* name;  // in the schema's $defs
    const char* noun;  // for messages
    std::array<const char*, count> keys;
};

template <class Type>
concept HasTable = !std::is_null_pointer_v<std::remove_cvref_t<decltype(table<std::remove_cv_t<Type>>)>>;
template <class Type>
concept HasWords = !std::is_null_pointer_v<std::remove_cvref_t<decltype(words<std::remove_cv_t<Type>>)>>;
template <class Type>
concept HasAlternatives = !std::is_null_pointer_v<std::remove_cvref_t<decltype(alternatives<std::remove_cv_t<Type>>)>>;

// Calls `visit` with each field of a struct.
template <HasTable Struct, class Visit>
constexpr void for_each_field(const Visit& visit) {
    std::apply([&](const auto&... each) { (visit(each), ...); }, table<std::remove_cv_t<Struct>>.fields);
}

// The field of a member.
template <class Struct, class Member>
constexpr Field<Struct, Member> field_of(Member Struct::*member) {
    Field<Struct, Member> found{};
    for_each_field<Struct>([&](const auto& one) {
        if constexpr (std::is_same_v<decltype(one.member), Member Struct::*>) {
            if (one.member == member) found = one;
        }
    });
    return found;
}

}  // namespace scree::schema
