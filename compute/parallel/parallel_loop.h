// A parallel loop on oneTBB that the thread sanitizer follows.
//
// oneTBB is built without that sanitizer, which then sees neither how a loop reaches other threads nor that it waits for them.
// The source file of the loop is compiled without it, too, for oneTBB's templates hand tasks from thread to thread in it. The
// ranges that it calls are watched.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <functional>

#include "compute/parallel/happens_before.h"

namespace scree {

// Calls range(first, last) for a partition of [0, n) into ranges of `least` items or more.
void parallel_loop(tbb::task_arena& arena, std::size_t n, std::size_t least,
                   const std::function<void(std::size_t, std::size_t)>& range);

}  // namespace scree
