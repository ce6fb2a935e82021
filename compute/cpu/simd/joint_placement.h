// Where the joints of lanes are on their bodies. After simd_types.h and the laws, whose types it uses.
#pragma once

LAWS_BEGIN

namespace {

// The first members of a Joint.
struct Placement {
    uint a, b, block_body_a, block_body_b;
    vec3 anchor_a;
    uint flags;
    vec3 anchor_b;
    uint next_a;
    vec4 frame_a, frame_b;
};
static_assert(sizeof(Placement) == offsetof(Joint, axes));

}  // namespace

LAWS_END
