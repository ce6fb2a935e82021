// Ranges of a list that are too long for one thread: each thread notes its own, and all threads of the workgroup then work on one
// after the other together.
#ifndef SCREE_STAGES_LONG_RANGES_GLSL
#define SCREE_STAGES_LONG_RANGES_GLSL

const uint SHORT_RANGE = 32u;  // items of those that one thread does

shared uint long_range[256];  // whose they are: a number for each
shared uint long_ranges;

#ifndef SCREE_FUSED
void end_part() {
    memoryBarrierBuffer();
    barrier();
}
#endif

// All threads call the first and the last of these, before and after some of them note ranges.
void begin_long_ranges() {
    if (gl_LocalInvocationID.x == 0u) long_ranges = 0u;
    end_part();
}
void note_long_range(uint whose) {
    long_range[atomicAdd(long_ranges, 1u)] = whose;
}
uint long_ranges_noted() {
    end_part();
    return long_ranges;
}

// Shares `count` items among the threads. Four a round: lavapipe silently ends a shader's loops after 65,535 rounds in all
// (compute/device/long_lists.cpp counts them). `what` is a macro that does nothing from `count` on.
#define FOR_FOUR(t, count, what)                                                                                 \
    for (uint t = gl_LocalInvocationID.x; t < (count); t += 4u * gl_WorkGroupSize.x) {                           \
        what(t) what(t + gl_WorkGroupSize.x) what(t + 2u * gl_WorkGroupSize.x) what(t + 3u * gl_WorkGroupSize.x) \
    }

#endif
