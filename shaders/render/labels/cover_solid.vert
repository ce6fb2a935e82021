// Pixels that hulls and meshes cover.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#define LISTS_COVERS
#include "shaders/render/labels/label_solid_corner.h"
