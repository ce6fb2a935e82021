// The common subset of GLSL and C++ in which shaders/physics is written. In C++ glm provides GLSL's types; for the laws that
// compute/cpu/simd/simd_stages.cpp includes, simd_types.h beside it provides types that hold several contacts, pairs or
// bodies, one per lane.
//
// Rules (tested): literals end in f or u; no operation on two constants (GLSL compilers fold them in double precision);
// no `/`, sqrt, dot, normalize, mix, fma, min, max on floats (use arithmetic.h); a vec3 member is followed by a scalar;
// no arrays of vec3; quaternions are vec4 (x, y, z, w); no swizzles; functions take values and return values.
//
// In those laws a float, uint or bool may therefore hold one value per lane, and all lanes take the same path. Code
// selects with choose(condition, a, b), and branches only on none(condition), to skip what no lane needs. An int is the
// same in all lanes, but as a coordinate of an ivec3. What has other branches is between #ifndef SCREE_LANES and #endif.
#ifndef SCREE_PHYSICS_DIALECT_H
#define SCREE_PHYSICS_DIALECT_H

#if defined(SCREE_LANES)
// types and functions come from the includer (simd_types.h)
#elif defined(__cplusplus)
#include <glm/glm.hpp>

namespace scree::physics {
using glm::abs;
using glm::floatBitsToUint;
using glm::floor;
using glm::ivec3;
using glm::uint;
using glm::uintBitsToFloat;
using glm::uvec4;
using glm::vec3;
using glm::vec4;
}  // namespace scree::physics

#define LAWS_BEGIN namespace scree::physics {
#define LAWS_END }
#ifdef __CUDACC__  // tests/twin
#define LAW __host__ __device__ inline
#else
#define LAW inline
#endif
#define CONSTANT inline constexpr
#else
#define LAWS_BEGIN
#define LAWS_END
#define LAW
#define CONSTANT const
#endif

#ifndef SCREE_LANES
LAWS_BEGIN
LAW bool none(bool condition) {
    return !condition;
}
LAW uint choose(bool condition, uint a, uint b) {
    return condition ? a : b;
}
LAW float choose(bool condition, float a, float b) {
    return condition ? a : b;
}
LAW vec3 choose(bool condition, vec3 a, vec3 b) {
    return condition ? a : b;
}
LAW vec4 choose(bool condition, vec4 a, vec4 b) {
    return condition ? a : b;
}
// The greatest integer that is not above x, in two's complement.
LAW int whole(float x) {
    return int(floor(x));
}
LAWS_END
#endif

#endif
