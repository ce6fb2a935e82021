// A parallel loop on oneTBB that the thread sanitizer follows.
//
// oneTBB is built without that sanitizer, which then sees neither how a loop reaches other threads nor that it waits for them.
// The source file of the loop is compiled without it, too, for oneTBB's templates hand tasks from thread to thread in it. The
// ranges that it calls are watched.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <functional>

#ifdef SCREE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace scree {

// An order that the sanitizer does not see by itself: what precedes release() happens before what follows acquire().
class HappensBefore {
public:
#ifdef SCREE_THREAD_SANITIZER
    void release() {
        __tsan_release(this);
    }
    void acquire() {
        __tsan_acquire(this);
    }
#else
    void release() {}
    void acquire() {}
#endif
};

// Calls range(first, last) for a partition of [0, n) into ranges of `least` items or more.
void parallel_loop(tbb::task_arena& arena, std::size_t n, std::size_t least,
                   const std::function<void(std::size_t, std::size_t)>& range);

}  // namespace scree
