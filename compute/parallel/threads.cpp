// Parallel loops on oneTBB.
#include "compute/parallel/threads.h"

#include <tbb/global_control.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "compute/parallel/parallel_loop.h"
#include "compute/timeline.h"

namespace scree {

namespace {

// Arenas that no world uses at present, by their number of threads. oneTBB 2021.8 loses about 3 kB with each arena that is
// destroyed while a worker is on its way into it: 100,000 worlds on a busy machine held 300 MB.
class IdleArenas {
public:
    std::unique_ptr<tbb::task_arena> take(int threads) {
        const std::lock_guard lock(mutex_);
        auto& idle = idle_[threads];
        if (idle.empty()) return std::make_unique<tbb::task_arena>(threads);
        std::unique_ptr<tbb::task_arena> arena = std::move(idle.back());
        idle.pop_back();
        return arena;
    }
    void give_back(int threads, std::unique_ptr<tbb::task_arena> arena) {
        const std::lock_guard lock(mutex_);
        idle_[threads].push_back(std::move(arena));
    }
    // Never destroyed: oneTBB's own state may end before it.
    static IdleArenas& all() {
        static IdleArenas& arenas = *new IdleArenas;
        return arenas;
    }

private:
    std::mutex mutex_;
    std::map<int, std::vector<std::unique_ptr<tbb::task_arena>>> idle_;
};

// Of those that are compiled.
int lanes_of_processor() {
#if SCREE_WIDEST_LANES >= 16
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw"))
        return 16;
#endif
#if SCREE_WIDEST_LANES >= 8
    if (__builtin_cpu_supports("avx2")) return 8;
#endif
    return 4;
}

int lanes_allowed() {
    const char* const text = std::getenv("SCREE_LANES");
    if (!text) return Threads::most_lanes;
    for (const int lanes : {16, 8, 4, 1})
        if (text == std::to_string(lanes)) return lanes;
    throw std::invalid_argument(std::string("environment variable SCREE_LANES: \"") + text +
                                "\" is no number of SIMD lanes; known: 16, 8, 4, 1");
}

}  // namespace

int widest_lanes() {
    static const int lanes = std::min(lanes_of_processor(), lanes_allowed());
    return lanes;
}

struct Threads::Arena {
    explicit Arena(int threads)
        : limit(tbb::global_control::max_allowed_parallelism,
                std::max(static_cast<std::size_t>(threads),
                         tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))),
          count(threads),
          owned(IdleArenas::all().take(threads)),
          arena(*owned) {}
    ~Arena() { IdleArenas::all().give_back(count, std::move(owned)); }
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;
    tbb::global_control limit;  // else TBB would silently limit the threads to the number of cores
    int count;
    std::unique_ptr<tbb::task_arena> owned;
    tbb::task_arena& arena;
};

Threads::Threads(int count, int lanes)
    : count_(count > 0 ? count : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      lanes_(std::min(lanes, widest_lanes())) {
    if (count_ > 1) arena_ = std::make_unique<Arena>(count_);
}
Threads::~Threads() = default;

// One slice for each thread, from its first item to its last; a thread may have waited in between.
void Threads::share_out_watched(std::size_t n, std::size_t least, const RangeBody& range) const {
    struct Work {
        Timeline::Time begin{}, end{};
        std::chrono::duration<double> busy{0};
        std::size_t items = 0;
        HappensBefore next;  // a slot of the arena is one thread's, then another's
    };
    std::vector<Work> works(static_cast<std::size_t>(arena_->arena.max_concurrency()));
    parallel_loop(arena_->arena, n, least, [&](std::size_t first, std::size_t last) {
        Work& work = works[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
        work.next.acquire();
        const Timeline::Time begin = Timeline::Clock::now();
        range(first, last);
        work.end = Timeline::Clock::now();
        if (work.items == 0) work.begin = begin;
        work.busy += work.end - begin;
        work.items += last - first;
        work.next.release();
    });
    for (std::size_t k = 0; k < works.size(); ++k)
        if (works[k].items > 0)
            timeline_->slice(static_cast<Timeline::Track>(k), name_, works[k].begin, works[k].end,
                             {{"items", static_cast<double>(works[k].items)}, {"busy_us", 1e6 * works[k].busy.count()}});
}

void Threads::share_out(std::size_t n, std::size_t least, const RangeBody& range) const {
    if (timeline_) return share_out_watched(n, least, range);
    parallel_loop(arena_->arena, n, least, range);
}

void Threads::sort(std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) const {
#ifdef SCREE_THREAD_SANITIZER
    std::sort(keys.begin(), keys.end());  // it would see races among the tasks of oneTBB's sort, in which scree has no part
#else
    if (count_ == 1) return std::sort(keys.begin(), keys.end());
    arena_->arena.execute([&] { tbb::parallel_sort(keys.begin(), keys.end()); });
#endif
}

}  // namespace scree
