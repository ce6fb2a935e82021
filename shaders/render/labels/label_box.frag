// Labels of boxes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/labels/label_box.h"
