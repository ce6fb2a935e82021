// SPIR-V modules as lists of instructions: what in them is not exact, and the decorations and modes that make them so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree::host {

// Words that are no SPIR-V module.
struct SpirvError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct SpirvInstruction {
    std::uint16_t opcode = 0;
    std::size_t at = 0;                    // index of the first word in the module
    std::span<const std::uint32_t> words;  // the first holds the opcode and the count of words
};

// The instructions in order; they refer to `words`. Throws SpirvError.
std::vector<SpirvInstruction> spirv_instructions(std::span<const std::uint32_t> words);

// "OpFDiv"; "Op" and the number for an opcode that this file has no use for.
std::string spirv_name(std::uint16_t opcode);

// Whether NoContraction applies to it: float arithmetic.
bool is_float_arithmetic(std::uint16_t opcode);

// Every instruction whose result Vulkan does not fix to the last bit, one line each: "OpFDiv at laws.h:20" (the place if the
// module has line numbers). Exact are + - * and negation, comparisons, absolute value, floor, ceiling, truncation, integer
// operations.
std::vector<std::string> inexact_instructions(std::span<const std::uint32_t> words);

// The module with NoContraction on every float arithmetic instruction.
std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> words);

// The module without source text and line numbers.
std::vector<std::uint32_t> without_lines(std::span<const std::uint32_t> words);

// What a device can be asked to promise for 32-bit floats (SPV_KHR_float_controls).
struct FloatControls {
    bool preserve_denormals = false;  // denormals are neither flushed on the way in nor as results
    bool preserve_specials = false;   // -0, infinities and NaN are what IEEE 754 says
    bool round_to_nearest = false;    // ties to even
};
// The module asking for them, in every entry point.
std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> words, FloatControls controls);

}  // namespace scree::host
