// Adds the accelerations by wind, water and attractors to those of the step.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/medium.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/copies.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.first_part || COUNTED.overflow != 0u) return;
    BodyProperties body = READ(properties, i);
    if (!is_movable(body.motion, READ_WORD(sleep_states, i), PARAMETERS.sleep_steps)) return;
    Immersion immersion = no_immersion();
    if (PARAMETERS.air_density + PARAMETERS.water_density > 0.0f) immersion = READ_QUADS(immersions, id_of(i));
    Pose pose = READ(poses, i);
    WRITE(forces, i,
          with_fields(READ(forces, i), body, immersion, pose, READ(velocities, i), mass_in_world(body, pose.orientation),
                      parameters_of(i)));
}
