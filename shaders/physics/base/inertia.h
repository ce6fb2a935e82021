// The world inverse inertia tensor, and its product with a vector.
#ifndef SCREE_PHYSICS_INERTIA_H
#define SCREE_PHYSICS_INERTIA_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

// Spheres, cubes, and bodies that contacts do not turn (inverse inertia 0).
LAW bool has_isotropic_inertia(BodyProperties properties) {
    return properties.inverse_inertia.x == properties.inverse_inertia.y &&
           properties.inverse_inertia.x == properties.inverse_inertia.z;
}

// R diag(i) R^T, the tensor with principal values i in the axes R.
LAW Mass tensor_in_world(Axes axes, vec3 i) {
    vec3 x = axes.x * i.x, y = axes.y * i.y, z = axes.z * i.z;
    Mass tensor;
    tensor.xx = (x.x * axes.x.x + y.x * axes.y.x) + z.x * axes.z.x;
    tensor.xy = (x.x * axes.x.y + y.x * axes.y.y) + z.x * axes.z.y;
    tensor.xz = (x.x * axes.x.z + y.x * axes.y.z) + z.x * axes.z.z;
    tensor.yy = (x.y * axes.x.y + y.y * axes.y.y) + z.y * axes.z.y;
    tensor.yz = (x.y * axes.x.z + y.y * axes.y.z) + z.y * axes.z.z;
    tensor.zz = (x.z * axes.x.z + y.z * axes.y.z) + z.z * axes.z.z;
    tensor.inverse_mass = 0.0f;
    tensor.split = 1.0f;
    return tensor;
}
// I^-1 v for the inverse inertia in `tensor`.
LAW vec3 turned_by(Mass tensor, vec3 v) {
    return vec3((tensor.xx * v.x + tensor.xy * v.y) + tensor.xz * v.z, (tensor.xy * v.x + tensor.yy * v.y) + tensor.yz * v.z,
                (tensor.xz * v.x + tensor.yz * v.y) + tensor.zz * v.z);
}

// The mass of a body that is not split, and the table's record of a mass.
LAW Mass whole_mass(BodyMass body) {
    Mass mass;
    mass.xx = body.xx;
    mass.xy = body.xy;
    mass.xz = body.xz;
    mass.yy = body.yy;
    mass.yz = body.yz;
    mass.zz = body.zz;
    mass.inverse_mass = body.inverse_mass;
    mass.split = 1.0f;
    return mass;
}
LAW BodyMass body_mass(Mass mass, float shares) {
    BodyMass body;
    body.xx = mass.xx;
    body.xy = mass.xy;
    body.xz = mass.xz;
    body.yy = mass.yy;
    body.yz = mass.yz;
    body.zz = mass.zz;
    body.inverse_mass = mass.inverse_mass;
    body.shares = shares;
    return body;
}

LAWS_END

#endif
