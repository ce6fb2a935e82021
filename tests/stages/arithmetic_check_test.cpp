// The arithmetic check of devices: lavapipe is exact, and processors that are not are found out.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "compute/device/arithmetic_check.h"
#include "tests/stages/watched_device.h"

using namespace scree;
using physics::ArithmeticCase;

namespace {

// The report on a processor that differs from this one where `otherwise` says so.
template <class Otherwise>
ArithmeticReport report_on(const Otherwise& otherwise) {
    const std::vector<ArithmeticCase> cases = arithmetic_cases();
    std::vector<std::uint32_t> results;
    for (const ArithmeticCase& one : cases) results.push_back(otherwise(one, physics::checked_result(one)));
    return judge_arithmetic(cases, results);
}
float of(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}
std::uint32_t bits(float x) {
    return std::bit_cast<std::uint32_t>(x);
}

}  // namespace

TEST_CASE("a device under test computes with the bits of the CPU") {
    const Watched watched;
    const ArithmeticReport report = check_arithmetic(watched.device);
    CHECK(report.fault == "");
}

TEST_CASE("this processor passes its own check, and every operation is checked by hundreds of cases") {
    CHECK(report_on([](const ArithmeticCase&, std::uint32_t result) { return result; }).is_exact());
    const std::vector<ArithmeticCase> cases = arithmetic_cases();
    for (std::uint32_t operation = 0; operation < physics::CHECKED_OPERATIONS; ++operation)
        CHECK(std::count_if(cases.begin(), cases.end(), [&](const ArithmeticCase& one) { return one.operation == operation; }) >
              500);
}

TEST_CASE("a processor that contracts, rounds, selects or converts otherwise is not exact, and the check says where") {
    const auto fused = [](const ArithmeticCase& one, std::uint32_t result) {
        return one.operation == physics::CHECKED_MULTIPLY_ADD ? bits(std::fma(of(one.a), of(one.b), of(one.c))) : result;
    };
    CHECK_THAT(report_on(fused).fault, Catch::StartsWith("a * b + c gives "));
    const auto truncated = [](const ArithmeticCase& one, std::uint32_t result) {
        const double exact = double{of(one.a)} * of(one.b);
        if (one.operation != physics::CHECKED_PRODUCT || std::abs(of(result)) <= std::abs(exact)) return result;
        return bits(std::nextafter(of(result), 0.0f));
    };
    CHECK_THAT(report_on(truncated).fault, Catch::StartsWith("a * b gives "));
    const auto by_minimum = [](const ArithmeticCase& one, std::uint32_t result) {  // min(-0, 0) is -0 to some
        return one.operation == physics::CHECKED_SMALLER && of(one.a) == 0 && of(one.b) == 0 ? 0x80000000u : result;
    };
    CHECK_THAT(report_on(by_minimum).fault, Catch::StartsWith("smaller(a, b) gives "));
    const auto to_nearest = [](const ArithmeticCase& one, std::uint32_t result) {
        return one.operation == physics::CHECKED_TO_INTEGER ? static_cast<std::uint32_t>(std::llrint(of(one.a))) : result;
    };
    CHECK_THAT(report_on(to_nearest).fault, Catch::StartsWith("int(a) gives "));
    const auto approximate = [](const ArithmeticCase& one, std::uint32_t result) {
        return one.operation == physics::CHECKED_RECIPROCAL && std::isnormal(of(one.a)) ? bits(1.0f / of(one.a)) : result;
    };
    CHECK_THAT(report_on(approximate).fault, Catch::StartsWith("reciprocal(a) gives "));
}

TEST_CASE("devices may keep denormals or flush them, and the check tells which they do") {
    const auto itself = [](const ArithmeticCase&, std::uint32_t result) { return result; };
    CHECK(report_on(itself).denormals == Denormals::kept);
    const auto flushes_results = [](const ArithmeticCase& one, std::uint32_t result) {
        const bool is_tiny = result != 0 && std::abs(of(result)) < std::numeric_limits<float>::min();
        return is_tiny && one.operation < physics::CHECKED_COMPARISONS ? result & 0x80000000u : result;
    };
    const ArithmeticReport report = report_on(flushes_results);
    CHECK(report.is_exact());
    CHECK(report.denormals != Denormals::kept);
}
