// Ends a step: applies the last relax pass, updates sleep, and limits the sweep of fast bodies to the bounds in which
// the broadphase searched.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/continuous/clamping.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/gather.glsl"

float quiet_in(uint slot) {
    return slots.at[slot].weight > 0.0f ? uintBitsToFloat(READ_WORD(neighbours_quiet, slot)) : FOREVER;
}
// Of the active contacts' and joints' other bodies, the least quiet steps.
float least_quiet_beside(uint body) {
    float quiet = FOREVER;
    uint k = first_slot_of(body), last = READ_WORD(slot_ends, body);
    if (k >= last) return quiet;
    do {  // as in gather()
        quiet = smaller(smaller(quiet_in(k), quiet_in(min(k + 1u, last - 1u))), quiet);
        k += 2u;
    } while (k < last);
    return quiet;
}

void main() {
    uint i = thread();
    if (COUNTED.overflow != 0u) return;
    if (i == 0u) ++COUNTS.steps;
    if (i >= PARAMETERS.bodies || is_asleep(WORD(sleep_states, i), PARAMETERS.sleep_steps)) return;
    BodyProperties body = READ(properties, i);
    if (body.motion != MOTION_DYNAMIC || is_foreign(body)) return;
    Gathered sum = gather(i);
    Velocity velocity = READ(velocities, i);
    velocity.linear = flush_tiny(velocity.linear + sum.change.linear);
    velocity.angular = flush_tiny(velocity.angular + sum.change.angular);
    bool limited = is_spin_limited(velocity, PARAMETERS);
    velocity = held_velocity(velocity, PARAMETERS);
    bool moved = bounds.at[i].sweep.marks != UNSOUND;
    if (!moved || !is_sound(velocity)) {
        properties.at[i].motion = MOTION_QUARANTINED;
        masses.at[i].shares = moved ? AFTER_STEP : AFTER_MOVE;
        WRITE(velocities, i, Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f));
        WORD(sleep_states, i) = 0u;
        atomicAdd(COUNTS.quarantined, 1u);
        return;
    }
    if (limited) atomicAdd(COUNTS.spin_limited, 1u);
    float pace = pace_of(body, velocity, PARAMETERS);
    WORD(sleep_states, i) =
        sleep_state_after(WORD(sleep_states, i), pace, sum.weight, least_quiet_beside(i), PARAMETERS.sleep_steps);
    if (is_asleep(WORD(sleep_states, i), PARAMETERS.sleep_steps)) {
        velocity.linear = vec3(0.0f);
        velocity.angular = vec3(0.0f);
    }
    WRITE(velocities, i, velocity);
    Sweep sweep = bounds.at[i].sweep;
    if (!was_fast(body, sweep, READ(poses, i))) return;
    bounds.at[i].sweep = stopped_at(sweep, seen_part(body, sweep, READ(poses, i), bounds.at[i]));
    atomicOr(COUNTS.fast, 1u);
    atomicMax(COUNTS.arguments[WORK_CCD_PAIRS].x, COUNTS.arguments[WORK_PAIRS].x);
    atomicMax(COUNTS.arguments[WORK_CCD_PAIRS].y, COUNTS.arguments[WORK_PAIRS].y);
    atomicMax(COUNTS.arguments[WORK_CCD_PAIRS].w, COUNTS.arguments[WORK_PAIRS].w);
}
