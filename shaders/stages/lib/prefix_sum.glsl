// Exclusive prefix sums within a workgroup.
#ifndef SCREE_STAGES_PREFIX_SUM_GLSL
#define SCREE_STAGES_PREFIX_SUM_GLSL

layout(local_size_x_id = 0) in;  // before gl_WorkGroupSize, which is 1 otherwise

#ifndef SCREE_FUSED
#define end_part() barrier()
#endif

shared uint partial[256];

// The sum of the values of the threads before this one; all threads call it.
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

#endif
