// The check of a device's arithmetic: whether + - *, comparisons, selects and conversions give the bits that the laws count
// on (shaders/physics/base/arithmetic.h). Drivers may contract a * b + c, round or order otherwise than they say; such a
// device simulates, but its state hashes are no one else's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shaders/physics/base/arithmetic_check.h"

namespace scree {

namespace host {
class Device;
}

enum class Denormals {
    kept,     // IEEE 754
    flushed,  // operands and results are zero instead
    mixed,    // some are; no law depends on it (demos/docs/inside/equal-bits.md)
};

struct ArithmeticReport {
    std::string fault;  // the first operation with other bits, its operands and both results; empty: exact
    Denormals denormals = Denormals::kept;
    bool is_exact() const { return fault.empty(); }
};

// Every operation on pairs of edge cases (ties, ends of ranges, signed zeros, denormals) and on 1,000 random triples.
std::vector<physics::ArithmeticCase> arithmetic_cases();
// The report on a processor that gave these results, one for each case.
ArithmeticReport judge_arithmetic(std::span<const physics::ArithmeticCase> cases, std::span<const std::uint32_t> results);

// Runs the check on a device: one dispatch. Throws host::DeviceError when the device fails to run.
ArithmeticReport check_arithmetic(const std::shared_ptr<host::Device>& device);

}  // namespace scree
