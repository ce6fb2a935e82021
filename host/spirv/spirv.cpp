// SPIR-V rewriting: NoContraction, float controls, stripping of debug lines.
#include "host/spirv/spirv.h"

#include <cstring>
#include <set>
#include <utility>

#include "host/spirv/spirv_opcodes.h"

namespace scree::host {
namespace {

constexpr std::uint32_t version_1_4 = 0x00010400;  // float controls are core from here

constexpr std::uint32_t decoration_no_contraction = 42;
constexpr std::uint32_t execution_mode_id = 331;  // OpExecutionModeId

void append(std::vector<std::uint32_t>& out, std::uint16_t opcode, std::initializer_list<std::uint32_t> operands) {
    out.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | opcode);
    out.insert(out.end(), operands);
}

void append_extension(std::vector<std::uint32_t>& out, const char* name) {
    const std::size_t words = std::strlen(name) / 4 + 1;  // including the terminating 0
    out.push_back(static_cast<std::uint32_t>(words + 1) << 16 | op_extension);
    out.resize(out.size() + words, 0);
    std::memcpy(out.data() + out.size() - words, name, std::strlen(name));
}

// Whether the opcode belongs before the first type, constant, global variable or function: preamble, execution modes,
// debug names, strings and lines, decorations.
bool stands_before_types(std::uint16_t opcode) {
    return opcode <= op_execution_mode || opcode == op_capability || (opcode >= op_decorate && opcode <= 75) ||
           opcode == op_no_line || opcode == op_module_processed || opcode == execution_mode_id || opcode == 332 ||
           opcode == 5632 || opcode == 5633;
}

}  // namespace

std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> words) {
    const std::vector<SpirvInstruction> instructions = spirv_instructions(words);
    std::set<std::uint32_t> decorated;
    std::size_t end_of_annotations = words.size();
    for (const SpirvInstruction& i : instructions) {
        if (i.opcode == op_decorate && i.words.size() > 2 && i.words[2] == decoration_no_contraction)
            decorated.insert(i.words[1]);
        if (end_of_annotations == words.size() && !stands_before_types(i.opcode)) end_of_annotations = i.at;
    }
    // OpLine applies to the instruction after it, here the first type, so insert before it.
    for (auto i = instructions.rbegin(); i != instructions.rend(); ++i) {
        if (i->at < end_of_annotations && i->opcode != op_line && i->opcode != op_no_line) break;
        if (i->at < end_of_annotations) end_of_annotations = i->at;
    }
    const auto split = words.begin() + static_cast<std::ptrdiff_t>(end_of_annotations);
    std::vector<std::uint32_t> out(words.begin(), split);
    for (const SpirvInstruction& i : instructions) {
        if (!is_float_arithmetic(i.opcode) || i.words.size() < 3 || decorated.contains(i.words[2])) continue;
        append(out, op_decorate, {i.words[2], decoration_no_contraction});
    }
    out.insert(out.end(), split, words.end());
    return out;
}

std::vector<std::uint32_t> without_lines(std::span<const std::uint32_t> words) {
    const std::set<std::uint16_t> dropped = {op_source_continued, op_source,          op_source_extension, op_string, op_line,
                                             op_no_line,          op_module_processed};
    const std::vector<SpirvInstruction> instructions = spirv_instructions(words);
    std::vector<std::uint32_t> out(words.begin(), words.begin() + header_words);
    for (const SpirvInstruction& i : instructions) {
        if (!dropped.contains(i.opcode)) out.insert(out.end(), i.words.begin(), i.words.end());
    }
    return out;
}

std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> words, FloatControls controls) {
    struct Wish {
        bool wanted;
        std::uint32_t capability, mode;
    };
    const Wish wishes[] = {
        {controls.preserve_denormals, 4464, 4459},  // DenormPreserve
        {controls.preserve_specials, 4466, 4461},   // SignedZeroInfNanPreserve
        {controls.round_to_nearest, 4467, 4462},    // RoundingModeRTE
    };
    const std::vector<SpirvInstruction> instructions = spirv_instructions(words);
    std::vector<std::uint32_t> capabilities, extensions, modes;
    std::set<std::uint32_t> capabilities_there;
    std::set<std::pair<std::uint32_t, std::uint32_t>> modes_there;  // entry point, mode
    bool extension_there = words[1] >= version_1_4;
    for (const SpirvInstruction& i : instructions) {
        if (i.opcode == op_capability && i.words.size() > 1) capabilities_there.insert(i.words[1]);
        if (i.opcode == op_extension && literal(i.words.subspan(1)) == "SPV_KHR_float_controls") extension_there = true;
        if (i.opcode == op_execution_mode && i.words.size() > 3 && i.words[3] == 32) modes_there.emplace(i.words[1], i.words[2]);
    }
    for (const Wish& wish : wishes) {
        if (!wish.wanted) continue;
        if (!capabilities_there.contains(wish.capability)) append(capabilities, op_capability, {wish.capability});
        if (!extension_there) append_extension(extensions, "SPV_KHR_float_controls");
        extension_there = true;
        for (const SpirvInstruction& i : instructions) {
            if (i.opcode != op_entry_point || i.words.size() < 3 || modes_there.contains({i.words[2], wish.mode})) continue;
            append(modes, op_execution_mode, {i.words[2], wish.mode, 32});
        }
    }
    // Section order of a module: capabilities, extensions, imports, memory model, entry points, execution modes.
    std::vector<std::uint32_t> out(words.begin(), words.begin() + header_words);
    const auto give = [&out](std::vector<std::uint32_t>& part) {
        out.insert(out.end(), part.begin(), part.end());
        part.clear();
    };
    for (const SpirvInstruction& i : instructions) {
        if (i.opcode != op_capability) give(capabilities);
        if (i.opcode != op_capability && i.opcode != op_extension) give(extensions);
        if (i.opcode > op_entry_point && i.opcode != op_capability) give(modes);
        if (i.opcode < op_entry_point - 1 && i.opcode != op_extension && i.opcode != op_extended_import) give(modes);
        out.insert(out.end(), i.words.begin(), i.words.end());
    }
    return out;
}

}  // namespace scree::host
