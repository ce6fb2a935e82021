// Pixels that capsules cover.
#version 460
#extension GL_GOOGLE_include_directive : require
#define CAPSULE
#define LISTS_COVERS
#include "shaders/render/labels/label_round.h"
