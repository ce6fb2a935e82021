// The law of rays, for shaders without a table of hulls.
#ifndef SCREE_RENDER_RAY_LAW_H
#define SCREE_RENDER_RAY_LAW_H

#include "shaders/physics/collide/ray.h"

uvec4 hull_record(Hulls table, uint place) {
    return uvec4(0u);
}

#endif
