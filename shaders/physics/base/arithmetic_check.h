// The operations of the arithmetic check (compute/device/arithmetic_check.h): what the laws ask of a processor's floats, one
// operation at a time on bit patterns, with the same text on the device and on the CPU.
#ifndef SCREE_PHYSICS_ARITHMETIC_CHECK_H
#define SCREE_PHYSICS_ARITHMETIC_CHECK_H

#include "shaders/physics/base/arithmetic.h"

LAWS_BEGIN

struct ArithmeticCase {
    uint operation;  // CHECKED_...
    uint a, b, c;    // bits of floats
};

CONSTANT uint CHECKED_SUM = 0u;
CONSTANT uint CHECKED_DIFFERENCE = 1u;
CONSTANT uint CHECKED_PRODUCT = 2u;
CONSTANT uint CHECKED_MULTIPLY_ADD = 3u;  // contracted to fma on careless drivers, as are the next two
CONSTANT uint CHECKED_MULTIPLY_SUBTRACT = 4u;
CONSTANT uint CHECKED_DOT = 5u;
CONSTANT uint CHECKED_SMALLER = 6u;
CONSTANT uint CHECKED_LARGER = 7u;
CONSTANT uint CHECKED_POSITIVE = 8u;
CONSTANT uint CHECKED_COMPARISONS = 9u;
CONSTANT uint CHECKED_RECIPROCAL = 10u;
CONSTANT uint CHECKED_INVERSE_SQUARE_ROOT = 11u;
CONSTANT uint CHECKED_SQUARE_ROOT = 12u;
CONSTANT uint CHECKED_FLUSH = 13u;
CONSTANT uint CHECKED_FLOOR = 14u;
CONSTANT uint CHECKED_TO_INTEGER = 15u;  // within the range of int
CONSTANT uint CHECKED_FROM_INTEGER = 16u;
CONSTANT uint CHECKED_NEGATIVE = 17u;
CONSTANT uint CHECKED_OPERATIONS = 18u;

LAW uint comparisons_of(float x, float y) {
    return choose(x < y, 1u, 0u) | choose(x <= y, 2u, 0u) | choose(x == y, 4u, 0u) | choose(x >= y, 8u, 0u) |
           choose(x > y, 16u, 0u);
}

// The result's bits.
LAW uint checked_result(ArithmeticCase one) {
    float x = uintBitsToFloat(one.a), y = uintBitsToFloat(one.b), z = uintBitsToFloat(one.c);
    uint operation = one.operation;
    float result = x + y;
    if (operation == CHECKED_DIFFERENCE) result = x - y;
    if (operation == CHECKED_PRODUCT) result = x * y;
    if (operation == CHECKED_MULTIPLY_ADD) result = x * y + z;
    if (operation == CHECKED_MULTIPLY_SUBTRACT) result = z - x * y;
    if (operation == CHECKED_DOT) result = dot3(vec3(x, y, z), vec3(y, z, x));
    if (operation == CHECKED_SMALLER) result = smaller(x, y);
    if (operation == CHECKED_LARGER) result = larger(x, y);
    if (operation == CHECKED_POSITIVE) result = positive(x);
    if (operation == CHECKED_COMPARISONS) return comparisons_of(x, y);
    if (operation == CHECKED_RECIPROCAL) result = reciprocal(x);
    if (operation == CHECKED_INVERSE_SQUARE_ROOT) result = inverse_square_root(x);
    if (operation == CHECKED_SQUARE_ROOT) result = square_root(x);
    if (operation == CHECKED_FLUSH) result = flush_tiny(x);
    if (operation == CHECKED_FLOOR) result = floor(x);
    if (operation == CHECKED_TO_INTEGER) return uint(int(x));
    if (operation == CHECKED_FROM_INTEGER) result = float(int(one.a));
    if (operation == CHECKED_NEGATIVE) result = -x;
    return floatBitsToUint(result);
}

LAWS_END

#endif
