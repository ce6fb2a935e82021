// Copies of a scene (shaders/physics/base/copies.h): which one a row belongs to, its age and its gravity.
#ifndef SCREE_STAGES_COPIES_GLSL
#define SCREE_STAGES_COPIES_GLSL

#include "shaders/physics/base/copies.h"
#include "shaders/stages/lib/ids.glsl"

// Of a body, not a part.
uint copy_of(uint body) {
    return copy_of_id(id_of(body), PARAMETERS);
}
// Whether this step is the first of a body's copy.
bool is_newborn(uint body) {
    if (!COPIES) return false;
    return READ_WORD(births, copy_of(body)) == COUNTED.steps;
}
// The parameters with the gravity of a body's copy.
Parameters parameters_of(uint body) {
    Parameters own = PARAMETERS;
    if (GRAVITIES) {
        uvec4 words = READ_QUADS(gravities, copy_of(body));
        own.gravity = vec3(uintBitsToFloat(words.x), uintBitsToFloat(words.y), uintBitsToFloat(words.z));
    }
    return own;
}

#endif
