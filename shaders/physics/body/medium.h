// Fields: air and wind, a plane of water, attractors. They act on dynamic bodies that are awake, from their velocities and
// poses as the step begins.
#ifndef SCREE_PHYSICS_MEDIUM_H
#define SCREE_PHYSICS_MEDIUM_H

#include "shaders/physics/base/inertia.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/body/motion.h"

LAWS_BEGIN

// The submerged part of a body: of its volume, and its centre from the centre of mass, world axes, m.
struct Submerged {
    vec3 centre;
    float part;
};

// Of an ellipsoid, exactly: scaled to a ball, of which a plane at a distance s of its radius above the centre cuts off a
// cap. `up`: the water's normal in body axes; `depth`: of the volume's centre, m. The centre is in body axes.
LAW Submerged submerged_ellipsoid(vec3 radii, vec3 up, float depth) {
    vec3 scaled = vec3(radii.x * up.x, radii.y * up.y, radii.z * up.z);
    float reach = larger(length3(scaled), 1.0e-12f);
    float s = clamped(depth * reciprocal(reach), -1.0f, 1.0f);
    Submerged found;
    found.part = 0.25f * (1.0f + s) * (1.0f + s) * (2.0f - s);
    // The cap's centre of mass: 3 (1 - s)^2 / (4 (2 - s)) of the radius below the centre.
    float low = 0.75f * (1.0f - s) * (1.0f - s) * reciprocal(2.0f - s);
    vec3 along = scaled * (low * reciprocal(reach));
    found.centre = -vec3(radii.x * along.x, radii.y * along.y, radii.z * along.z);
    return found;
}

// Of a box, by its eight octants. Upright in any of its positions volume, buoyancy and its moments are exact: columns lie at
// the two points of Gauss' rule, across the water's normal at 1/sqrt(3), along it at 1/2 of the size extents.
LAW Submerged submerged_box(vec3 size, vec3 up, float depth) {
    vec3 along = vec3(up.x * up.x, up.y * up.y, up.z * up.z);
    vec3 point = vec3(size.x * (0.57735027f - 0.07735027f * along.x), size.y * (0.57735027f - 0.07735027f * along.y),
                      size.z * (0.57735027f - 0.07735027f * along.z));
    float reach = 0.5f * (size.x * along.x + size.y * along.y + size.z * along.z);
    float ramp = 0.5f * reciprocal(larger(reach, 1.0e-12f));
    Submerged found;
    found.part = 0.0f;
    found.centre = vec3(0.0f);
    for (uint k = 0u; k < 8u; ++k) {
        vec3 at =
            vec3((k & 1u) != 0u ? point.x : -point.x, (k & 2u) != 0u ? point.y : -point.y, (k & 4u) != 0u ? point.z : -point.z);
        float part = 0.125f * clamped(0.5f + (depth - dot3(at, up)) * ramp, 0.0f, 1.0f);
        found.part = found.part + part;
        found.centre = found.centre + at * part;
    }
    found.centre = found.centre * reciprocal(larger(found.part, 1.0e-12f));
    return found;
}

LAW Submerged submerged(Immersion body, Pose pose, Parameters parameters) {
    vec3 up = rotate_back(pose.orientation, parameters.water_normal);
    vec3 centre = rotate(pose.orientation, body.centre);
    float depth = parameters.water_offset - dot3(parameters.water_normal, pose.position + centre);
    Submerged found =
        body.is_round != 0u ? submerged_ellipsoid(body.half_extents, up, depth) : submerged_box(body.half_extents, up, depth);
    found.centre = centre + rotate(pose.orientation, found.centre);
    return found;
}

