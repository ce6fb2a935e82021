// A parallel loop on oneTBB that the thread sanitizer follows.
#include "compute/parallel/parallel_loop.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace scree {

void parallel_loop(tbb::task_arena& arena, std::size_t n, std::size_t least,
                   const std::function<void(std::size_t, std::size_t)>& range) {
    // Two of them, so that ranges wait for the loop's begin and its end for the ranges, but no range for another.
    HappensBefore begin, end;
    begin.release();
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, least), [&](const tbb::blocked_range<std::size_t>& part) {
            begin.acquire();
            range(part.begin(), part.end());
            end.release();
        });
    });
    end.acquire();
}

}  // namespace scree
