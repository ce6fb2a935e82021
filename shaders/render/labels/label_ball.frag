// Labels of spheres and ellipsoids.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BALL
#include "shaders/render/labels/label_round.h"
