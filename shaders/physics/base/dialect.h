// The common subset of GLSL and C++ in which shaders/physics is written: glm gives C++ the words of GLSL, and for the laws of the
// solver (contact_solver.h and what it includes) compute/cpu/simd/simd_types.h gives it words that mean several contacts at once.
//
// Rules (a test holds them): literals end in f or u; no two constants meet (GLSL compilers reckon with them in double precision);
// no `/`, sqrt, dot, normalize, mix, fma, min, max on floats (arithmetic.h has ours); a vec3 member is followed by a scalar; no
// arrays of vec3; quaternions are vec4 (x, y, z, w); no swizzles; functions take values and return values.
//
// In the laws of the solver a float, uint or bool may so be one of each of several contacts, which go the same way through the
// text. So they say choose(condition, a, b) for what some contacts take and others do not, and branch on none(condition) alone,
// where a part of the text is for no contact; an int is the same for all of them.
#ifndef SCREE_PHYSICS_DIALECT_H
#define SCREE_PHYSICS_DIALECT_H

#if defined(SCREE_LANES)
// the includer has said what the words mean
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
#define LAW inline
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
LAWS_END
#endif

#endif
