// Pixels that boxes cover.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LISTS_COVERS
#include "shaders/render/labels/label_box.h"
