// Checks the device's arithmetic: each thread computes one case (physics/base/arithmetic_check.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/arithmetic_check.h"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Cases {
    ArithmeticCase at[];
}
cases;
layout(std430, set = 0, binding = 1) writeonly buffer Results {
    uint at[];
}
results;

layout(push_constant) uniform Push {
    uint cases;
}
push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < push.cases) results.at[i] = checked_result(cases.at[i]);
}
