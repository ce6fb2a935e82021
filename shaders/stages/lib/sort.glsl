// Sorts ranges of a list, defined by the stage: SORT_KEY(i) is an item's key (major, minor), SORT_SET(i, key) writes it; no two
// keys are equal.
//
// Short ranges are sorted by one thread each, by insertion. Longer ones (a plate under a heap, a world in one cell) are noted,
// and sorted by all threads of the workgroup together, by a bitonic network (Batcher 1968) whose comparisons all put the smaller
// key first, so that ranges need not have the length of a power of two. n items take n / 2 log^2 n comparisons, shared evenly;
// within tiles they are in shared memory.
#ifndef SCREE_STAGES_SORT_GLSL
#define SCREE_STAGES_SORT_GLSL

#include "shaders/stages/lib/long_ranges.glsl"

const uint TILE_SHIFT = 10u;
const uint TILE = 1u << TILE_SHIFT;

shared uvec2 tile[TILE];

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

void compare_in_tile(uint t, uint count, uint reach, bool flips) {
    uvec2 at = items_of(t, reach, flips);
    if (at.y >= count) return;
    uvec2 low = tile[at.x], high = tile[at.y];
    if (!is_after(low, high)) return;
    tile[at.x] = high;
    tile[at.y] = low;
}
void compare_in_list(uint t, uint first, uint count, uint reach, bool flips) {
    uvec2 at = items_of(t, reach, flips);
    if (at.y >= count) return;
    uvec2 low = SORT_KEY(first + at.x), high = SORT_KEY(first + at.y);
    if (!is_after(low, high)) return;
    SORT_SET(first + at.x, high);
    SORT_SET(first + at.y, low);
}

void step_in_tile(uint count, uint reach, bool flips) {
#define SCREE_COMPARE(t) compare_in_tile(t, count, reach, flips);
    FOR_FOUR(t, comparisons(count, reach), SCREE_COMPARE)
#undef SCREE_COMPARE
    end_part();
}
void step_in_list(uint first, uint count, uint reach, bool flips) {
#define SCREE_COMPARE(t) compare_in_list(t, first, count, reach, flips);
    FOR_FOUR(t, comparisons(count, reach), SCREE_COMPARE)
#undef SCREE_COMPARE
    end_part();
}

// Sorts up to TILE items, or merges them if earlier steps reached farther.
void sort_tile(uint first, uint count, bool merges) {
#define SCREE_TAKE(t) \
    if ((t) < count) tile[t] = SORT_KEY(first + (t));
    FOR_FOUR(t, count, SCREE_TAKE)
#undef SCREE_TAKE
    end_part();
    for (uint reach = 1u; reach < count && !merges; reach <<= 1) {
        step_in_tile(count, reach, true);
        for (uint nearer = reach >> 1; nearer > 0u; nearer >>= 1) step_in_tile(count, nearer, false);
    }
    for (uint nearer = merges ? TILE >> 1 : 0u; nearer > 0u; nearer >>= 1) step_in_tile(count, nearer, false);
#define SCREE_PUT(t) \
    if ((t) < count) SORT_SET(first + (t), tile[t]);
    FOR_FOUR(t, count, SCREE_PUT)
#undef SCREE_PUT
    end_part();
}

void sort_range_together(uint first, uint count) {
    for (uint begin = 0u; begin < count; begin += TILE) sort_tile(first + begin, min(TILE, count - begin), false);
    for (uint reach = TILE; reach < count; reach <<= 1) {
        step_in_list(first, count, reach, true);
        for (uint nearer = reach >> 1; nearer >= TILE; nearer >>= 1) step_in_list(first, count, nearer, false);
        for (uint begin = 0u; begin < count; begin += TILE) sort_tile(first + begin, min(TILE, count - begin), true);
    }
}

#endif
