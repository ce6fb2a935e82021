// Parallel loops over independent items, on one or many threads, scalar or in SIMD lanes: bit-identical.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree {

class Team;
class Timeline;

// SIMD lanes of the widest loops here: 16 with AVX-512, 8 with AVX2, else 4; fewer where the environment variable SCREE_LANES
// says so (16, 8, 4, or 1 for none). Throws std::invalid_argument for any other value of it.
int widest_lanes();

class Threads {
public:
    static constexpr int most_lanes = 16;
    static constexpr std::size_t grain = 64;  // least items per task
    explicit Threads(int count,
                     int lanes = most_lanes);  // 0: one per core, always one where there are no threads; at most widest_lanes()
    ~Threads();
    int count() const { return count_; }
    // Greatest number of SIMD lanes that a loop may use.
    int lanes() const { return lanes_; }

    // Calls body(i) for every i below n.
    template <typename Body>
    void for_each(std::size_t n, const Body& body) const {
        for_ranges(n, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) body(i);
        });
    }
    // Calls range(first, last) for a partition of [0, n) into ranges of `least` items or more.
    template <typename Range>
    void for_ranges(std::size_t n, const Range& range, std::size_t least = grain) const {
        if (count_ == 1 || n < 2 * least)
            range(std::size_t{0}, n);
        else
            share_out(n, least, range);
    }
    // Tells the timeline what each thread does in later loops, by this name; null: nothing. Not while a loop runs.
    void watch(Timeline* timeline, const std::string& name) {
        timeline_ = timeline;
        name_ = name;
    }
    void sort(std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) const;

private:
    using RangeBody = std::function<void(std::size_t, std::size_t)>;
    void share_out(std::size_t n, std::size_t least, const RangeBody& range) const;
    void share_out_watched(std::size_t n, std::size_t least, const RangeBody& range) const;

    std::unique_ptr<Team> team_;
    int count_ = 1;
    int lanes_ = most_lanes;
    Timeline* timeline_ = nullptr;
    std::string name_;
};

}  // namespace scree
