// Sums that no order changes: terms of at most 1 in size, as multiples of 2^-88 in 128 bits.
#pragma once

#include <cmath>

namespace scree {

// Of up to 2^38 terms. What is below 2^-88 of a term is cut off: 3e-27 of the largest that is allowed.
class FixedSum {
public:
    void add(double term) { sum_ += static_cast<Wide>(term * 0x1p88); }
    double value() const { return static_cast<double>(sum_) * 0x1p-88; }

private:
    __extension__ using Wide = __int128;
    Wide sum_ = 0;
};

// The least power of two that is not below a size; of 0 it is 1.
inline double power_above(double size) {
    if (!(size > 0)) return 1;
    int exponent = 0;
    std::frexp(size, &exponent);
    return std::ldexp(1.0, exponent);
}

}  // namespace scree
