// Exclusive prefix sums of the digits' counts, in place: of each block, which leaves its total behind the list (step 0); of
// these totals, by one workgroup (step 1); their addition (step 2).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/queries/tables.glsl"
#include "shaders/stages/lib/prefix_sum.glsl"

const uint ITEMS = 16u;  // per thread

void main() {
    uint items = DIGIT_VALUES * runs(), block = gl_WorkGroupSize.x * ITEMS;
    uint totals = HEAD + items, blocks = (items + block - 1u) / block;
    uint first = gl_GlobalInvocationID.x * ITEMS, last = min(first + ITEMS, items);
    if (push.step == 1u) {
        uint total = 0u;
        for (uint begin = 0u; begin < blocks; begin += gl_WorkGroupSize.x) {
            uint i = begin + gl_LocalInvocationID.x;
            uint value = i < blocks ? digits.at[totals + i] : 0u;
            uint before = sum_before(value);
            if (i < blocks) digits.at[totals + i] = total + before;
            barrier();
            total += partial[gl_WorkGroupSize.x - 1u];
            barrier();
        }
    } else if (push.step == 2u) {
        uint before = digits.at[totals + gl_WorkGroupID.x];
        for (uint i = first; i < last; ++i) digits.at[HEAD + i] += before;
    } else {
        uint sum = 0u;
        for (uint i = first; i < last; ++i) sum += digits.at[HEAD + i];
        uint before = sum_before(sum);
        if (gl_LocalInvocationID.x == gl_WorkGroupSize.x - 1u) digits.at[totals + gl_WorkGroupID.x] = before + sum;
        for (uint i = first; i < last; ++i) {
            uint value = digits.at[HEAD + i];
            digits.at[HEAD + i] = before;
            before += value;
        }
    }
}
