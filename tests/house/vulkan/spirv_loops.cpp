// Loops of the compiled shaders: values used after them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/spirv/spirv.h"
#include "shaders/embedded.h"

namespace {

using namespace scree;
using Instructions = std::vector<host::SpirvInstruction>;

// Opcodes of the SPIR-V specification 1.6.
constexpr std::uint16_t op_phi = 245, op_loop_merge = 246, op_label = 248;
const std::set<std::uint16_t> without_result = {8, 62, 63, 99, 224, 225, 228, 246, 247, 249, 250, 251, 252, 253, 254, 255, 317};

// Number of leading words that may be ids, for instructions that end in literals.
std::size_t words_of_ids(const host::SpirvInstruction& instruction) {
    static const std::map<std::uint16_t, std::size_t> fewer = {{61, 4}, {62, 3}, {79, 5}, {81, 4},
                                                               {82, 5}, {95, 5}, {98, 5}, {251, 2}};
    const auto found = fewer.find(instruction.opcode);
    return found == fewer.end() ? instruction.words.size() : std::min(found->second, instruction.words.size());
}

// Index of the word with the instruction's result id; 0 without a result.
std::size_t result_of(const host::SpirvInstruction& instruction) {
    return instruction.opcode == op_label ? 1 : without_result.contains(instruction.opcode) ? 0 : 2;
}

// Index of the instruction that computes each id, in one function.
std::map<std::uint32_t, std::size_t> results(const Instructions& function) {
    std::map<std::uint32_t, std::size_t> at;
    for (std::size_t i = 0; i < function.size(); ++i)
        if (const std::size_t word = result_of(function[i]); word > 0 && word < function[i].words.size())
            at[function[i].words[word]] = i;
    return at;
}

// Values that are computed inside a loop, not by a phi, and used after it.
std::vector<std::string> leaks(const Instructions& function) {
    std::vector<std::string> found;
    const auto at = results(function);
    std::size_t label = 0;
    for (std::size_t i = 0; i < function.size(); ++i) {
        if (function[i].opcode == op_label) label = i;
        if (function[i].opcode != op_loop_merge) continue;
        const std::size_t end = at.at(function[i].words[1]);  // a loop's blocks are between its header and its merge block
        for (std::size_t k = end; k < function.size(); ++k) {
            if (function[k].opcode == op_phi || function[k].opcode == op_label) continue;
            const std::size_t own = result_of(function[k]);
            for (std::size_t word = 1; word < words_of_ids(function[k]); ++word) {
                const auto value = word == own ? at.end() : at.find(function[k].words[word]);
                if (value == at.end() || value->second <= label || value->second >= end) continue;
                const host::SpirvInstruction& computed = function[value->second];
                if (computed.opcode == op_phi || computed.opcode == op_label) continue;
                found.push_back(host::spirv_name(computed.opcode) + " %" + std::to_string(value->first) + ", used in " +
                                host::spirv_name(function[k].opcode));
            }
        }
    }
    return found;
}

std::vector<std::string> leaks(std::span<const std::uint32_t> words) {
    std::vector<std::string> found;
    Instructions function;
    for (const host::SpirvInstruction& instruction : host::spirv_instructions(words)) {
        if (instruction.opcode == 54) function.clear();  // OpFunction
        function.push_back(instruction);
        if (instruction.opcode != 56) continue;  // OpFunctionEnd
        for (std::string& leak : leaks(function)) found.push_back(std::move(leak));
        function.clear();
    }
    return found;
}

}  // namespace

// If threads leave a loop in different iterations, lavapipe returns for a value computed in the exit iteration that
// of the last iteration of any thread. Values used after a loop must go through a phi: a variable set in an earlier
// iteration, as in loops that end at their head, or one set on several paths.
TEST_CASE("house: what a stage computes in a round of a loop is not used behind it", "[house]") {
    std::size_t stages = 0;
    for (const std::string_view name : shaders::names()) {
        ++stages;
        for (const std::string& leak : leaks(shaders::find(std::string(name)))) FAIL_CHECK(name << ": " << leak);
    }
    REQUIRE(stages > 300);
}

TEST_CASE("house: a value of a round that is used behind its loop is seen", "[house]") {
    // while (true) { y = x + x; if (y > x) break; } z = y + y
    const auto op = [](std::uint16_t opcode, std::vector<std::uint32_t> words) {
        words.insert(words.begin(), static_cast<std::uint32_t>(words.size() + 1) << 16 | opcode);
        return words;
    };
    const auto module = [&](std::uint32_t used_behind) {
        std::vector<std::uint32_t> words = {0x07230203, 0x00010500, 0, 200, 0};
        for (const auto& instruction :
             {op(54, {100, 101, 0, 102}), op(248, {103}), op(128, {100, 109, 100, 100}), op(249, {104}), op(248, {104}),
              op(246, {108, 107, 0}), op(249, {105}), op(248, {105}), op(128, {100, 110, 109, 109}), op(172, {99, 111, 110, 109}),
              op(250, {111, 108, 107}), op(248, {107}), op(249, {104}), op(248, {108}),
              op(128, {100, 112, used_behind, used_behind}), op(253, {}), op(56, {})})
            words.insert(words.end(), instruction.begin(), instruction.end());
        return words;
    };
    CHECK(leaks(module(109)).empty());
    CHECK(leaks(module(110)).size() == 2);
}
