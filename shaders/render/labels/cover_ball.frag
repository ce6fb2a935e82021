// Pixels that spheres and ellipsoids cover.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BALL
#define LISTS_COVERS
#include "shaders/render/labels/label_round.h"
