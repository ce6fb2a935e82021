// A parallel loop whose ranges race: what the thread sanitizer has to find.
#include <cstddef>

#include "compute/parallel/threads.h"

int main() {
    const scree::Threads threads(4);
    std::size_t sum = 0;
    for (int i = 0; i < 100; ++i) threads.for_each(100000, [&](std::size_t k) { sum += k; });
    return sum == 0;
}
