// Labels of capsules.
#version 460
#extension GL_GOOGLE_include_directive : require
#define CAPSULE
#include "shaders/render/labels/label_round.h"
