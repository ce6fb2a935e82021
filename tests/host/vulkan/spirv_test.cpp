// SPIR-V rewriting: NoContraction, inexact instructions, float controls.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "host/spirv/spirv.h"
#include "tests/host/vulkan/compiled.h"

using namespace scree::host;
using namespace scree::tests;

namespace {

const std::string arithmetic = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Values { float values[]; };
layout(std430, binding = 1) buffer Frames { mat3 frames[]; };
float law(float a, float b) { return -a * b + a - b; }
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec3 v = vec3(values[i], law(values[i], 2.0), 1.0);
    v = v * values[i] + floor(abs(v));
    frames[i] = outerProduct(v, v);
    values[i] = v.x + v.y;
}
)";

std::string with_statement(const std::string& statement, const std::string& before = "") {
    return before + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Values { float a; float b; vec4 v; mat4 m; int i; uint u; };
void main() {
)" + statement +
           "\n}\n";
}

// Result ids of float arithmetic, and how often each carries NoContraction.
std::map<std::uint32_t, int> decorations(const std::vector<std::uint32_t>& words) {
    std::map<std::uint32_t, int> counts;
    for (const SpirvInstruction& i : spirv_instructions(words)) {
        if (is_float_arithmetic(i.opcode)) counts.emplace(i.words[2], 0);
    }
    for (const SpirvInstruction& i : spirv_instructions(words)) {
        if (i.opcode == 71 && i.words[2] == 42 && counts.contains(i.words[1])) ++counts[i.words[1]];
    }
    return counts;
}

bool each_once(const std::map<std::uint32_t, int>& counts) {
    return std::all_of(counts.begin(), counts.end(), [](const auto& entry) { return entry.second == 1; });
}

}  // namespace

TEST_CASE("every float arithmetic instruction gets NoContraction once, and the module stays valid") {
    for (const char* options : {"--target-env=vulkan1.2", "--target-env=vulkan1.2 -g", "--target-env=vulkan1.0"}) {
        CAPTURE(options);
        const std::vector<std::uint32_t> before = compiled(arithmetic, options);
        const std::vector<std::uint32_t> after = without_contraction(before);
        REQUIRE(decorations(before).size() >= 8);
        REQUIRE_FALSE(each_once(decorations(before)));
        REQUIRE(each_once(decorations(after)));
        REQUIRE(without_contraction(after) == after);
        REQUIRE(is_valid(after));
        REQUIRE(is_valid(without_lines(after)));
    }
}

TEST_CASE("what GLSL marks precise is not decorated twice") {
    const std::string precise = with_statement("precise float c = a * b + a; b = c; a = a - b;");
    const std::vector<std::uint32_t> after = without_contraction(compiled(precise));
    REQUIRE(each_once(decorations(after)));
    REQUIRE(is_valid(after));
}

TEST_CASE("a shader without line numbers is the same whether it had them") {
    REQUIRE(without_lines(compiled(arithmetic, "--target-env=vulkan1.2 -g")).size() ==
            without_lines(compiled(arithmetic, "--target-env=vulkan1.2")).size());
}

