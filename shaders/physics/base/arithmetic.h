// Bit-exact arithmetic on every processor: only + - *, comparisons and integer operations.
//
// Vulkan rounds + - * correctly, but allows 2.5 ULP for division and 2 ULP for the inverse square root; both are built
// here from an integer seed and three Newton steps (relative error 1.5e-7, measured against double over the whole
// range).
#ifndef SCREE_PHYSICS_ARITHMETIC_H
#define SCREE_PHYSICS_ARITHMETIC_H

#include "shaders/physics/base/dialect.h"

// No literal zeros in sums and products: Mesa folds a * 0.0 and a + 0.0, which loses the sign of a zero, NoContraction
// or not. A sum begins with its first term, and a value is made non-negative by a select that never yields -0.

LAWS_BEGIN

// 1/x for 2^-125 < |x| < 2^125. Below, the result grows to infinity: callers exclude 0.
LAW float reciprocal(float x) {
    float y = uintBitsToFloat(0x7EF311C7u - floatBitsToUint(x));
    y = y * (2.0f - x * y);
    y = y * (2.0f - x * y);
    y = y * (2.0f - x * y);
    return y;
}

// 1/sqrt(x) for 2^-125 < x < 2^125.
LAW float inverse_square_root(float x) {
    float half_x = 0.5f * x;
    float y = uintBitsToFloat(0x5F375A86u - (floatBitsToUint(x) >> 1));
    y = y * (1.5f - half_x * y * y);
    y = y * (1.5f - half_x * y * y);
    y = y * (1.5f - half_x * y * y);
    return y;
}

// sqrt(x); 0 below 1e-30, where the squares of lengths and speeds (m, m/s) have vanished.
LAW float square_root(float x) {
    return choose(x > 1.0e-30f, x * inverse_square_root(x), 0.0f);
}

// Explicit selects: min and max differ between processors for NaN and -0.
LAW float smaller(float a, float b) {
    return choose(a < b, a, b);
}
LAW float larger(float a, float b) {
    return choose(a > b, a, b);
}
LAW float clamped(float x, float low, float high) {
    return choose(x < low, low, choose(x > high, high, x));
}
// max(x, +0), never -0.
LAW float positive(float x) {
    return choose(x > 0.0f, x, 0.0f);
}
LAW vec3 smaller3(vec3 a, vec3 b) {
    return vec3(smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z));
}
LAW vec3 larger3(vec3 a, vec3 b) {
    return vec3(larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z));
}

// Sums are written out, so their order is the same everywhere.
LAW float dot3(vec3 a, vec3 b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
LAW vec3 cross3(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
LAW vec3 absolute3(vec3 a) {
    return vec3(abs(a.x), abs(a.y), abs(a.z));
}
LAW float length3(vec3 a) {
    return square_root(dot3(a, a));
}

// a / |a|, or `otherwise` (a unit vector) when |a| < 1e-12.
LAW vec3 unit3(vec3 a, vec3 otherwise) {
    float squared = dot3(a, a);
    return choose(squared > 1.0e-24f, a * inverse_square_root(squared), otherwise);
}

// A unit vector perpendicular to the unit vector n, continuous but for n.z = 0 (Duff et al., Building an Orthonormal
// Basis, Revisited, JCGT 2017). The second tangent is cross3(n, tangent(n)).
LAW vec3 tangent(vec3 n) {
    float s = choose(n.z < 0.0f, -1.0f, 1.0f);
    float a = -reciprocal(s + n.z);
    return vec3(1.0f + s * n.x * n.x * a, s * (n.x * n.y * a), -s * n.x);
}

// v, scaled down to the length `longest` if it is longer.
LAW vec3 shortened(vec3 v, float longest) {
    float squared = dot3(v, v);
    return choose(squared > longest * longest, v * (longest * inverse_square_root(squared)), v);
}
// The least square of the distance of a point from the origin while it moves from `start` by `way`.
LAW float nearest_squared(vec3 start, vec3 way) {
    float part = clamped(-dot3(start, way) * reciprocal(larger(dot3(way, way), 1.0e-20f)), 0.0f, 1.0f);
    vec3 nearest = start + way * part;
    return dot3(nearest, nearest);
}
LAW vec3 xyz(vec4 v) {
    return vec3(v.x, v.y, v.z);
}

// v rotated by the unit quaternion q: v + 2w (q x v) + 2 q x (q x v).
LAW vec3 rotate(vec4 q, vec3 v) {
    vec3 u = vec3(q.x, q.y, q.z);
    vec3 t = cross3(u, v) * 2.0f;
    return v + t * q.w + cross3(u, t);
}
// The body's y axis in world axes, written out because products with a literal zero differ between devices (above).
LAW vec3 upright(vec4 q) {
    return vec3(2.0f * (q.x * q.y - q.w * q.z), 1.0f - 2.0f * (q.x * q.x + q.z * q.z), 2.0f * (q.y * q.z + q.w * q.x));
}
LAW vec4 conjugate(vec4 q) {
    return vec4(-q.x, -q.y, -q.z, q.w);
}
LAW vec3 rotate_back(vec4 q, vec3 v) {
    return rotate(conjugate(q), v);
}
// Quaternion product q p: the rotation q after p.
LAW vec4 compose(vec4 q, vec4 p) {
    return vec4(q.w * p.x + q.x * p.w + q.y * p.z - q.z * p.y, q.w * p.y - q.x * p.z + q.y * p.w + q.z * p.x,
                q.w * p.z + q.x * p.y - q.y * p.x + q.z * p.w, q.w * p.w - q.x * p.x - q.y * p.y - q.z * p.z);
}
// Flushes what is below 1e-18 to zero: denormals cost a hundredfold on some processors and vanish on others
// (shaderDenormPreserveFloat32). A value that lasts beyond a pass, or whose square decides something, is flushed: then
// squares are zero or normal, and a denormal intermediate is lost in rounding before it is stored.
LAW float flush_tiny(float x) {
    return choose(abs(x) < 1.0e-18f, 0.0f, x);
}
LAW vec3 flush_tiny(vec3 v) {
    return vec3(flush_tiny(v.x), flush_tiny(v.y), flush_tiny(v.z));
}
LAW vec4 flush_tiny(vec4 v) {
    return vec4(flush_tiny(v.x), flush_tiny(v.y), flush_tiny(v.z), flush_tiny(v.w));
}
// For inverse masses and inertias, which are small for bodies of a kilometre.
LAW float flush_least(float x) {
    return choose(abs(x) < 1.0e-30f, 0.0f, x);
}

LAW vec4 unit_quaternion(vec4 q) {
    float squared = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    return flush_tiny(q * inverse_square_root(squared));
}

// The columns of the rotation matrix of q: the body's axes in world axes.
struct Axes {
    vec3 x;
    vec3 y;
    vec3 z;
};
LAW Axes axes_of(vec4 q) {
    float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    float xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    float wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    Axes axes;
    axes.x = vec3(1.0f - 2.0f * (yy + zz), 2.0f * (xy + wz), 2.0f * (xz - wy));
    axes.y = vec3(2.0f * (xy - wz), 1.0f - 2.0f * (xx + zz), 2.0f * (yz + wx));
    axes.z = vec3(2.0f * (xz + wy), 2.0f * (yz - wx), 1.0f - 2.0f * (xx + yy));
    return axes;
}

LAWS_END

#endif
