// Bonds: bodies that cement holds together, until it breaks.
//
// Parallel bonds (Potyondy, Cundall, Int. J. Rock Mech. Min. Sci. 41, 2004): a beam of round section between two bodies resists
// stretch, shear, bending and twist, and breaks where the greatest stress at its edge exceeds a strength. Force and moment
// follow from the present poses against those of the start, so a bond keeps nothing but whether it is broken.
//
// The force of a substep is a spring's and a damper's. The mass of a body is split evenly among its bonds, and none is stiffer
// than the split masses allow in a substep: the projections of all bonds sum to less than twice the mass of a body, so that
// h^2 k + 2 h c < 4 m holds for all together, which is what semi-implicit integration needs. Both bodies feel the force at the
// same point: momentum and angular momentum are exact to rounding.
#ifndef SCREE_PHYSICS_BOND_H
#define SCREE_PHYSICS_BOND_H

#include "shaders/physics/constraint/wrench.h"

LAWS_BEGIN

// Of the split masses, per h^2 and per h: above, twice their sum may reach the limit of stability.
CONSTANT float STIFFEST_BOND = 0.5f;
CONSTANT float MOST_DAMPED_BOND = 0.5f;
// Shear over Young's modulus, for a Poisson's ratio of 1/4; and the twist of a round section over its bending, which is twice
// that.
CONSTANT float SHEAR_OF_BOND = 0.4f;
CONSTANT float TWIST_OF_BOND = 0.8f;
CONSTANT uint BOND_WORDS = 7u;  // change of velocity, of spin, and 1 if the bond holds

struct BondRate {
    float spring, damper;  // N/m and N s/m, or N m and N m s
};
// `ease`: 1 over the split masses; 0: none of the bodies moves.
LAW BondRate rate_of_bond(float stiffness, float ease, float damping, Parameters parameters) {
    bool moves = ease > 1.0e-36f;
    float mass = choose(moves, reciprocal(choose(moves, ease, 1.0f)), 0.0f);
    float most = (STIFFEST_BOND * mass) * (parameters.inverse_h * parameters.inverse_h);
    BondRate rate;
    rate.spring = choose(stiffness > 0.0f, smaller(stiffness, most), most);
    rate.damper =
        smaller((2.0f * damping) * mass * square_root(rate.spring * ease), (MOST_DAMPED_BOND * mass) * parameters.inverse_h);
    return rate;
}

// A bound of the eigenvalues of the inverse inertia (Gershgorin), 1/(kg m^2).
LAW float most_turned(Mass mass) {
    float x = mass.xx + abs(mass.xy) + abs(mass.xz), y = abs(mass.xy) + mass.yy + abs(mass.yz),
          z = abs(mass.xz) + abs(mass.yz) + mass.zz;
    return larger(larger(x, y), z);
}

struct BondPull {
    VelocityPair change;
    float tension, shear;  // greatest stresses, N/m^2
};
LAW BondPull pull_of_bond(Bond bond, Pose pose_a, Pose pose_b, VelocityPair v, Mass a, Mass b, Parameters parameters) {
    vec4 turn_a = compose(pose_a.orientation, bond.frame_a), turn_b = compose(pose_b.orientation, bond.frame_b);
    vec4 turn = compose(turn_b, conjugate(turn_a));
    float twice = choose(turn.w < 0.0f, -2.0f, 2.0f);
    vec3 turned = vec3(turn.x, turn.y, turn.z) * twice;
    vec3 along = axes_of(turn_a).x;
    vec3 arm_a = rotate(pose_a.orientation, bond.arm_a), arm_b = rotate(pose_b.orientation, bond.arm_b);
    vec3 low = vec3(pose_b.low_x - pose_a.low_x, v.b.low_y - v.a.low_y, v.b.low_z - v.a.low_z);
    vec3 gap = ((pose_b.position - pose_a.position) + (arm_b - arm_a)) + low;
    LeverArms arms;
    arms.a = arm_a + gap * 0.5f;
    arms.b = arm_b - gap * 0.5f;
    vec3 speed = velocity_at(arms, v), spin = v.b.angular - v.a.angular;

    float turned_a = bond.bonds_of_a * most_turned(a), turned_b = bond.bonds_of_b * most_turned(b);
    float straight = bond.bonds_of_a * a.inverse_mass + bond.bonds_of_b * b.inverse_mass;
    float length_a = dot3(arms.a, arms.a), length_b = dot3(arms.b, arms.b);
    float way_a = dot3(arms.a, along), way_b = dot3(arms.b, along);
    float ease = straight + (turned_a * positive(length_a - way_a * way_a) + turned_b * positive(length_b - way_b * way_b));
    BondRate stretch = rate_of_bond(bond.stretch, ease, bond.damping, parameters);
    BondRate shear = rate_of_bond(SHEAR_OF_BOND * bond.stretch, straight + (turned_a * length_a + turned_b * length_b),
                                  bond.damping, parameters);
    BondRate bend = rate_of_bond(bond.bend, turned_a + turned_b, bond.damping, parameters);
    BondRate twist = rate_of_bond(TWIST_OF_BOND * bond.bend, turned_a + turned_b, bond.damping, parameters);

    float gap_along = dot3(gap, along), speed_along = dot3(speed, along);
    float turned_along = dot3(turned, along), spin_along = dot3(spin, along);
    // What they exert on A.
    float tension = stretch.spring * gap_along + stretch.damper * speed_along;
    vec3 across = (gap - along * gap_along) * shear.spring + (speed - along * speed_along) * shear.damper;
    float torsion = twist.spring * turned_along + twist.damper * spin_along;
    vec3 bending = (turned - along * turned_along) * bend.spring + (spin - along * spin_along) * bend.damper;

    BondPull pull;
    float per_area = (0.31830989f * bond.inverse_radius) * bond.inverse_radius,
          per_moment = 4.0f * per_area * bond.inverse_radius;
    pull.tension = tension * per_area + length3(bending) * per_moment;
    pull.shear = length3(across) * per_area + abs(torsion) * (0.5f * per_moment);
    Wrench on_b;
    on_b.push = (along * tension + across) * -parameters.h;
    on_b.moment = (along * torsion + bending) * -parameters.h;
    pull.change = changes_by(on_b, arms, a, b);
    pull.change.a.linear = flush_tiny(pull.change.a.linear);  // processors give zeros different signs
    pull.change.a.angular = flush_tiny(pull.change.a.angular);
    pull.change.b.linear = flush_tiny(pull.change.b.linear);
    pull.change.b.angular = flush_tiny(pull.change.b.angular);
    return pull;
}
LAW bool bond_breaks(BondPull pull, Bond bond) {
    return pull.tension > bond.tension || pull.shear > bond.shear;
}

LAWS_END

#endif
