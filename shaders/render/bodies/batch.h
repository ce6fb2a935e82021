// Body and vertex of a shader invocation, since an instance holds several bodies.
#ifndef SCREE_RENDER_BATCH_H
#define SCREE_RENDER_BATCH_H

#include "shaders/render/scene.h"

layout(std430, set = 0, binding = 13) readonly buffer RunTable {
    BodyRun runs[];
};
layout(std430, set = 0, binding = 20) readonly buffer TintTable {
    vec4 tints[];  // see tint.comp
};
layout(push_constant) uniform Pushed {
    uint pushed;  // run << 8 | value for the pass
};

struct Corner {
    uint body;
    uint corner;
    bool there;  // false past the last body of the run
};
Corner corner_of_body() {
    BodyRun run = runs[pushed >> 8];
    uint vertex = uint(gl_VertexIndex);
    uint place = uint(gl_InstanceIndex) * run.together + vertex / run.corners;
    Corner corner;
    corner.there = place < run.count;
    corner.body = corner.there ? instances[run.first + place] : 0u;
    corner.corner = run.directions + vertex % run.corners;
    return corner;
}

#endif
