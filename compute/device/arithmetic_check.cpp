// Arithmetic check of devices: cases, judgement, and the dispatch.
#include "compute/device/arithmetic_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

#include "compute/cpu/flushed_denormals.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/pipeline.h"
#include "host/vulkan/transfer.h"
#include "shaders/embedded.h"

namespace scree {

namespace {

using physics::ArithmeticCase;

constexpr std::uint32_t threads_of_the_check = 64;  // shaders/queries/check_arithmetic.comp
constexpr std::uint32_t random_triples = 1000;

constexpr std::array<const char*, physics::CHECKED_OPERATIONS> names{"a + b",          "a - b",
                                                                     "a * b",          "a * b + c",
                                                                     "c - a * b",      "a b + b c + c a",
                                                                     "smaller(a, b)",  "larger(a, b)",
                                                                     "positive(a)",    "comparisons of a and b",
                                                                     "reciprocal(a)",  "inverse_square_root(a)",
                                                                     "square_root(a)", "flush_tiny(a)",
                                                                     "floor(a)",       "int(a)",
                                                                     "float(int a)",   "-a"};

// Zeros, ones and their neighbours, ties of rounding, ends of the normal, denormal and integer ranges.
constexpr std::array<std::uint32_t, 26> edges{0x00000000, 0x80000000, 0x3F800000, 0xBF800000, 0x3F800001, 0x3F7FFFFF, 0x33800000,
                                              0x33800001, 0xB3800000, 0x34000000, 0x34400000, 0x4B000000, 0x4B000001, 0x4B7FFFFF,
                                              0xCB000001, 0x3FC00000, 0x40490FDB, 0xC2F6E979, 0x00800000, 0x80800000, 0x007FFFFF,
                                              0x00000001, 0x80000003, 0x7F7FFFFF, 0xFF7FFFFF, 0x7E800000};

// Outside of it the conversion is undefined.
bool converts_to_integer(std::uint32_t bits) {
    return std::abs(std::bit_cast<float>(bits)) < 2147483648.0f;
}

void add_case(std::vector<ArithmeticCase>& cases, ArithmeticCase one) {
    if (one.operation != physics::CHECKED_TO_INTEGER || converts_to_integer(one.a)) cases.push_back(one);
}

// Weyl sequence with the finaliser of MurmurHash3.
std::uint32_t random_word(std::uint32_t& state) {
    std::uint32_t x = state += 0x9E3779B9u;
    x = (x ^ x >> 16) * 0x85EBCA6Bu;
    x = (x ^ x >> 13) * 0xC2B2AE35u;
    return x ^ x >> 16;
}
// Any sign and mantissa, exponents from 2^-24 to 2^23, so that sums round and cancel.
std::uint32_t random_float(std::uint32_t& state) {
    const std::uint32_t word = random_word(state);
    return (word & 0x807FFFFFu) | (103u + random_word(state) % 48u) << 23;
}

std::vector<std::uint32_t> results_of(std::span<const ArithmeticCase> cases) {
    std::vector<std::uint32_t> results(cases.size());
    std::transform(cases.begin(), cases.end(), results.begin(), physics::checked_result);
    return results;
}
std::vector<std::uint32_t> flushed_results_of(std::span<const ArithmeticCase> cases) {
    const FlushedDenormals flushed;
    return results_of(cases);
}

bool is_float(std::uint32_t operation) {
    return operation != physics::CHECKED_COMPARISONS && operation != physics::CHECKED_TO_INTEGER;
}
bool same(const ArithmeticCase& one, std::uint32_t a, std::uint32_t b) {
    return a == b || (is_float(one.operation) && std::isnan(std::bit_cast<float>(a)) && std::isnan(std::bit_cast<float>(b)));
}

bool is_denormal(std::uint32_t bits) {
    return std::fpclassify(std::bit_cast<float>(bits)) == FP_SUBNORMAL;
}
// Whether an operand, the result or something on the way to it is a denormal. Then devices may differ: where one compares
// flushed operands and selects kept ones, it does neither as the CPU.
bool meets_denormals(const ArithmeticCase& one, std::uint32_t kept, std::uint32_t flushed) {
    return is_denormal(one.a) || is_denormal(one.b) || is_denormal(one.c) || !same(one, kept, flushed) ||
           (is_float(one.operation) && is_denormal(kept));
}

std::string fault_of(const ArithmeticCase& one, std::uint32_t result, std::uint32_t expected) {
    char text[200];
    std::snprintf(text, sizeof text, "%s gives %08x instead of %08x for a = %08x, b = %08x, c = %08x", names[one.operation],
                  result, expected, one.a, one.b, one.c);
    return text;
}

}  // namespace

std::vector<ArithmeticCase> arithmetic_cases() {
    std::vector<ArithmeticCase> cases;
    for (std::uint32_t operation = 0; operation < physics::CHECKED_OPERATIONS; ++operation) {
        for (std::size_t i = 0; i < edges.size(); ++i)
            for (std::size_t k = 0; k < edges.size(); ++k)
                add_case(cases, {operation, edges[i], edges[k], edges[(i + 7 * k) % edges.size()]});
        std::uint32_t state = operation;
        for (std::uint32_t k = 0; k < random_triples; ++k) {
            const std::uint32_t a = random_float(state), b = random_float(state), c = random_float(state);
            add_case(cases, {operation, a, b, c});
        }
    }
    return cases;
}

ArithmeticReport judge_arithmetic(std::span<const ArithmeticCase> cases, std::span<const std::uint32_t> results) {
    const std::vector<std::uint32_t> kept = results_of(cases), flushed = flushed_results_of(cases);
    bool any_kept = false, any_flushed = false;
    ArithmeticReport report;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const bool as_kept = same(cases[i], results[i], kept[i]), as_flushed = same(cases[i], results[i], flushed[i]);
        if (meets_denormals(cases[i], kept[i], flushed[i])) {
            any_kept |= as_kept && !as_flushed;
            any_flushed |= !as_kept;
        } else if (!as_kept && report.fault.empty()) {
            report.fault = fault_of(cases[i], results[i], kept[i]);
        }
    }
    report.denormals = !any_flushed ? Denormals::kept : any_kept ? Denormals::mixed : Denormals::flushed;
    return report;
}

ArithmeticReport check_arithmetic(const std::shared_ptr<host::Device>& device) {
    const std::vector<ArithmeticCase> cases = arithmetic_cases();
    std::vector<std::uint32_t> results(cases.size());
    const auto count = static_cast<std::uint32_t>(cases.size());
    host::Buffer asked(device, "cases of the arithmetic check", cases.size() * sizeof(ArithmeticCase));
    const host::Buffer given(device, "results of the arithmetic check", results.size() * sizeof results[0]);
    asked.write(cases.data(), asked.bytes());
    const auto layout = std::make_shared<host::BindingSetLayout>(device, 2, sizeof count);
    const host::Pipeline pipeline(layout, "check_arithmetic", shaders::find("check_arithmetic.query"));
    const host::BindingSet bound(layout, {&asked, &given});
    host::CommandBuffer commands(device);
    commands.bind(pipeline, bound);
    commands.push(&count, sizeof count);
    commands.dispatch((count + threads_of_the_check - 1) / threads_of_the_check);
    commands.barrier();
    commands.end();
    device->submit_and_wait({commands.handle()});
    given.read(results.data(), given.bytes());
    return judge_arithmetic(cases, results);
}

}  // namespace scree