TEST_CASE("exact arithmetic is not complained about") {
    REQUIRE(inexact_instructions(compiled(arithmetic)).empty());
    REQUIRE(inexact_instructions(compiled(with_statement(R"(
        a = trunc(a) + ceil(b) - float(i) * uintBitsToFloat(u); u = atomicAdd(u, uint(a)); i = clamp(abs(i), 0, 7) / 3;
        if (a < b) v = v * 2.0; u = min(u, max(7u, uint(findMSB(u)))); a = roundEven(a);)")))
                .empty());
}

TEST_CASE("instructions whose bits differ between devices are found by name") {
    const std::pair<const char*, const char*> cases[] = {
        {"a = a / b;", "OpFDiv"},
        {"a = mod(a, b);", "OpFMod"},
        {"a = dot(v, v);", "OpDot"},
        {"v = m * v;", "OpMatrixTimesVector"},
        {"v = v * m;", "OpVectorTimesMatrix"},
        {"m = m * m;", "OpMatrixTimesMatrix"},
        {"m = m * a;", "OpMatrixTimesScalar"},
        {"a = sqrt(a);", "Sqrt"},
        {"a = inversesqrt(a);", "InverseSqrt"},
        {"v = normalize(v);", "Normalize"},
        {"a = length(v);", "Length"},
        {"a = sin(a);", "Sin"},
        {"a = atan(a, b);", "Atan2"},
        {"a = pow(a, b);", "Pow"},
        {"a = fma(a, b, a);", "Fma"},
        {"a = mix(a, b, 0.5);", "FMix"},
        {"a = min(a, b);", "FMin"},
        {"a = max(a, b);", "FMax"},
        {"a = clamp(a, 0.0, b);", "FClamp"},
        {"a = smoothstep(a, b, 0.5);", "SmoothStep"},
        {"v.xyz = cross(v.xyz, v.yzw);", "Cross"},
        {"a = fract(a);", "Fract"},
        {"a = round(a);", "Round"},
        {"u = packHalf2x16(vec2(a, b));", "PackHalf2x16"},
    };
    for (const auto& [statement, name] : cases) {
        CAPTURE(statement);
        REQUIRE(inexact_instructions(compiled(with_statement(statement))) == std::vector<std::string>{name});
    }
    REQUIRE(inexact_instructions(compiled(with_statement("a = subgroupAdd(a) + float(subgroupAdd(u));",
                                                         "#extension GL_KHR_shader_subgroup_arithmetic : require\n"))) ==
            std::vector<std::string>{"OpGroupNonUniformFAdd"});
    REQUIRE(inexact_instructions(
                compiled(with_statement("a = atomicAdd(b, a);", "#extension GL_EXT_shader_atomic_float : require\n"))) ==
            std::vector<std::string>{"OpAtomicFAddEXT"});
}

TEST_CASE("an inexact instruction is placed by file and line where the module knows them") {
    const std::vector<std::string> found =
        inexact_instructions(compiled(with_statement("a = a / b;"), "--target-env=vulkan1.2 -g"));
    REQUIRE(found.size() == 1);
    REQUIRE_THAT(found[0], Catch::StartsWith("OpFDiv at ") && Catch::EndsWith("test.comp:6"));
}

TEST_CASE("float controls make a valid module, are asked for once, and change nothing when none is wanted") {
    for (const char* environment : {"vulkan1.2", "vulkan1.1"}) {
        const std::vector<std::uint32_t> words =
            without_contraction(compiled(arithmetic, std::string("--target-env=") + environment));
        const std::vector<std::uint32_t> preserved = with_float_controls(words, {true, false, false});
        const std::vector<std::uint32_t> all = with_float_controls(words, {true, true, true});
        CAPTURE(environment);
        REQUIRE(preserved.size() > words.size());
        REQUIRE(is_valid(preserved, environment));
        REQUIRE(is_valid(all, environment));
        REQUIRE(with_float_controls(preserved, {true, false, false}) == preserved);
        REQUIRE(with_float_controls(all, {true, false, false}) == all);
        REQUIRE(with_float_controls(words, {}) == words);
        REQUIRE(is_valid(with_float_controls(preserved, {false, true, true}), environment));
    }
}

TEST_CASE("words that are no SPIR-V are refused") {
    REQUIRE_THROWS_AS(spirv_instructions(std::vector<std::uint32_t>{}), SpirvError);
    REQUIRE_THROWS_AS(spirv_instructions(std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6}), SpirvError);
    std::vector<std::uint32_t> cut = compiled(arithmetic);
    cut.pop_back();
    cut.push_back(0);
    REQUIRE_THROWS_AS(spirv_instructions(cut), SpirvError);
    cut.back() = 100u << 16;
    REQUIRE_THROWS_WITH(without_contraction(cut), Catch::Contains("100 words"));
}
