// Couplings of a block of joints: terms, and the impulses that a step begins with. They are the last joints of the block
// (shaders/physics/joint/joint_coupling.h).
#ifndef SCREE_STAGES_COUPLINGS_GLSL
#define SCREE_STAGES_COUPLINGS_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "shaders/physics/joint/joint_coupling.h"

// Drivers unroll loops over terms (at most 8), which took lavapipe a minute to compile.
#define FOR_TERMS(t, count) [[dont_unroll]] for (uint t = 0u; t < (count); ++t)

// A coupling by its record in the table of joints.
uint term_of(uint coupling, uint t) {
    return joints.at[coupling].fill_in_of[t];
}
float factor_of(uint coupling, uint t) {
    return t < 4u ? joints.at[coupling].frame_a[t] : joints.at[coupling].frame_b[t - 4u];
}
uint terms_of(uint coupling) {
    return terms_of_coupling(joints.at[coupling].flags);
}
// Whether neither it nor a joint of it has broken.
bool is_whole(uint coupling) {
    uint count = terms_of(coupling);
    bool whole = joints.at[coupling].broken == 0u && count != 0u;
    FOR_TERMS (t, count) whole = whole && joints.at[joint_of_term(term_of(coupling, t))].broken == 0u;
    return whole;
}
JointAxis coupling_axis(uint coupling) {
    return axis_of_coupling(joints.at[coupling].axes[0], joints.at[coupling].flags);
}
JointRotor no_rotor() {
    JointRotor rotor;
    rotor.inertia = rotor.speed = rotor.impulse = rotor.change = 0.0f;
    return rotor;
}

float speed_of_row(uint joint, uint k);  // as the pass begins

// The row of a coupling, when those of the joints are placed.
void place_coupling(uint coupling) {
    uint count = terms_of(coupling), flags = joints.at[coupling].flags;
    CoupledSum sum;
    sum.coordinate = sum.turns = sum.drift = sum.inverse_effective_mass = 0.0f;
    FOR_TERMS (t, count) {
        uint joint = joint_of_term(term_of(coupling, t)), k = axis_of_term(term_of(coupling, t));
        JointRow row = joints.at[joint].rows[k];
        float turns = turns_of_term(k, row.coordinate, joints.at[joint].twist);
        if ((flags & JOINT_CURVED) != 0u && t + 1u == count) {
            CurvePoint at = point_of_curve(joints.at[coupling].frame_b, with_turns(row.coordinate, turns));
            sum = with_curve(sum, at, row, speed_of_row(joint, k), PARAMETERS.h);
            joints.at[coupling].frame_a[t] = at.slope;
        } else {
            sum = with_term(sum, factor_of(coupling, t), row, turns);
        }
    }
    joints.at[coupling].rows[0] = row_of_coupling(joints.at[coupling].rows[0], sum, joints.at[coupling].anchor_a.x);
}

// The size of the impulse along a joint, with those of the block's couplings.
float with_couplings(float normal_impulse, uint joint, uint first, uint end) {
    uint modes = joints.at[joint].axes[0].mode | joints.at[joint].axes[1].mode | joints.at[joint].axes[2].mode;
    if ((modes & AXIS_COUPLED) == 0u) return normal_impulse;
    for (uint coupling = first; coupling < end; ++coupling) {
        if (!is_whole(coupling)) continue;
        float impulse = row_impulse(joints.at[coupling].rows[0], no_rotor());
        uint count = terms_of(coupling);
        FOR_TERMS (t, count) {
            uint term = term_of(coupling, t);
            if (joint_of_term(term) == joint && is_linear(axis_of_term(term)))
                normal_impulse = with_push(normal_impulse, factor_of(coupling, t), impulse);
        }
    }
    return normal_impulse;
}

#endif
