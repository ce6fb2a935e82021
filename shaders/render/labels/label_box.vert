// Labels of boxes.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/labels/label_box_corner.h"
