// Rules of the common subset of GLSL and C++, checked on the text of laws and stages.
#include <catch2/catch.hpp>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "tests/house/tree.h"

namespace {

using scree::house::at;
using scree::house::SourceFile;
using scree::house::Token;

// Functions without correct rounding in Vulkan, or with results that vary between processors.
const std::set<std::string> forbidden_calls = {
    "sqrt",        "inversesqrt", "normalize",    "length",    "distance", "dot",     "cross",      "mix",         "fma",
    "min",         "max",         "clamp",        "pow",       "exp",      "exp2",    "log",        "log2",        "sin",
    "cos",         "tan",         "asin",         "acos",      "atan",     "sinh",    "cosh",       "tanh",        "mod",
    "fract",       "step",        "round",        "sign",      "reflect",  "refract", "smoothstep", "faceforward", "inverse",
    "determinant", "transpose",   "outerProduct", "roundEven", "modf",     "ldexp",   "frexp",      "isnan",       "isinf",
};
const std::set<std::string> forbidden_words = {"double",    "dvec2", "dvec3", "dvec4",      "float16_t",
                                               "float64_t", "half",  "quat",  "subgroupAdd"};

bool is_swizzle(const Token& before, const Token& token) {
    if (token.text.size() < 2 || token.text.size() > 4) return false;
    const bool letters =
        token.text.find_first_not_of("xyzw") == std::string::npos || token.text.find_first_not_of("rgba") == std::string::npos;
    // Symmetric matrices have members xx to zz, which as swizzles would not compile in C++.
    static const std::set<std::string> members = {"xx", "xy", "xz", "yy", "yz", "zz"};
    return letters && (members.count(token.text) == 0 || before.text.compare(0, 3, "gl_") == 0);
}

// Names of float constants. (GLSL compilers may fold constants in double precision: 0.05f * 0.05f differed from C++.)
std::set<std::string> constants_of(const SourceFile& file) {
    std::set<std::string> names;
    const std::vector<Token> tokens = scree::house::tokens_of(file.text);
    for (std::size_t i = 2; i < tokens.size(); ++i)
        if (tokens[i - 2].text == "CONSTANT" && tokens[i - 1].text == "float") names.insert(tokens[i].text);
    return names;
}

bool is_constant(const Token& token, const std::set<std::string>& constants) {
    const bool fraction = token.number() && token.text.compare(0, 2, "0x") != 0 && token.text.back() == 'f';
    return fraction || constants.count(token.text) != 0;
}

std::vector<std::string> breaches(const SourceFile& file, const std::set<std::string>& constants = {}) {
    std::vector<std::string> found;
    const std::vector<Token> tokens = scree::house::tokens_of(file.text);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        const std::string next = i + 1 < tokens.size() ? tokens[i + 1].text : "";
        const std::string previous = i > 0 ? tokens[i - 1].text : "";
        const bool quotient = previous == "dividend" && next == "divisor";  // of integers, in copies.h
        if (token.text == "/" && !quotient) found.push_back(at(file, token.line, "division; multiply by reciprocal()"));
        // Stages use these on integers, which is exact; tests/house/vulkan/spirv.cpp detects uses on floats.
        const bool on_integers =
            file.in("shaders/stages/") && (token.text == "min" || token.text == "max" || token.text == "clamp");
        if (token.identifier() && !on_integers && next == "(" && previous != "." && forbidden_calls.count(token.text) != 0) {
            found.push_back(at(file, token.line, token.text + "() differs between processors; arithmetic.h has ours"));
        }
        if (token.identifier() && forbidden_words.count(token.text) != 0) found.push_back(at(file, token.line, token.text));
        if (token.number() && token.text.compare(0, 2, "0x") != 0) {
            const bool fraction = token.text.find_first_of(".eE") != std::string::npos;
            const bool ends_in_f = token.text.back() == 'f' && token.text[token.text.size() - 2] != 'l';
            if (fraction && !ends_in_f) found.push_back(at(file, token.line, token.text + " is a double in C++; write an f"));
        }
        if (i > 0 && i + 1 < tokens.size() && is_constant(tokens[i - 1], constants) && is_constant(tokens[i + 1], constants)) {
            // Whether the two operands combine first.
            const std::string before = i > 1 ? tokens[i - 2].text : "", after = i + 2 < tokens.size() ? tokens[i + 2].text : "";
            const bool product = token.text == "*" && before != "*";
            const bool sum =
                (token.text == "+" || token.text == "-") && before != "*" && before != "+" && before != "-" && after != "*";
            if (product || sum)
                found.push_back(at(file, token.line, previous + " " + token.text + " " + next + " is rounded otherwise in GLSL"));
        }
        if (i > 1 && previous == "." && is_swizzle(tokens[i - 2], token)) {
            found.push_back(at(file, token.line, "swizzle ." + token.text));
        }
    }
    return found;
}

}  // namespace

TEST_CASE("house: the laws and the stages keep to the common subset", "[house]") {
    std::vector<SourceFile> files;
    std::set<std::string> constants;
    for (const SourceFile& file : scree::house::code_files()) {
        if (!file.in("shaders/physics/") && !file.in("shaders/stages/")) continue;
        files.push_back(file);
        constants.merge(constants_of(file));
    }
    REQUIRE(constants.count("ARRIVAL") == 1);
    for (const SourceFile& file : files)
        for (const std::string& breach : breaches(file, constants)) FAIL_CHECK(breach);
    REQUIRE(files.size() > 3);
}

TEST_CASE("house: a breach of the subset is seen", "[house]") {
    const auto count = [](const std::string& code) { return breaches({"shaders/physics/law.h", code}).size(); };
    CHECK(count("float y = a * b - 2.0f; // a / b, sqrt(2.0)\n#include \"a/b.h\"\n") == 0);
    CHECK(count("uint y = 0x5F375A86u - (x >> 1); float z = m.xx + clamped(1.0e-3f, 0.0f, 1.0f);") == 0);
    CHECK(count("float y = a / b;") == 1);
    CHECK(count("float y = sqrt(a);") == 1);
    CHECK(count("float y = 2.0 * a;") == 1);
    CHECK(count("float y = 1e-3 * a;") == 1);
    CHECK(count("vec3 y = a.xyz;") == 1);
    CHECK(count("uint y = gl_GlobalInvocationID.xy;") == 1);
    CHECK(count("double y;") == 1);
    CHECK(count("float y = 0.1f * 0.1f;") == 1);
    CHECK(count("float y = a - 0.1f * 0.1f;") == 1);
    CHECK(count("float y = 0.1f + 0.2f;") == 1);
    CHECK(count("float y = a * 0.1f * 0.3f + 0.2f - 0.1f * a;") == 0);
    CHECK(breaches({"shaders/physics/law.h", "bool y = a > SLIP * SLIP;"}, {"SLIP"}).size() == 1);
}
