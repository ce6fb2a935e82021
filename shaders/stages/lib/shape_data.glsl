// Access to the table of hulls for the collision functions.
#ifndef SCREE_STAGES_SHAPE_DATA_GLSL
#define SCREE_STAGES_SHAPE_DATA_GLSL

#include "shaders/physics/collide/shape_data.h"
#include "shaders/stages/lib/stage.glsl"

uvec4 hull_record(Hulls table, uint place) {
    return READ_QUADS(hulls, place);
}

#endif
