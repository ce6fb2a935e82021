// Sorts ranges of a list, defined by the stage: SORT_KEY(i) is an item's key (major, minor), SORT_SET(i, key) writes it; no two
// keys are equal.
//
// Short ranges are sorted by one thread each, by insertion. Longer ones (a plate under a heap, a world in one cell) are noted,
// and sorted by all threads of the workgroup together, by a bitonic network (Batcher 1968) whose comparisons all put the smaller
// key first, so that ranges need not have the length of a power of two. n items take n / 2 log^2 n comparisons, shared evenly.
#ifndef SCREE_STAGES_SORT_GLSL
#define SCREE_STAGES_SORT_GLSL

#include "shaders/stages/lib/long_ranges.glsl"

bool is_after(uvec2 x, uvec2 y) {
    return x.x > y.x || (x.x == y.x && x.y > y.y);
}

void sort_range(uint first, uint count) {
    for (uint k = first + 1u; k < first + count; ++k) {
        uvec2 key = SORT_KEY(k);
        uint hole = k;
        for (; hole > first && is_after(SORT_KEY(hole - 1u), key); --hole) SORT_SET(hole, SORT_KEY(hole - 1u));
        SORT_SET(hole, key);
    }
}

// The items that comparison `t` of a step compares: `reach` apart, or (flips) as far from the middle of 2 `reach` items.
uvec2 items_of(uint t, uint reach, bool flips) {
    uint offset = t & (reach - 1u), begin = (t - offset) << 1;
    return uvec2(begin + offset, begin + (flips ? 2u * reach - 1u - offset : reach + offset));
}
uint comparisons(uint count, uint reach) {
    return ((count + 2u * reach - 1u) & ~(2u * reach - 1u)) >> 1;  // of whole blocks
}

void compare(uint t, uint first, uint count, uint reach, bool flips) {
    uvec2 at = items_of(t, reach, flips);
    if (at.y >= count) return;
    uvec2 low = SORT_KEY(first + at.x), high = SORT_KEY(first + at.y);
    if (!is_after(low, high)) return;
    SORT_SET(first + at.x, high);
    SORT_SET(first + at.y, low);
}

// A step of the network a round: lavapipe runs the body of every loop once, also in workgroups that have no long range.
void sort_range_together(uint first, uint count) {
    uint widest = 1u, reach = 1u;
    while (widest < count) {
#define SCREE_COMPARE(t) compare(t, first, count, reach, reach == widest);
        FOR_FOUR(t, comparisons(count, reach), SCREE_COMPARE)
#undef SCREE_COMPARE
        end_part();
        reach >>= 1;
        if (reach == 0u) {
            widest <<= 1;
            reach = widest;
        }
    }
}

#endif
