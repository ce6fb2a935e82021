// Fused substeps: begin_substep, solve_contacts, move_bodies and relax_contacts in turn. push.pass: substeps done
// before, substeps of this dispatch, substeps of the step, 8, 8 and 16 bits.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_FUSED_SOLVER
#include "shaders/stages/lib/fused.glsl"
#include "shaders/stages/lib/pass_bodies.glsl"
#include "shaders/stages/lib/pass_contacts.glsl"

void main() {
    uint bodies = PARAMETERS.bodies, contacts = COUNTED.solver_contacts;
    uint before = push.pass & 0xFFu, count = push.pass >> 8 & 0xFFu, whole = push.pass >> 16;
    for (uint substep = before + 1u; substep <= before + count; ++substep) {
        uint pass = (substep == whole ? PASS_LAST : 0u) | (substep == 1u ? PASS_FIRST : 0u);
        FOR_EACH(i, PARAMETERS.actions) drive_body(i, whole - substep);
        FOR_EACH(i, bodies) begin_body(i);
        end_part();
        FOR_EACH(i, contacts) solve_contact(i);
        end_part();
        FOR_EACH(i, bodies) move_body(i);
        end_part();
        FOR_EACH(i, contacts) relax_contact(i, pass);
        end_part();
    }
}
