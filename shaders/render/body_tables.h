// The tables of bodies that render shaders read.
#ifndef SCREE_RENDER_BODY_TABLES_H
#define SCREE_RENDER_BODY_TABLES_H

#include "shaders/physics/base/records.h"

layout(std430, set = 0, binding = 0) readonly buffer PropertiesTable {
    BodyProperties properties[];
};
layout(std430, set = 0, binding = 1) readonly buffer PoseTable {
    Pose poses[];
};

#endif
