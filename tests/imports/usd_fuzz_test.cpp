// Mutated USD files: read, or refused with the file's name; never a crash, a hang, or memory out of proportion.
#include <random>

#include "tests/imports/crate_writer.h"
#include "tests/imports/import_case.h"
#include "tests/imports/mutants.h"
#include "tests/imports/usd_text.h"

using namespace scree;
using scree::imported::Case;

namespace {

const std::vector<std::string> usd_words = {"0",      "-1",         "1e30",   "nan",  "inf",      "1e400",    "None", "(",
                                            ")",      "[]",         "{",      "}",    "</>",      "<../>",    "@a@",  "</World>",
                                            "\"\"",   "true",       "def",    "over", "class",    "variants", ";",    ".",
                                            "(1, 2)", "references", "delete", "rel",  "[(0, 0)]", "\x80\xff"};

std::string usd_mutated(std::string bytes, std::mt19937& random, bool binary) {
    const auto below = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); };
    for (std::size_t n = 1 + below(4); n-- > 0 && bytes.size() > 16;) {
        const std::size_t at = below(bytes.size());
        switch (below(binary ? 5 : 7)) {
            case 0:
                bytes[at] = static_cast<char>(below(256));
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 2:
                bytes.erase(at, below(std::min<std::size_t>(bytes.size() - at, 100)) + 1);
                break;
            case 3:
                bytes.insert(at, bytes.substr(below(bytes.size()), below(100)));
                break;
            case 4:
                if (below(4) == 0) bytes.resize(at);
                break;
            default: {  // a word
                const std::size_t from = bytes.find_first_of(" \n(", at);
                if (from == bytes.npos) break;
                const std::size_t end = bytes.find_first_of(" \n,)", from + 1);
                bytes.replace(from + 1, std::min(end, bytes.size()) - from - 1, usd_words[below(usd_words.size())]);
            }
        }
    }
    return bytes;
}

}  // namespace

TEST_CASE("imports: mutated USD files are read or refused with file and place") {
    const int count = imported::mutants(500);
    const std::string crate = imported::crate_of(*imports::layer_of_usda(imported::everything_usda, "text"), 8);
    const std::pair<std::string, std::string> formats[] = {
        {"a.usda", imported::everything_usda},
        {"a.usdc", crate},
        {"a.usdz", imported::zip_of({{"x.usdc", crate}, {"y.usda", imported::everything_usda}})}};
    Case file;
    for (const auto& [name, bytes] : formats) {
        INFO(name);
        REQUIRE(file.refusal(name, bytes).empty());
        imported::check_mutants(
            file, name, count,
            [&name = name, &bytes = bytes](std::mt19937& random) { return usd_mutated(bytes, random, name != "a.usda"); },
            [](int) { return ImportOptions{}; });
    }
}
