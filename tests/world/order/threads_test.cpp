// Loops that threads share out, of oneTBB or (SCREE_TBB=OFF) of the standard library.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "compute/parallel/threads.h"

using scree::Threads;

TEST_CASE("threads: a loop meets each item once, whatever their number and that of the threads") {
    for (const int count : {1, 2, 3, 8}) {
        const Threads threads(count);
        for (const std::size_t n : {0, 1, 127, 128, 1000, 100000}) {
            std::vector<int> met(n, 0);
            threads.for_each(n, [&](std::size_t i) { ++met[i]; });
            CHECK(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
        }
    }
}

TEST_CASE("threads: loops of several callers and loops within loops come to an end") {
    std::atomic<std::size_t> sum = 0;
    const auto work = [&] {
        const Threads outer(3), inner(2);
        for (int round = 0; round < 50; ++round)
            outer.for_ranges(
                8,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i) inner.for_each(1000, [&](std::size_t) { ++sum; });
                },
                1);
    };
    std::vector<std::thread> callers;
    for (int k = 0; k < 3; ++k) callers.emplace_back(work);
    for (std::thread& caller : callers) caller.join();
    CHECK(sum == std::size_t{3} * 50 * 8 * 1000);
}

TEST_CASE("threads: what a range throws reaches the caller, and later loops are whole") {
    const Threads threads(4);
    const auto fail = [&] {
        threads.for_each(10000, [](std::size_t i) {
            if (i == 7777) throw std::runtime_error("item 7777");
        });
    };
    CHECK_THROWS_WITH(fail(), "item 7777");
    std::atomic<std::size_t> items = 0;
    threads.for_each(10000, [&](std::size_t) { ++items; });
    CHECK(items == 10000);
}

TEST_CASE("threads: many keys are sorted as one thread sorts them") {
    for (const int count : {2, 3, 5}) {
        for (const std::size_t n : {0, 1, 100, 4096, 50001}) {
            std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(n);
            std::uint64_t noise = 1;
            for (std::size_t i = 0; i < n; ++i) {
                noise = noise * 6364136223846793005u + 1442695040888963407u;
                keys[i] = {noise >> 50, static_cast<std::uint32_t>(i)};
            }
            auto expected = keys;
            std::sort(expected.begin(), expected.end());
            Threads(count).sort(keys);
            CHECK(keys == expected);
        }
    }
}