// Area that a body shows to a flow in a direction (unit, body axes), m^2.
LAW float area_against(Immersion body, vec3 direction) {
    vec3 h = body.half_extents, d = absolute3(direction);
    if (body.is_round != 0u) {  // of an ellipsoid: pi a b c |(d.x / a, d.y / b, d.z / c)|
        vec3 sides = vec3(d.x * h.y * h.z, d.y * h.x * h.z, d.z * h.x * h.y);
        return 3.1415927f * length3(sides);
    }
    return 4.0f * (d.x * h.y * h.z + d.y * h.x * h.z + d.z * h.x * h.y);
}

LAW Immersion no_immersion() {
    Immersion dry;
    dry.half_extents = vec3(0.0f);
    dry.volume = 0.0f;
    dry.centre = vec3(0.0f);
    dry.drag = 0.0f;
    dry.is_round = 0u;
    dry.pad0 = 0u;
    dry.pad1 = 0u;
    dry.pad2 = 0u;
    return dry;
}

// Accelerations by fields, added to those of the step. Drag is quadratic and semi-implicit, a = k |u| u / (1 + k |u| dt), so
// it never turns a velocity round; so is the damping in water. A body that is pushed through water moves half its volume of
// water along (added mass of a ball): light bodies would leap otherwise.
//
// Forces are those half a step ahead. At the start of the step they would feed every oscillation, a floating body's by a
// quarter of w^2 dt each second; there the map from step to step keeps its area, and orbits and oscillations their size.
LAW BodyForces with_fields(BodyForces load, BodyProperties properties, Immersion body, Pose pose, Velocity velocity, Mass mass,
                           Parameters parameters) {
    pose.position = pose.position + velocity.linear * (0.5f * parameters.dt);
    pose.orientation = turned(pose.orientation, velocity.angular, 0.5f * parameters.dt);
    vec3 added = vec3(0.0f);
    for (uint k = 0u; k < MOST_ATTRACTORS; ++k) {
        if (k >= parameters.attractors) break;
        vec3 way = xyz(parameters.attractor[k]) - pose.position;
        float far = inverse_square_root(dot3(way, way) + parameters.attractor_radius * parameters.attractor_radius);
        added = added + way * (parameters.attractor[k].w * properties.gravity_scale * (far * far * far));
    }
    Submerged under;
    under.part = 0.0f;
    under.centre = vec3(0.0f);
    if (parameters.water_density > 0.0f) under = submerged(body, pose, parameters);
    float wet = under.part;
    // Drag of air and of water, each by the part of the body in it.
    vec3 gain = vec3(0.0f);
    for (uint k = 0u; k < 2u; ++k) {
        bool water = k == 1u;
        float density = water ? parameters.water_density * wet : parameters.air_density * (1.0f - wet);
        vec3 flow = (water ? parameters.water_velocity : parameters.wind) - velocity.linear;
        float speed = length3(flow);
        if (!(density * body.drag * speed > 0.0f)) continue;
        float area = area_against(body, rotate_back(pose.orientation, flow * reciprocal(speed)));
        float rate = 0.5f * density * body.drag * area * properties.inverse_mass * speed;
        gain = gain + flow * (rate * reciprocal(1.0f + rate * parameters.dt));
    }
    added = added + gain;
    if (wet > 0.0f) {
        float displaced = parameters.water_density * body.volume * wet;  // kg
        vec3 lift = parameters.gravity * -displaced;
        float heavier = reciprocal(1.0f + 0.5f * displaced * properties.inverse_mass);
        // In proportion to the displaced mass: bodies that float are damped alike, light or heavy.
        float rate = parameters.water_damping * displaced * properties.inverse_mass;
        float damping = rate * reciprocal(1.0f + rate * parameters.dt);
        added = added + (parameters.water_velocity - velocity.linear) * damping;
        load.acceleration = (load.acceleration + added + lift * properties.inverse_mass) * heavier;
        load.angular_acceleration =
            load.angular_acceleration + turned_by(mass, cross3(under.centre, lift)) - velocity.angular * damping;
        return load;
    }
    load.acceleration = load.acceleration + added;
    return load;
}

LAWS_END

#endif
