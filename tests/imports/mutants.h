// Mutants of files of other programs: each is read, or refused with the file's name, and soon.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>

#include "tests/imports/import_case.h"
#include "tests/sanitized.h"

namespace scree::imported {

// SCREE_FUZZ=10000 mutates each format so often.
inline int mutants(int usual) {
    const char* wanted = std::getenv("SCREE_FUZZ");
    return wanted ? std::atoi(wanted) : usual;
}

// `mutate(random)` makes a mutant of the file; `options(seed)` are those that it is read with.
inline void check_mutants(Case& file, const std::string& name, int count, const auto& mutate, const auto& options) {
    int refused = 0;
    double longest = 0;
    for (int seed = 1; seed <= count; ++seed) {
        std::mt19937 random(static_cast<unsigned>(seed));
        const std::string mutant = mutate(random);
        INFO("seed " << seed);
        const std::clock_t start = std::clock();
        const std::string why = file.refusal(name, mutant, options(seed));
        longest = std::max(longest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        refused += !why.empty();
        if (!why.empty() && why.find(name) != 0) FAIL_CHECK("names no file: " << why);
    }
    CHECK(longest < 5 * tests::slowness);
    CHECK(refused > 0);
    CHECK(refused < count);
}

}  // namespace scree::imported
