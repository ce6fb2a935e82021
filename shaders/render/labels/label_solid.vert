// Labels of hulls and meshes.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/labels/label_solid_corner.h"
