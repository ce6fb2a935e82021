// Sorts a range by one thread: SORT_GET(i) and SORT_SET(i, value), defined by the stage, read and write a uint;
// SORT_BEFORE(x, y) is the order, ascending by default.
//
// Insertion sort up to 32 items; heap sort beyond (a plate under a heap, a world in one cell), whose worst case is n
// log n.
#ifndef SCREE_STAGES_SORT_GLSL
#define SCREE_STAGES_SORT_GLSL

#ifndef SORT_BEFORE
#define SORT_BEFORE(x, y) ((x) < (y))
#endif

// One level of a sift-down: the larger child of `root` rises if `value` goes below it.
#define SINK_A_LEVEL                                                                                           \
    if (child < count) {                                                                                       \
        if (child + 1u < count && SORT_BEFORE(SORT_GET(first + child), SORT_GET(first + child + 1u))) ++child; \
        if (SORT_BEFORE(value, SORT_GET(first + child))) {                                                     \
            SORT_SET(first + root, SORT_GET(first + child));                                                   \
            root = child;                                                                                      \
            child = 2u * root + 1u;                                                                            \
        } else {                                                                                               \
            child = count;                                                                                     \
        }                                                                                                      \
    }

#define SINK_FOUR_LEVELS SINK_A_LEVEL SINK_A_LEVEL SINK_A_LEVEL SINK_A_LEVEL

// Sixteen levels before a loop: lavapipe silently ends a shader's loops after 65,535 rounds in all, which with one level a
// round a list of 4,500 items reached, and now one of 20,000 does.
void sink(uint first, uint root, uint count) {
    uint value = SORT_GET(first + root);
    uint child = 2u * root + 1u;
    SINK_FOUR_LEVELS
    SINK_FOUR_LEVELS
    SINK_FOUR_LEVELS
    SINK_FOUR_LEVELS
    while (child < count) {
        SINK_A_LEVEL
    }
    SORT_SET(first + root, value);
}

void sort_range(uint first, uint count) {
    if (count <= 32u) {
        for (uint k = first + 1u; k < first + count; ++k) {
            uint value = SORT_GET(k);
            uint hole = k;
            for (; hole > first && SORT_BEFORE(value, SORT_GET(hole - 1u)); --hole) SORT_SET(hole, SORT_GET(hole - 1u));
            SORT_SET(hole, value);
        }
        return;
    }
    for (uint root = count >> 1; root > 0u; --root) sink(first, root - 1u, count);
    for (uint end = count - 1u; end > 0u; --end) {
        uint largest = SORT_GET(first);
        SORT_SET(first, SORT_GET(first + end));
        SORT_SET(first + end, largest);
        sink(first, 0u, end);
    }
}

#endif
