// Threads that share out loops: those of oneTBB (team_tbb.cpp), or where the build has none of it (SCREE_TBB) a few of the
// standard library (team_standard.cpp). Results do not depend on which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace scree {

class Team {
public:
    using Range = std::function<void(std::size_t, std::size_t)>;

    // How many of `wanted` threads, 1 or more, this machine can have: 1 where programs have no threads.
    static int most(int wanted);

    explicit Team(int threads);  // 2 or more, the caller of a loop among them
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    // Calls range(first, last) for a partition of [0, n) into ranges of `least` items or more, and returns after the last. What a
    // range throws is thrown once.
    void loop(std::size_t n, std::size_t least, const Range& range) const;
    // Within a range: the thread's number in the loop, below slots(). A number may be one thread's, then another's.
    static std::size_t slot();
    std::size_t slots() const;
    void sort(std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) const;

private:
    struct Threads;
    std::unique_ptr<Threads> threads_;
};

}  // namespace scree
