// The image of a body that another one meets, in scenes with a periodic cell.
#ifndef SCREE_STAGES_IMAGES_GLSL
#define SCREE_STAGES_IMAGES_GLSL

#include "shaders/physics/body/periodic_cell.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

// `ta`, `tb`: of rows of the bodies A and B.
Image image_met(BodyProperties ta, uint a, BodyProperties tb, uint b) {
    return image_of_b(ta, tb, READ(poses, b).position - READ(poses, a).position, PARAMETERS);
}

#endif
