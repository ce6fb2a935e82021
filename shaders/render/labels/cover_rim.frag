// Pixels that cylinders and cones cover.
#version 460
#extension GL_GOOGLE_include_directive : require
#define RIM
#define LISTS_COVERS
#include "shaders/render/labels/label_round.h"
