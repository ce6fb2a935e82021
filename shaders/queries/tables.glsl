// Common head of the query shaders: the tables of a step that they read, and their own.
//
// A tree over the rows is built when the first query after a step comes: rows sorted by Morton code, four to a leaf, and a
// complete binary tree above (node i has the children 2 i and 2 i + 1; the leaves begin at Push.leaves).
#ifndef SCREE_QUERIES_TABLES_GLSL
#define SCREE_QUERIES_TABLES_GLSL

#include "shaders/physics/collide/ray.h"
#include "shaders/stages/lib/record_readers.glsl"

layout(local_size_x_id = 0) in;

layout(std140, set = 0, binding = 0) uniform ParametersTable {
    Parameters at[1];
}
parameters;
layout(std430, set = 0, binding = 1) readonly buffer PropertiesTable {
    BodyProperties at[];
}
properties;
layout(std430, set = 0, binding = 2) readonly buffer PosesTable {
    Pose at[];
}
poses;
layout(std430, set = 0, binding = 3) readonly buffer QuadsTable {
    uvec4 at[];
}
quads;
layout(std430, set = 0, binding = 4) readonly buffer WordsTable {
    uint at[];
}
words;
// Key and row, sorted from one list into the other and back.
struct KeyedRow {
    uint key;
    uint row;
};
layout(std430, set = 0, binding = 5) buffer KeyedRows {
    KeyedRow at[];
}
sorted;
layout(std430, set = 0, binding = 6) buffer KeyedRowsAfter {
    KeyedRow at[];
}
sorted_next;
layout(std430, set = 0, binding = 7) buffer DigitCounts {
    uint at[];
}
digits;
// Boxes of rows in their order, with the row; of nodes.
struct Box {
    vec3 lower;  // m
    uint row;
    vec3 upper;  // m; below `lower` if there is nothing in it
    uint pad;
};
layout(std430, set = 0, binding = 8) buffer RowBoxes {
    Box at[];
}
row_boxes;
layout(std430, set = 0, binding = 9) buffer NodeBoxes {
    Box at[];
}
node_boxes;
layout(std430, set = 0, binding = 10) readonly buffer Rays {
    QueryRay at[];
}
rays;
layout(std430, set = 0, binding = 11) buffer Meetings {
    QueryMeeting at[];
}
meetings;
layout(std430, set = 0, binding = 12) buffer Starts {
    uint at[];
}
starts;

layout(push_constant) uniform Push {
    uint items;   // rows; or rays, from `first` on
    uint leaves;  // a power of two
    uint step;    // which part of the work
    uint flags;   // HAS_FILTERS, IS_REORDERED
    uint rounds;  // that a thread may take
    uint first;
}
push;

const uint HAS_FILTERS = 1u;
const uint IS_REORDERED = 2u;
const uint LEAF_ROWS = 4u;
const uint RUN = 32u;           // rows that a thread sorts one by one
const uint DIGIT_VALUES = 16u;  // of four bits
const uint HEAD = 8u;           // words before the counts: bounds of all centres, the number of planes
const uint PLANES = 6u;         // place of the latter
const uint KEY_OF_PLANES = 0u;
const uint KEY_OF_NONE = 0xFFFFFFFFu;

#define PARAMETERS parameters.at[0]

uvec4 hull_record(Hulls table, uint place) {
    return quads.at[PARAMETERS.hulls_offset + place];
}
uint runs() {
    return (push.items + RUN - 1u) / RUN;
}
Box empty_box() {
    return Box(vec3(1.0e30f), NONE, vec3(-1.0e30f), 0u);
}

#endif
