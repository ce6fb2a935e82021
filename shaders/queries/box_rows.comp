// Boxes: of sorted rows (step 0), and of the nodes of a level, which begins at node push.step and has as many.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/sweep.h"
#include "shaders/queries/tables.glsl"

Box both(Box a, Box b) {
    return Box(smaller3(a.lower, b.lower), NONE, larger3(a.upper, b.upper), 0u);
}

void box_row(uint i) {
    Box box = empty_box();
    KeyedRow keyed = KeyedRow(KEY_OF_NONE, NONE);
    if (i < push.items) keyed = sorted.at[i];
    if (keyed.key != KEY_OF_NONE) {
        box.row = keyed.row;
        if (keyed.key != KEY_OF_PLANES) {
            BodyProperties body = properties.at[keyed.row];
            Pose pose = poses.at[keyed.row];
            vec3 reach = half_box_of_query(pose.position, half_extents_of(body, pose.orientation));
            box.lower = pose.position - reach;
            box.upper = pose.position + reach;
        }
    }
    row_boxes.at[i] = box;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (push.step == 0u) {
        if (i < push.leaves * LEAF_ROWS) box_row(i);
    } else if (push.step == push.leaves) {
        if (i >= push.leaves) return;
        Box box = empty_box();
        for (uint k = i * LEAF_ROWS; k < (i + 1u) * LEAF_ROWS; ++k) box = both(box, row_boxes.at[k]);
        node_boxes.at[push.leaves + i] = box;
    } else if (i < push.step) {
        uint node = push.step + i;
        node_boxes.at[node] = both(node_boxes.at[2u * node], node_boxes.at[2u * node + 1u]);
    }
}
