// SPIR-V parsing and rewriting for bit-exact floats: inexact instructions, NoContraction, float controls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree::host {

// A malformed SPIR-V module.
struct SpirvError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct SpirvInstruction {
    std::uint16_t opcode = 0;
    std::size_t at = 0;                    // index of the first word in the module
    std::span<const std::uint32_t> words;  // words[0] holds word count and opcode
};

// The instructions in order, as spans into `words`. Throws SpirvError.
std::vector<SpirvInstruction> spirv_instructions(std::span<const std::uint32_t> words);

// The opcode's name, such as "OpFDiv"; "Op" and its number if unknown here.
std::string spirv_name(std::uint16_t opcode);

// Whether NoContraction applies to the opcode.
bool is_float_arithmetic(std::uint16_t opcode);

// Instructions whose result Vulkan does not define exactly, one line each: "OpFDiv at laws.h:20" (the source line if
// the module has debug lines). Exact are + - * and negation, comparisons, absolute value, floor, ceiling, truncation,
// integer operations.
std::vector<std::string> inexact_instructions(std::span<const std::uint32_t> words);

// Adds NoContraction to every float arithmetic instruction, so that no compiler fuses multiply and add.
std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> words);

// Strips source text and line numbers.
std::vector<std::uint32_t> without_lines(std::span<const std::uint32_t> words);

// Execution modes for 32-bit floats (SPV_KHR_float_controls).
struct FloatControls {
    bool preserve_denormals = false;  // DenormPreserve: no flushing of operands or results
    bool preserve_specials = false;   // SignedZeroInfNanPreserve
    bool round_to_nearest = false;    // RoundingModeRTE
};
// Adds the execution modes to every entry point.
std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> words, FloatControls controls);

}  // namespace scree::host
