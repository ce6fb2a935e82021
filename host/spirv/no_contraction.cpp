// SPIR-V parsing and the list of inexact instructions. Opcodes are those of the SPIR-V specification 1.6 and of its
// extended instruction set GLSL.std.450.
#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <set>

#include "host/spirv/spirv.h"
#include "host/spirv/spirv_opcodes.h"

namespace scree::host {
namespace {

struct Known {
    std::uint16_t opcode;
    const char* name;
    bool arithmetic;  // NoContraction applies
    bool exact;       // correctly rounded or exact in Vulkan, given NoContraction
};
constexpr Known known[] = {
    {115, "OpFConvert", false, false},
    {116, "OpQuantizeToF16", false, false},
    {127, "OpFNegate", true, true},
    {129, "OpFAdd", true, true},
    {131, "OpFSub", true, true},
    {133, "OpFMul", true, true},
    {136, "OpFDiv", true, false},
    {140, "OpFRem", true, false},
    {141, "OpFMod", true, false},
    {142, "OpVectorTimesScalar", true, true},
    {143, "OpMatrixTimesScalar", true, false},
    {144, "OpVectorTimesMatrix", true, false},
    {145, "OpMatrixTimesVector", true, false},
    {146, "OpMatrixTimesMatrix", true, false},
    {147, "OpOuterProduct", true, true},
    {148, "OpDot", true, false},
    {207, "OpDPdx", false, false},
    {208, "OpDPdy", false, false},
    {209, "OpFwidth", false, false},
    {210, "OpDPdxFine", false, false},
    {211, "OpDPdyFine", false, false},
    {212, "OpFwidthFine", false, false},
    {213, "OpDPdxCoarse", false, false},
    {214, "OpDPdyCoarse", false, false},
    {215, "OpFwidthCoarse", false, false},
    {265, "OpGroupFAdd", false, false},
    {266, "OpGroupFMin", false, false},
    {269, "OpGroupFMax", false, false},
    {350, "OpGroupNonUniformFAdd", false, false},
    {352, "OpGroupNonUniformFMul", false, false},
    {355, "OpGroupNonUniformFMin", false, false},
    {358, "OpGroupNonUniformFMax", false, false},
    {5001, "OpGroupFAddNonUniformAMD", false, false},
    {5002, "OpGroupFMinNonUniformAMD", false, false},
    {5005, "OpGroupFMaxNonUniformAMD", false, false},
    {5614, "OpAtomicFMinEXT", false, false},
    {5615, "OpAtomicFMaxEXT", false, false},
    {6035, "OpAtomicFAddEXT", false, false},
    {6402, "OpGroupFMulKHR", false, false},
};

// Names of GLSL.std.450 instructions, by number.
constexpr const char* extended_names[] = {
    "Bad",
    "Round",
    "RoundEven",
    "Trunc",
    "FAbs",
    "SAbs",
    "FSign",
    "SSign",
    "Floor",
    "Ceil",
    "Fract",
    "Radians",
    "Degrees",
    "Sin",
    "Cos",
    "Tan",
    "Asin",
    "Acos",
    "Atan",
    "Sinh",
    "Cosh",
    "Tanh",
    "Asinh",
    "Acosh",
    "Atanh",
    "Atan2",
    "Pow",
    "Exp",
    "Log",
    "Exp2",
    "Log2",
    "Sqrt",
    "InverseSqrt",
    "Determinant",
    "MatrixInverse",
    "Modf",
    "ModfStruct",
    "FMin",
    "UMin",
    "SMin",
    "FMax",
    "UMax",
    "SMax",
    "FClamp",
    "UClamp",
    "SClamp",
    "FMix",
    "IMix",
    "Step",
    "SmoothStep",
    "Fma",
    "Frexp",
    "FrexpStruct",
    "Ldexp",
    "PackSnorm4x8",
    "PackUnorm4x8",
    "PackSnorm2x16",
    "PackUnorm2x16",
    "PackHalf2x16",
    "PackDouble2x32",
    "UnpackSnorm2x16",
    "UnpackUnorm2x16",
    "UnpackHalf2x16",
    "UnpackSnorm4x8",
    "UnpackUnorm4x8",
    "UnpackDouble2x32",
    "Length",
    "Distance",
    "Cross",
    "Normalize",
    "FaceForward",
    "Reflect",
    "Refract",
    "FindILsb",
    "FindSMsb",
    "FindUMsb",
    "InterpolateAtCentroid",
    "InterpolateAtSample",
    "InterpolateAtOffset",
    "NMin",
    "NMax",
    "NClamp",
};
// RoundEven, Trunc, FAbs, SAbs, SSign, Floor, Ceil, the integer min, max and clamp, and the bit searches. FMin, FMax
// and FClamp are not exact: their result for NaN and -0 is implementation-defined.
constexpr std::uint32_t exact_extended[] = {2, 3, 4, 5, 7, 8, 9, 38, 39, 41, 42, 44, 45, 73, 74, 75};

const Known* find_known(std::uint16_t opcode) {
    const auto* found = std::find_if(std::begin(known), std::end(known), [&](const Known& k) { return k.opcode == opcode; });
    return found == std::end(known) ? nullptr : found;
}

bool is_exact_extended(std::uint32_t number) {
    return std::find(std::begin(exact_extended), std::end(exact_extended), number) != std::end(exact_extended);
}

std::string extended_name(std::uint32_t number) {
    return number < std::size(extended_names) ? extended_names[number] : "GLSL.std.450 " + std::to_string(number);
}

}  // namespace

std::string literal(std::span<const std::uint32_t> words) {
    const char* text = reinterpret_cast<const char*>(words.data());
    return {text, strnlen(text, words.size_bytes())};
}

std::vector<SpirvInstruction> spirv_instructions(std::span<const std::uint32_t> words) {
    if (words.size() < header_words || words[0] != 0x07230203) throw SpirvError("not a SPIR-V module");
    std::vector<SpirvInstruction> instructions;
    for (std::size_t at = header_words; at < words.size();) {
        const std::size_t count = words[at] >> 16;
        if (count == 0 || count > words.size() - at) {
            throw SpirvError("not a SPIR-V module: an instruction of " + std::to_string(count) + " words at word " +
                             std::to_string(at));
        }
        instructions.push_back({static_cast<std::uint16_t>(words[at]), at, words.subspan(at, count)});
        at += count;
    }
    return instructions;
}

std::string spirv_name(std::uint16_t opcode) {
    const Known* k = find_known(opcode);
    return k ? k->name : "Op" + std::to_string(opcode);
}

bool is_float_arithmetic(std::uint16_t opcode) {
    const Known* k = find_known(opcode);
    return k && k->arithmetic;
}

std::vector<std::string> inexact_instructions(std::span<const std::uint32_t> words) {
    std::vector<std::string> found;
    std::map<std::uint32_t, std::string> strings;
    std::set<std::uint32_t> glsl_sets;
    std::string place;
    for (const SpirvInstruction& i : spirv_instructions(words)) {
        const std::size_t size = i.words.size();
        if (i.opcode == op_string && size > 2) strings[i.words[1]] = literal(i.words.subspan(2));
        if (i.opcode == op_extended_import && size > 2 && literal(i.words.subspan(2)) == "GLSL.std.450")
            glsl_sets.insert(i.words[1]);
        if (i.opcode == op_line && size > 2) place = " at " + strings[i.words[1]] + ":" + std::to_string(i.words[2]);
        if (i.opcode == op_no_line || i.opcode == op_function) place.clear();
        const bool specialised = i.opcode == op_specialised && size > 3;
        const Known* k = find_known(specialised ? static_cast<std::uint16_t>(i.words[3]) : i.opcode);
        if (k && !k->exact) found.push_back(k->name + place);
        if (i.opcode == op_extended && size > 4 && glsl_sets.contains(i.words[3]) && !is_exact_extended(i.words[4])) {
            found.push_back(extended_name(i.words[4]) + place);
        }
    }
    return found;
}

}  // namespace scree::host
