// Numbers of crate files by their types.
#include "compute/scene_file/import/usd/crate_types.h"

#include <cmath>

namespace scree::imports::crate {

namespace {

double half_of(std::uint16_t bits) {
    const int power = (bits >> 10) & 31;
    const double fraction = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
    if (power == 0) return sign * std::ldexp(fraction, -24);
    if (power == 31) return fraction == 0 ? sign * HUGE_VAL : std::nan("");
    return sign * std::ldexp(1024 + fraction, power - 25);
}

}  // namespace

Layout layout_of(unsigned type) {
    if (type >= boolean && type <= real) return {static_cast<Type>(type), 1};
    if (type == matrix2) return {real, 4};
    if (type == matrix3) return {real, 9};
    if (type == matrix4) return {real, 16};
    if (type == quatd) return {real, 4};
    if (type == quatf) return {single, 4};
    if (type == quath) return {half, 4};
    if (type >= vec2d && type <= vec4i) {
        static constexpr Type parts[] = {real, single, half, int32};
        return {parts[(type - vec2d) % 4], 2 + (type - vec2d) / 4};
    }
    if (type == time_code) return {real, 1};
    return {};
}

double number_at(CrateCursor& from, Type part) {
    if (part == boolean || part == byte) return from.read<std::uint8_t>();
    if (part == int32) return from.read<std::int32_t>();
    if (part == uint32) return from.read<std::uint32_t>();
    if (part == int64) return static_cast<double>(from.read<std::int64_t>());
    if (part == uint64) return static_cast<double>(from.read<std::uint64_t>());
    if (part == half) return half_of(from.read<std::uint16_t>());
    if (part == single) return static_cast<double>(from.read<float>());
    return from.read<double>();
}

std::size_t bytes_of(Type part) {
    if (part == boolean || part == byte) return 1;
    if (part == half) return 2;
    return part == int32 || part == uint32 || part == single ? 4 : 8;
}

}  // namespace scree::imports::crate
