// The biased pass over all joint blocks in parallel.
// variants: solve_joints
// variants: solve_joints.small -DSCREE_SMALL_BLOCKS
// variants: solve_joints.singly -DSCREE_SMALL_BLOCKS -DSCREE_SINGLY
// variants: solve_joints.coupled -DSCREE_COUPLED
// variants: solve_joints.coupled_singly -DSCREE_COUPLED -DSCREE_SINGLY
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact_solver.h"

#define BIASED true
#include "shaders/stages/lib/pass_joints.glsl"

// Commits the impulses and writes the bodies' velocity changes.
void end_pass() {
    FOR_LANES(j, block_joints) {
        pushing[j] = 0u;
        if (holds(j)) commit(j, false);
    }
    end_part();
#ifdef SCREE_COUPLED
    if (leads()) pass_on_impulses();
    end_part();
#endif
    push_bodies(FROM_REST);
    write_deltas(0.0f, false);
}
