// Comparison of tables for lockstep.
#include "compute/step/lockstep_result.h"

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <sstream>

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

}  // namespace

std::span<const std::byte> live_bytes(const State& state, const Compared& compared) {
    return state.raw(compared.table)
        .first(state.live(compared.length) * table_infos()[static_cast<std::size_t>(compared.table)].record_bytes);
}

bool table_equal(const State& state, std::span<const std::byte> found, const Compared& compared, const char* here,
                 const char* there, LockstepResult& result) {
    const TableInfo& info = table_infos()[static_cast<std::size_t>(compared.table)];
    const auto expected = live_bytes(state, compared);
    const auto [ours, theirs] = std::mismatch(expected.begin(), expected.end(), found.begin());
    if (ours == expected.end()) return true;
    const std::size_t word = static_cast<std::size_t>(ours - expected.begin()) / 4 * 4;
    result.equal = false;
    result.buffer = info.name;
    result.element = word / info.record_bytes;
    result.detail = "byte " + std::to_string(word % info.record_bytes) + ": " + value_of(here, &expected[word]) + ", " +
                    value_of(there, &found[word]);
    return false;
}

}  // namespace scree
