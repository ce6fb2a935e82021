// Parallel loops on oneTBB.
#include "compute/step/threads.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace scree {

struct Threads::Arena {
    explicit Arena(int threads)
        : limit(tbb::global_control::max_allowed_parallelism,
                std::max(static_cast<std::size_t>(threads),
                         tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))),
          arena(threads) {}
    tbb::global_control limit;  // else TBB would silently limit the threads to the number of cores
    tbb::task_arena arena;
};

Threads::Threads(int count, int lanes)
    : count_(count > 0 ? count : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))), lanes_(lanes) {
    if (count_ > 1) arena_ = std::make_unique<Arena>(count_);
}
Threads::~Threads() = default;

void Threads::share_out(std::size_t n, const std::function<void(std::size_t, std::size_t)>& range) const {
    arena_->arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                          [&](const tbb::blocked_range<std::size_t>& part) { range(part.begin(), part.end()); });
    });
}

void Threads::run(const std::function<void()>& work) const {
    arena_->arena.execute(work);
}

}  // namespace scree
