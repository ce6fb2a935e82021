// Parallel loops of a team of threads.
#include "compute/parallel/threads.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "compute/parallel/happens_before.h"
#include "compute/parallel/team.h"
#include "compute/timeline.h"

namespace scree {

namespace {

int lanes_of_processor() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw"))
        return 16;
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

Threads::Threads(int count, int lanes)
    : count_(Team::most(count > 0 ? count : std::max(1, static_cast<int>(std::thread::hardware_concurrency())))),
      lanes_(std::min(lanes, widest_lanes())) {
    if (count_ > 1) team_ = std::make_unique<Team>(count_);
}
Threads::~Threads() = default;

// One slice for each thread, from its first item to its last; a thread may have waited in between.
void Threads::share_out_watched(std::size_t n, std::size_t least, const RangeBody& range) const {
    struct Work {
        Timeline::Time begin{}, end{};
        std::chrono::duration<double> busy{0};
        std::size_t items = 0;
        HappensBefore next;  // a slot of the team is one thread's, then another's
    };
    std::vector<Work> works(team_->slots());
    team_->loop(n, least, [&](std::size_t first, std::size_t last) {
        Work& work = works[Team::slot()];
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
    team_->loop(n, least, range);
}

void Threads::sort(std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) const {
    if (count_ == 1) return std::sort(keys.begin(), keys.end());
    team_->sort(keys);
}

}  // namespace scree
