// Result of stepping two runners in lockstep, and the comparison of one table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "compute/plan/plan.h"
#include "compute/tables/state.h"

namespace scree {

struct LockstepResult {
    bool equal = true;
    int step = 0;             // number of equal steps
    std::string stage;        // the first stage that differs
    std::string buffer;       // the table that differs
    std::size_t element = 0;  // the first record that differs
    std::string detail;       // byte of the record and both values
    std::uint64_t hash = 0;   // of the common state at the end
};

// Compares the live records of a table of `state` with `found`, the same table of another runner (as many bytes). Writes
// the first difference to the result, with the names of both runners.
bool table_equal(const State& state, std::span<const std::byte> found, const Compared& compared, const char* here,
                 const char* there, LockstepResult& result);

// The live bytes of a table.
std::span<const std::byte> live_bytes(const State& state, const Compared& compared);

}  // namespace scree
