// Keys of rows: bounds of all centres first (step 0), then each row's Morton code in them (step 1).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/queries/tables.glsl"

// Whole numbers in the order of floats.
uint ordered(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float of_ordered(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7FFFFFFFu : ~bits);
}
// Skips the atomic where it changes nothing.
void note_most(uint place, float x) {
    uint value = ordered(x);
    if (digits.at[place] < value) atomicMax(digits.at[place], value);
}
uint spread(uint x) {
    uint bits = (x | (x << 16u)) & 0x030000FFu;
    bits = (bits | (bits << 8u)) & 0x0300F00Fu;
    bits = (bits | (bits << 4u)) & 0x030C30C3u;
    return (bits | (bits << 2u)) & 0x09249249u;
}
uint along_axis(float x, uint axis) {
    float low = -of_ordered(digits.at[axis]), wide = of_ordered(digits.at[axis + 3u]) - low;
    return wide > 1.0e-9f ? uint(clamped((x - low) * 1023.0f * reciprocal(wide), 0.0f, 1023.0f)) : 0u;
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= push.items) return;
    BodyProperties body = properties.at[row];
    vec3 centre = poses.at[row].position;
    bool seen = is_seen(body, centre, row < PARAMETERS.first_part), plane = body.shape == SHAPE_PLANE;
    if (push.step == 0u) {
        if (!seen || plane) return;
        note_most(0u, -centre.x);
        note_most(1u, -centre.y);
        note_most(2u, -centre.z);
        note_most(3u, centre.x);
        note_most(4u, centre.y);
        note_most(5u, centre.z);
        return;
    }
    uint key = KEY_OF_NONE;
    if (seen && plane) {
        key = KEY_OF_PLANES;
        atomicAdd(digits.at[PLANES], 1u);
    } else if (seen) {
        key = 1u + (spread(along_axis(centre.x, 0u)) | spread(along_axis(centre.y, 1u)) << 1u |
                    spread(along_axis(centre.z, 2u)) << 2u);
    }
    sorted.at[row] = KeyedRow(key, row);
}
