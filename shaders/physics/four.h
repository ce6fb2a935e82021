// Four floats or uints at once: in C++ a register of the processor, which g++ does not make of a vec4 by itself; in GLSL a vec4
// or uvec4. What is done to them is done to each by itself, with the same bits.
#ifndef SCREE_PHYSICS_FOUR_H
#define SCREE_PHYSICS_FOUR_H

#include "shaders/physics/arithmetic.h"

#ifdef __cplusplus
#include <bit>

namespace scree::physics {

using Floats4 = float __attribute__((vector_size(16)));
using Uints4 = uint __attribute__((vector_size(16)));

inline Floats4 floats_in(uvec4 record) {
    return std::bit_cast<Floats4>(record);
}
inline Floats4 four_floats(float x) {
    return Floats4{x, x, x, x};
}
inline Uints4 four_uints(uint x) {
    return Uints4{x, x, x, x};
}
inline Floats4 larger4(Floats4 a, Floats4 b) {
    return a > b ? a : b;
}
// x where a > b, else y.
inline Uints4 where_larger(Floats4 a, Floats4 b, Uints4 x, Uints4 y) {
    return a > b ? x : y;
}
inline float one_of(Floats4 four, uint k) {
    return four[k];
}
inline uint one_of(Uints4 four, uint k) {
    return four[k];
}

}  // namespace scree::physics
#else
#define Floats4 vec4
#define Uints4 uvec4
Floats4 floats_in(uvec4 record) {
    return uintBitsToFloat(record);
}
Floats4 four_floats(float x) {
    return vec4(x);
}
Uints4 four_uints(uint x) {
    return uvec4(x);
}
Floats4 larger4(Floats4 a, Floats4 b) {
    return vec4(larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z), larger(a.w, b.w));
}
Uints4 where_larger(Floats4 a, Floats4 b, Uints4 x, Uints4 y) {
    return uvec4(choose(a.x > b.x, x.x, y.x), choose(a.y > b.y, x.y, y.y), choose(a.z > b.z, x.z, y.z),
                 choose(a.w > b.w, x.w, y.w));
}
float one_of(Floats4 four, uint k) {
    return k == 0u ? four.x : (k == 1u ? four.y : (k == 2u ? four.z : four.w));
}
uint one_of(Uints4 four, uint k) {
    return k == 0u ? four.x : (k == 1u ? four.y : (k == 2u ? four.z : four.w));
}
#endif

LAWS_BEGIN

LAW float largest_of(Floats4 v) {
    return larger(larger(one_of(v, 0u), one_of(v, 1u)), larger(one_of(v, 2u), one_of(v, 3u)));
}

LAWS_END

#endif
