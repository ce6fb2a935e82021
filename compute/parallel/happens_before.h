// Orders between threads that the thread sanitizer does not see by itself, since oneTBB is built without it.
#pragma once

#ifdef SCREE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace scree {

// What precedes release() happens before what follows acquire().
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

}  // namespace scree
