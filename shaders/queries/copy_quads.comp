// Copies a buffer, 16 bytes a thread at a time, to measure the bandwidth of the device's memory (host/copy_speed.h).
#version 460

layout(local_size_x_id = 0) in;

layout(std430, set = 0, binding = 0) readonly buffer From {
    uvec4 at[];
}
from;
layout(std430, set = 0, binding = 1) writeonly buffer To {
    uvec4 at[];
}
to;

void main() {
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_GlobalInvocationID.x; i < to.at.length(); i += stride) to.at[i] = from.at[i];
}
