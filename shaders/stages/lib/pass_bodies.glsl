// A substep of one body: velocity before the biased pass, pose between the biased and the relax pass.
#ifndef SCREE_STAGES_PASS_BODIES_GLSL
#define SCREE_STAGES_PASS_BODIES_GLSL

#include "shaders/physics/base/passes.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/driven.h"
#include "shaders/physics/body/grab_spring.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/contact/contact_solver.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/gather.glsl"

// The velocity in a substep of the body of an action. `left`: substeps that follow.
void drive_body(uint i, uint left) {
    if (i >= PARAMETERS.actions || COUNTED.overflow != 0u) return;
    Action action = actions.at[i];
    if (!changes_velocity(action, READ(properties, action.body))) return;
    WRITE(velocities, action.body, velocity_in_substep(READ(velocities, action.body), action, left, PARAMETERS));
}

// Applies warm starts (with the previous relax pass), forces, damping and grab springs, and updates the split state.
void begin_body(uint i) {
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || is_asleep(READ_WORD(sleep_states, i), PARAMETERS.sleep_steps)) return;
    BodyProperties body = READ(properties, i);
    if (body.motion != MOTION_DYNAMIC || is_foreign(body)) return;
    Gathered sum = gather(i);
    Velocity velocity = integrate_velocity(READ(velocities, i), sum.change, READ(forces, i), body, PARAMETERS);
    for (uint k = 0u; k < PARAMETERS.held; ++k) {
        if (PARAMETERS.grips[k].body == i)
            velocity = pulled(velocity, READ(poses, i), whole_mass(READ(masses, i)), PARAMETERS.grips[k], PARAMETERS);
    }
    WRITE(velocities, i, velocity);
    masses.at[i].shares = pack_shares(sum.weight, sum.passed_on);
}

// Applies the biased pass and integrates the pose by a substep.
void move_body(uint i) {
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || is_asleep(READ_WORD(sleep_states, i), PARAMETERS.sleep_steps)) return;
    BodyProperties body = READ(properties, i);
    if (body.motion == MOTION_FIXED || is_part(body) || is_out_of_play(body.motion) || is_foreign(body)) return;
    Velocity velocity = READ(velocities, i);
    // At rest it keeps every bit: to normalise some quaternions again changes them for ever.
    if (body.motion == MOTION_KINEMATIC && !in_motion(velocity)) return;
    if (body.motion == MOTION_DYNAMIC) {
        Gathered sum = gather(i);
        velocity.linear = velocity.linear + sum.change.linear;
        velocity.angular = velocity.angular + sum.change.angular;
        forces.at[i].impact_weight = sum.weight;
        if (sum.weight > 0.0f) SET_FLOAT(impact_debts, i, sum.passed_on);
    }
    RigidState after = integrate(READ(poses, i), held_velocity(velocity, PARAMETERS), body, PARAMETERS.h);
    bool sound = is_sound(after.pose) && is_sound(after.velocity);
    if (!sound) {
        bounds.at[i].sweep.marks = UNSOUND;
        after = moved_soundly(sound, READ(poses, i), after);
    }
    WRITE(poses, i, after.pose);
    WRITE(velocities, i, after.velocity);
    if (!has_isotropic_inertia(body)) WRITE(masses, i, turned_mass(READ(masses, i), body, after.pose.orientation));
}

#endif
