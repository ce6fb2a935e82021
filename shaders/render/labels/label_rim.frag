// Labels of cylinders and cones.
#version 460
#extension GL_GOOGLE_include_directive : require
#define RIM
#include "shaders/render/labels/label_round.h"
