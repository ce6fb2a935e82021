// Scales of a body and of a pair: half widths, widths along a contact plane, the speculative distance, the anchor body.
#ifndef SCREE_PHYSICS_BODY_SCALE_H
#define SCREE_PHYSICS_BODY_SCALE_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/body/compound.h"

LAWS_BEGIN

LAW float min_half_width(BodyProperties properties) {
    return min_half_width(properties.shape, properties.size);
}

// Radius of a ball about the centre that holds the body, m. That of a hull is at most a sixteenth of its box's diagonal more than
// its farthest vertex.
LAW float bounding_radius(BodyProperties properties) {
    uint nearer = (properties.flags >> ROW_REACH_SHIFT) & ROW_REACH_MOST;
    return bounding_radius(properties.shape, properties.size) *
           uintBitsToFloat(0x3F800000u - (nearer << 20u));  // 1 - nearer / 16
}

// Round bodies: in the contact of two, point and normal follow both; other points stay with one body (stays_with_b).
LAW bool is_round(BodyProperties properties) {
    return has_round_core(properties.shape);
}
LAW bool rolls(BodyProperties properties) {
    return can_roll(properties.shape);
}
LAW bool is_disc(BodyProperties properties) {
    return properties.shape == SHAPE_CYLINDER || properties.shape == SHAPE_CONE;
}

// Half width of a box or cylinder whose half extents or radii are `size` along the plane with that normal, m.
LAW float width_across(vec3 size, vec4 orientation, vec3 normal) {
    vec3 slant = absolute3(rotate_back(orientation, normal));
    float without_x = smaller(size.y, size.z), without_y = smaller(size.x, size.z), without_z = smaller(size.x, size.y);
    return choose(slant.x >= slant.y && slant.x >= slant.z, without_x, choose(slant.y >= slant.z, without_y, without_z));
}
// Half width of the face that the body turns to a contact with that normal, m. A coin's is its radius, not its thickness.
LAW float face_half_width(BodyProperties properties, vec4 orientation, vec3 normal) {
    bool is_hull = properties.shape == SHAPE_HULL, has_axis = is_disc(properties);
    bool has_faces = (properties.shape == SHAPE_BOX || is_hull || has_axis) && !is_part(properties);
    float width = min_half_width(properties);
    if (none(has_faces)) return width;
    vec3 size = choose(is_hull, properties.size * 0.5f, properties.size);
    size.z = choose(has_axis, size.x, size.z);
    return choose(has_faces, width_across(size, orientation, normal), width);
}

// The anchor body of a contact: the one that rolls, or the thinner one. A ball rolls on, a small box slides over a
// large one, and the contact goes with it.
LAW bool stays_with_b(BodyProperties a, BodyProperties b) {
    bool rolls_a = rolls(a), rolls_b = rolls(b), is_thinner = min_half_width(b) < min_half_width(a);
    return (rolls_b && !rolls_a) || ((rolls_b || !rolls_a) && is_thinner);
}

// Speculative distance relative to min_half_width: a box of 1 m has the default of Settings::speculative_distance, its
// upper bound. With 2 cm for every size, a heap of 1 cm had ten times the contacts of one of 1 m, most of them between
// bodies that never touch.
CONSTANT float SPECULATIVE_PART = 0.04f;

LAW float speculative_of(BodyProperties properties, Parameters parameters) {
    return smaller(parameters.speculative, SPECULATIVE_PART * min_half_width(properties));
}
LAW float speculative_of(BodyProperties a, BodyProperties b, Parameters parameters) {
    return smaller(speculative_of(a, parameters), speculative_of(b, parameters));
}

LAWS_END

#endif
