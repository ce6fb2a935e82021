// What C++20 has and libc++ before version 20 lacks, as far as scree uses it. The build includes this file before all others
// where the standard library is such a one (CMakeLists.txt); no other file knows of it.
#pragma once

#include <version>

#ifdef _LIBCPP_VERSION

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

namespace std {

#if _LIBCPP_VERSION < 14000
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}
#endif

#if _LIBCPP_VERSION < 19000
template <class T>
class atomic_ref {
public:
    static constexpr std::size_t required_alignment = alignof(T);
    explicit atomic_ref(T& value) : value_(&value) {}
    T load(std::memory_order = std::memory_order_seq_cst) const { return __atomic_load_n(value_, __ATOMIC_SEQ_CST); }
    void store(T to, std::memory_order = std::memory_order_seq_cst) const { __atomic_store_n(value_, to, __ATOMIC_SEQ_CST); }
    T exchange(T to, std::memory_order = std::memory_order_seq_cst) const {
        return __atomic_exchange_n(value_, to, __ATOMIC_SEQ_CST);
    }
    bool compare_exchange_weak(T& expected, T to, std::memory_order = std::memory_order_seq_cst) const {
        return compare_exchange_strong(expected, to);
    }
    bool compare_exchange_strong(T& expected, T to, std::memory_order = std::memory_order_seq_cst) const {
        return __atomic_compare_exchange_n(value_, &expected, to, false, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
    }
    T fetch_add(T by, std::memory_order = std::memory_order_seq_cst) const {
        return __atomic_fetch_add(value_, by, __ATOMIC_SEQ_CST);
    }
    T fetch_or(T by, std::memory_order = std::memory_order_seq_cst) const {
        return __atomic_fetch_or(value_, by, __ATOMIC_SEQ_CST);
    }
    T fetch_and(T by, std::memory_order = std::memory_order_seq_cst) const {
        return __atomic_fetch_and(value_, by, __ATOMIC_SEQ_CST);
    }
    operator T() const { return load(); }

private:
    T* value_;
};
#endif

#if _LIBCPP_VERSION < 15000
namespace ranges {

template <class Range, class Value, class Projection = std::identity>
auto find(Range&& range, const Value& value, Projection of = {}) {
    return std::find_if(std::begin(range), std::end(range), [&](auto&& item) -> bool { return std::invoke(of, item) == value; });
}
template <class Range, class Test, class Projection = std::identity>
auto find_if(Range&& range, Test test, Projection of = {}) {
    return std::find_if(std::begin(range), std::end(range),
                        [&](auto&& item) -> bool { return std::invoke(test, std::invoke(of, item)); });
}
template <class Range, class Test, class Projection = std::identity>
bool any_of(Range&& range, Test test, Projection of = {}) {
    return ranges::find_if(range, test, of) != std::end(range);
}
template <class Range, class Test, class Projection = std::identity>
bool none_of(Range&& range, Test test, Projection of = {}) {
    return !ranges::any_of(range, test, of);
}
template <class Range, class Value>
auto count(Range&& range, const Value& value) {
    return std::count(std::begin(range), std::end(range), value);
}
template <class Range, class Test, class Projection = std::identity>
auto count_if(Range&& range, Test test, Projection of = {}) {
    return std::count_if(std::begin(range), std::end(range),
                         [&](auto&& item) -> bool { return std::invoke(test, std::invoke(of, item)); });
}
template <class Range, class Value>
void fill(Range&& range, const Value& value) {
    std::fill(std::begin(range), std::end(range), value);
}
template <class Range, class Act>
void for_each(Range&& range, Act act) {
    std::for_each(std::begin(range), std::end(range), act);
}
template <class Range, class To, class Act>
void transform(Range&& range, To to, Act act) {
    std::transform(std::begin(range), std::end(range), to, [&](auto&& item) -> decltype(auto) { return std::invoke(act, item); });
}
template <class Range, class Middle>
void nth_element(Range&& range, Middle middle) {
    std::nth_element(std::begin(range), middle, std::end(range));
}
template <class Range, class Value, class Less = std::less<>, class Projection = std::identity>
auto upper_bound(Range&& range, const Value& value, Less less = {}, Projection of = {}) {
    return std::upper_bound(std::begin(range), std::end(range), value,
                            [&](const auto& a, const auto& b) -> bool { return std::invoke(less, a, std::invoke(of, b)); });
}

}  // namespace ranges
#endif

#if _LIBCPP_VERSION < 14000
// The fewest digits that read as the value, in the shorter of the two notations.
template <class Number, class = enable_if_t<is_floating_point_v<Number>>>
to_chars_result to_chars(char* first, char* last, Number value) {
    char text[400];
    int length = 0;
    if (!std::isfinite(value)) {
        length = std::snprintf(text, sizeof text, "%s%s", std::signbit(value) ? "-" : "", std::isnan(value) ? "nan" : "inf");
    } else {
        int digits = 0;
        for (bool same = false; !same; ++digits) {
            length = std::snprintf(text, sizeof text, "%.*e", digits, static_cast<double>(value));
            same = (is_same_v<Number, float> ? static_cast<Number>(std::strtof(text, nullptr))
                                             : static_cast<Number>(std::strtod(text, nullptr))) == value;
        }
        const int exponent = std::atoi(std::strchr(text, 'e') + 1);
        char fixed[400];
        const int fixed_length =
            std::snprintf(fixed, sizeof fixed, "%.*f", std::max(0, digits - 1 - exponent), static_cast<double>(value));
        if (fixed_length <= length) {
            length = fixed_length;
            std::memcpy(text, fixed, static_cast<size_t>(length));
        }
    }
    if (last - first < length) return {last, errc::value_too_large};
    std::memcpy(first, text, static_cast<size_t>(length));
    return {first + length, errc{}};
}
#endif

#if _LIBCPP_VERSION < 20000
template <class Number, class = enable_if_t<is_floating_point_v<Number>>>
from_chars_result from_chars(const char* first, const char* last, Number& value) {
    const string text(first, last);
    const size_t sign = text.starts_with('-');
    const bool is_hexadecimal = text.size() > sign + 1 && text[sign] == '0' && (text[sign + 1] | 32) == 'x';
    if (text.size() <= sign || !(isdigit(static_cast<unsigned char>(text[sign])) || strchr(".iInN", text[sign])))
        return {first, errc::invalid_argument};
    char* end = nullptr;
    Number read{};
    const string number = is_hexadecimal ? text.substr(0, sign + 1) : text;  // of which the zero alone is one
    if constexpr (is_same_v<Number, float>)
        read = std::strtof(number.c_str(), &end);
    else
        read = std::strtod(number.c_str(), &end);
    const ptrdiff_t length = end - number.c_str();
    if (length == 0) return {first, errc::invalid_argument};
    const string_view used(number.data(), static_cast<size_t>(length));
    const bool is_word = std::isinf(read) && used.find_first_of("iI") != used.npos;
    const bool is_nothing = read == 0 && used.substr(0, used.find_first_of("eE")).find_first_of("123456789") != used.npos;
    if ((std::isinf(read) && !is_word) || is_nothing) return {first + length, errc::result_out_of_range};
    value = read;
    return {first + length, errc{}};
}
#endif

#if _LIBCPP_VERSION < 20000
class jthread : public thread {
public:
    using thread::thread;
    jthread(jthread&&) = default;
    jthread& operator=(jthread&&) = default;
    ~jthread() {
        if (joinable()) join();
    }
};
#endif

}  // namespace std

#endif
