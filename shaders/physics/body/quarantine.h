// Quarantine: a body whose pose or velocity is not finite any more, or far beyond any scene, stops where it last was, collides
// with nothing, and joints let it go; so the others go on. Comparisons decide, which are false for any NaN: the same on every
// device, and no NaN reaches a pose.
//
// A substep that would move a body to such a state leaves it where it is, at rest, and marks it (motion.h: move_soundly);
// end_step puts it into quarantine, or finds its last velocity unsound. BodyMass.shares then says which of them found it,
// until the next step's compute_bounds replaces it by quarantine_code().
#ifndef SCREE_PHYSICS_QUARANTINE_H
#define SCREE_PHYSICS_QUARANTINE_H

#include "shaders/physics/body/motion.h"

LAWS_BEGIN

CONSTANT float AFTER_MOVE = -1.0f;
CONSTANT float AFTER_STEP = -2.0f;

LAW bool is_quarantined(uint motion) {
    return motion == MOTION_QUARANTINED;
}
// Neither collides nor hangs on joints.
LAW bool is_out_of_play(uint motion) {
    return is_absent(motion) || is_quarantined(motion);
}
// Steps done and stage of a quarantine in one float, exact for eight million steps.
LAW float quarantine_code(float mark, uint steps) {
    return float(steps) * 2.0f + choose(mark == AFTER_STEP, 1.0f, 0.0f);
}

LAWS_END

#endif
