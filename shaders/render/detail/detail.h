// Sorting of visible bodies by level of detail, on the device.
#ifndef SCREE_RENDER_DETAIL_H
#define SCREE_RENDER_DETAIL_H

#include "shaders/physics/body/body_scale.h"
#include "shaders/render/body_tables.h"
#include "shaders/render/frame.h"

layout(local_size_x = 128) in;  // DETAIL_GROUP

layout(std430, set = 0, binding = 3) buffer InstanceTable {
    uint instances[];  // all bodies grouped by shape, then the visible ones grouped by run
};
#ifdef WRITES_FRAME
layout(std430, set = 0, binding = 4) buffer FrameBlock {
    Frame frame;
};
#else
layout(std430, set = 0, binding = 4) readonly buffer FrameBlock {
    Frame frame;
};
#endif
layout(std430, set = 0, binding = 13) buffer RunTable {
    BodyRun runs[];
};
struct Arguments {  // VkDrawIndexedIndirectCommand
    uint indices;
    uint instances;
    uint first_index;
    uint vertex_offset;
    uint first_instance;
};
layout(std430, set = 0, binding = 14) buffer ArgumentTable {
    Arguments arguments[];
};
layout(std430, set = 0, binding = 15) buffer GroupTable {
    uint group_counts[];  // GROUP_WORDS per workgroup: bodies of each run, then bounds as bits of floats
};

uint bodies_to_see() {
    return runs[RUN_PLANES].first;
}

uint run_of_place(uint place) {
    if (place >= bodies_to_see()) return NOT_SEEN;
    uint body = instances[place];
    BodyProperties t = properties[body];
    if (is_absent(t.motion)) return NOT_SEEN;
    uint shape = place >= runs[RUN_ALL_SOLIDS].first     ? RUN_ALL_SOLIDS
                 : place >= runs[RUN_ALL_BOXES].first    ? RUN_ALL_BOXES
                 : place >= runs[RUN_ALL_CAPSULES].first ? RUN_ALL_CAPSULES
                                                         : RUN_ALL_SPHERES;
    float reach =
        t.shape == SHAPE_TRIANGLE ? 1e9 : bounding_radius(t);  // a triangle row draws a whole patch of its mesh: never cull
    return run_of(frame, shape, poses[body].position - frame.eye.xyz, reach, shape == RUN_ALL_SPHERES ? reach : t.size.x);
}

#endif
