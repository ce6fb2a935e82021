// Exclusive prefix sums in three stages (reduce, then scan): sums of blocks, a scan of the sums by one workgroup, offsets.
//
// Nothing waits for another workgroup, because Vulkan promises no such progress; decoupled look-back would hang on some devices.
// What is scanned is chosen by the variant: SCAN_ITEMS_OF items, read by SCAN_READ(i), result to SCAN_WRITE(i, sum), one more for
// the total, which SCAN_TOTAL(total) hears of.
#ifndef SCREE_STAGES_SCAN_GLSL
#define SCREE_STAGES_SCAN_GLSL

#include "shaders/stages/lib/stage.glsl"

#if defined(SCAN_CELLS)
#define SCAN_ITEMS_OF (PARAMETERS.buckets + 1u)
#define SCAN_READ(i) READ_WORD(cell_counts, i)
#define SCAN_WRITE(i, sum) WORD(cell_starts, i) = sum
#define SCAN_TOTAL(total)
#elif defined(SCAN_PAIRS)
#define SCAN_ITEMS_OF PARAMETERS.bodies
#define SCAN_READ(i) READ_WORD(pair_counts, i)
#define SCAN_WRITE(i, sum) WORD(pair_starts, i) = sum
#define SCAN_TOTAL(total) COUNTS = with_pairs(COUNTS, total, PARAMETERS)
#elif defined(SCAN_KINDS)
#define SCAN_ITEMS_OF (KINDS * spans_of(COUNTED.pairs))
#define SCAN_READ(i) READ_WORD(kind_counts, i)
#define SCAN_WRITE(i, sum) WORD(kind_starts, i) = sum
#define SCAN_TOTAL(total)
#elif defined(SCAN_CONTACTS)
#define SCAN_ITEMS_OF COUNTED.pairs
#define SCAN_READ(i) (READ_WORD(touching, i) > 0u ? 1u : 0u)
#define SCAN_WRITE(i, sum) WORD(contact_starts, i) = sum
#define SCAN_TOTAL(total) COUNTS = with_contacts(COUNTS, total, PARAMETERS)
#elif defined(SCAN_SLOTS)
#define SCAN_ITEMS_OF PARAMETERS.bodies
#define SCAN_READ(i) READ_WORD(slot_counts, i)
#define SCAN_WRITE(i, sum) WORD(slot_starts, i) = sum
#define SCAN_TOTAL(total)
#endif

#ifndef SCREE_FUSED
#define end_part() barrier()
#endif

shared uint partial[256];

// Sum of the values of the workgroup's threads before this one. Every thread calls it.
uint sum_before(uint value) {
    uint t = gl_LocalInvocationID.x;
    partial[t] = value;
    end_part();
    for (uint d = 1u; d < gl_WorkGroupSize.x; d <<= 1) {
        uint other = t >= d ? partial[t - d] : 0u;
        end_part();
        partial[t] += other;
        end_part();
    }
    return partial[t] - value;
}

#ifdef SCREE_FUSED
// The whole of a short list, by one workgroup.
void scan_whole() {
    uint items = SCAN_ITEMS_OF;
    uint total = 0u;
    for (uint begin = 0u; begin <= items; begin += gl_WorkGroupSize.x << SCAN_SHIFT) {
        uint first = begin + (gl_LocalInvocationID.x << SCAN_SHIFT);
        uint values[SCAN_ITEMS];
        uint sum = 0u;
        for (uint k = 0u; k < SCAN_ITEMS; ++k) {
            values[k] = first + k < items ? SCAN_READ(first + k) : 0u;
            sum += values[k];
        }
        uint running = total + sum_before(sum);
        for (uint k = 0u; k < SCAN_ITEMS; ++k) {
            if (first + k <= items) SCAN_WRITE(first + k, running);
            running += values[k];
        }
        end_part();
        total += partial[gl_WorkGroupSize.x - 1u];
        end_part();
    }
    if (gl_LocalInvocationID.x == 0u) {
        SCAN_TOTAL(total);
    }
}
#endif

#endif
