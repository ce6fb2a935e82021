// Threads of oneTBB.
#include <tbb/global_control.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "compute/parallel/parallel_loop.h"
#include "compute/parallel/team.h"

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

}  // namespace

struct Team::Threads {
    explicit Threads(int threads)
        : limit(tbb::global_control::max_allowed_parallelism,
                std::max(static_cast<std::size_t>(threads),
                         tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))),
          count(threads),
          owned(IdleArenas::all().take(threads)),
          arena(*owned) {}
    ~Threads() { IdleArenas::all().give_back(count, std::move(owned)); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;
    tbb::global_control limit;  // else TBB would silently limit the threads to the number of cores
    int count;
    std::unique_ptr<tbb::task_arena> owned;
    tbb::task_arena& arena;
};

int Team::most(int wanted) {
    return wanted;
}

Team::Team(int threads) : threads_(std::make_unique<Threads>(threads)) {}
Team::~Team() = default;

void Team::loop(std::size_t n, std::size_t least, const Range& range) const {
    parallel_loop(threads_->arena, n, least, range);
}

std::size_t Team::slot() {
    return static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
}

std::size_t Team::slots() const {
    return static_cast<std::size_t>(threads_->arena.max_concurrency());
}

void Team::sort(std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) const {
#ifdef SCREE_THREAD_SANITIZER
    std::sort(keys.begin(), keys.end());  // it would see races among the tasks of oneTBB's sort, in which scree has no part
#else
    threads_->arena.execute([&] { tbb::parallel_sort(keys.begin(), keys.end()); });
#endif
}

}  // namespace scree
