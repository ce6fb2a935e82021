// Broadphase: swept AABB and grid cell of each body, whether it is active or will be fast, and its world inertia.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/copies.glsl"

// Skips the atomic where the bits are set already: most bodies add nothing, and a contended atomic is slow.
#define note(mask, bits)                                     \
    {                                                        \
        if ((mask & (bits)) != (bits)) atomicOr(mask, bits); \
    }

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies) return;
    BodyProperties body = READ(properties, i);
    Pose pose = READ(poses, i);
    if (is_absent(body.motion) || (GHOSTS && (body.flags & ROW_ELSEWHERE) != 0u)) {
        WRITE(bounds, i, no_bounds(pose));
        return;
    }
    uint owner = body_of(i);
    if (is_quarantined(owner == i ? body.motion : READ(properties, owner).motion)) {
        WRITE(bounds, i, no_bounds(pose));
        float mark = masses.at[i].shares;
        if (mark < 0.0f) masses.at[i].shares = quarantine_code(mark, COUNTS.steps);
        return;
    }
    float bend = is_part(body) ? bend_of_way(part_in(i), READ(velocities, i), PARAMETERS) : 0.0f;
    Bounds around = no_bounds(pose);
    if (!is_apart(body)) around = bounds_of(body, bend, pose, READ(velocities, i), READ(forces, owner), PARAMETERS);
    if (will_sweep(body, READ(velocities, i), PARAMETERS)) note(COUNTS.fast, 1u);
    if (owner == i) {
        WRITE(masses, i, turned_mass(masses.at[i], body, pose.orientation));
    } else {
        WRITE(masses, i, BodyMass(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f));
    }
    bool listed = !is_large(body) && (around.level & NOT_IN_GRID) == 0u;
    if (listed) note(COUNTS.levels, 1u << around.level);
    if (has_slept(READ_WORD(sleep_states, i), PARAMETERS.sleep_steps)) note(COUNTS.sleepers, 1u);
    if (stirs(motion_of(body), READ(velocities, owner), READ_WORD(sleep_states, owner), PARAMETERS.sleep_steps)) {
        if (listed) note(COUNTS.levels_stirring, 1u << around.level);
        if (!listed) note(COUNTS.large_stirring, is_large(body) ? 1u : 2u);
        if (COPIES) note(WORD(copy_states, copy_of(owner)), COPY_STIRS);
    } else {
        around.level |= INACTIVE;
    }
    if (COPIES && around.bucket != NONE) around = of_copy(around, copy_of(owner), PARAMETERS);
    if (around.bucket != NONE) atomicAdd(WORD(cell_counts, around.bucket), 1u);
    WRITE(bounds, i, around);
}
