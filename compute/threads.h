// Loops whose items do not depend on each other, on one thread or many: the bits are the same.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace scree {

class Threads {
public:
    explicit Threads(int count = 0);  // 0: one per core
    ~Threads();
    int count() const { return count_; }

    // Calls body(i) for every i below n.
    template <typename Body>
    void for_each(std::size_t n, const Body& body) const {
        if (count_ == 1 || n < 2 * grain) {
            for (std::size_t i = 0; i < n; ++i) body(i);
            return;
        }
        for_ranges(n, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) body(i);
        });
    }

private:
    static constexpr std::size_t grain = 64;  // items worth the hand-over to another thread
    void for_ranges(std::size_t n, const std::function<void(std::size_t, std::size_t)>& range) const;

    struct Arena;
    std::unique_ptr<Arena> arena_;
    int count_ = 1;
};

}  // namespace scree
