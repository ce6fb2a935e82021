// The common subset of GLSL and C++ in which shaders/physics is written: glm gives C++ the words of GLSL.
//
// Rules (a test holds them): literals end in f or u; no two constants meet (GLSL compilers reckon with them in double precision);
// no `/`, sqrt, dot, normalize, mix, fma, min, max on floats (arithmetic.h has ours); a vec3 member is followed by a scalar; no
// arrays of vec3; quaternions are vec4 (x, y, z, w); no swizzles; functions take values and return values.
#ifndef SCREE_PHYSICS_LANGUAGE_H
#define SCREE_PHYSICS_LANGUAGE_H

#ifdef __cplusplus
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

#endif
