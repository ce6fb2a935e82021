// Records of bonds between bodies.
#ifndef SCREE_PHYSICS_BOND_RECORDS_H
#define SCREE_PHYSICS_BOND_RECORDS_H

#include "shaders/physics/base/body_records.h"

LAWS_BEGIN

// A bond of two bodies (shaders/physics/bond/bond.h): constant, but for the rows of its bodies.
struct Bond {
    vec3 arm_a;  // from the centre of mass to the bond, body axes, m
    uint a;      // row
    vec3 arm_b;
    uint b;
    vec4 frame_a;          // unit quaternion, bond to body; x along the bond
    vec4 frame_b;          // likewise
    float stretch;         // stiffness along the bond, N/m; 0: as much as the substep allows
    float bend;            // stiffness of bending, N m; 0 likewise
    float damping;         // ratio
    float inverse_radius;  // 1/m
    float tension;         // strength, N/m^2
    float shear;           // strength, N/m^2
    uint place_a;          // of its change of A's velocity among those of the bonds of all bodies
    uint place_b;
    float bonds_of_a;  // of that body, broken ones included
    float bonds_of_b;
    float pad0, pad1;
};

LAWS_END

#endif
