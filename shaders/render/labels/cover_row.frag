// Pixels that boxes, hulls and meshes cover: their triangles are enough to tell.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LISTS_COVERS
#include "shaders/render/labels/label.h"

layout(location = 0) flat in uint row;

void main() {
    tell(row, vec3(0.0), 0.0);
}
