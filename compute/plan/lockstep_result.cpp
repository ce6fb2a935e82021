// Comparison of tables for lockstep.
#include "compute/plan/lockstep_result.h"

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <tuple>

#include "compute/tables/table_layout.h"

namespace scree {

namespace {

// The word at `word` as both runners have it, in hexadecimal and as a float.
std::string value_of(const char* name, const std::byte* word) {
    std::uint32_t bits = 0;
    float number = 0;
    std::memcpy(&bits, word, 4);
    std::memcpy(&number, word, 4);
    std::ostringstream text;
    text << name << " 0x" << std::hex << bits << " (" << std::dec << std::setprecision(9) << number << ")";
    return text.str();
}

// Whether both words are a NaN as processors make it: its sign and payload differ between them, and no pose or velocity has
// one at the end of a step (quarantine.h).
bool are_fresh_nans(const std::byte* one, const std::byte* other) {
    const auto is_nan = [](const std::byte* word) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, word, 4);
        return bits == 0x7FC00000 || bits == 0xFFC00000 || bits == 0x7FFFFFFF;
    };
    return is_nan(one) && is_nan(other);
}

}  // namespace

std::span<const std::byte> live_bytes(const State& state, const Compared& compared) {
    return state.raw(compared.table).first(state.live(compared.length) * record_bytes(compared.table));
}

bool table_equal(const State& state, std::span<const std::byte> found, const Compared& compared, const char* here,
                 const char* there, LockstepResult& result) {
    const TableInfo& info = table_infos()[static_cast<std::size_t>(compared.table)];
    const auto expected = live_bytes(state, compared);
    auto [ours, theirs] = std::mismatch(expected.begin(), expected.end(), found.begin());
    std::size_t word = 0;
    for (;; std::tie(ours, theirs) = std::mismatch(ours, expected.end(), theirs)) {
        if (ours == expected.end()) return true;
        word = static_cast<std::size_t>(ours - expected.begin()) / 4 * 4;
        if (!are_fresh_nans(&expected[word], &found[word])) break;
        ours = expected.begin() + static_cast<std::ptrdiff_t>(word + 4);
        theirs = found.begin() + static_cast<std::ptrdiff_t>(word + 4);
    }
    result.equal = false;
    result.buffer = info.name;
    result.element = word / info.record_bytes;
    result.detail = "byte " + std::to_string(word % info.record_bytes) + ": " + value_of(here, &expected[word]) + ", " +
                    value_of(there, &found[word]);
    return false;
}

}  // namespace scree
