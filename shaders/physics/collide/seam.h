// Seams of compounds: contacts with surfaces that one part of a compound hides from the other bodies.
//
// Where parts touch or overlap, the faces between them are inside the body, and their edges lie in flat surfaces. What slides
// over such an edge would trip: it lies a little deep in the one part, and meets the side of the next. So a contact point on a
// part is dropped if a neighbour, which holds the point, rises over the plane of the contact, and no place of the part's surface
// beside the point is free of neighbours. The neighbour has a contact of its own there. (At a corner between floor and wall the
// floor is free before the wall. For meshes, triangle.h has the limits of edges.)
//
// A part's record in the table of shape data: a head (solids, tolerance in m as float); then solids: itself and each neighbour. A
// solid is a head (planes, vertices), its planes (outward unit normal, distance from the centre, m), and its vertices (m), all in
// the part's frame.
#ifndef SCREE_PHYSICS_SEAM_H
#define SCREE_PHYSICS_SEAM_H

#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/collide/manifold.h"
#include "shaders/physics/collide/shape_data.h"

LAWS_BEGIN

// The tolerance within which parts touch, relative to the least min_half_width of a part and its neighbours.
CONSTANT float SEAM_WIDTH = 0.02f;
// Squared sine of the angle (1.1 degrees) by which a neighbour may rise over the plane of a contact: seams that are nearly flat.
CONSTANT float RISE_SQUARED = 0.0004f;
CONSTANT float SAME_FACE = 0.9998f;  // cosine of the same angle: a normal is that of a face
// Distance of the places beside a point, in tolerances.
CONSTANT float BESIDE = 4.0f;
// What is pressed in deeper keeps its contact, relative to the smaller min_half_width: axes of least penetration of two parts may
// lead from each into the other, and without both contacts what is between them would go through the surface.
CONSTANT float UNDER_FACE = 0.05f;

struct Solid {
    uint planes;
    uint vertices;
    uint first;  // of its planes, in the table
};
LAW Solid solid_at(Hulls hulls, uint place) {
    uvec4 head = hull_record(hulls, place);
    Solid solid;
    solid.planes = head.x;
    solid.vertices = head.y;
    solid.first = place + 1u;
    return solid;
}
LAW uint place_behind(Solid solid) {
    return solid.first + solid.planes + solid.vertices;
}
// Quads of a part's record.
LAW uint quads_of_seams(Hulls hulls, uint seams) {
    uint solids = hull_record(hulls, seams).x, place = seams + 1u;
    for (uint k = 0u; k < solids; ++k) place = place_behind(solid_at(hulls, place));
    return place - seams;
}

// A contact point, and eight places round it in the plane of the contact. Sets of them are bits: 1 the point; 2 to 16 the places
// ahead, diagonally, aside and diagonally back; 32 to 256 those opposite. All at once, so that a thread's loops stay below
// lavapipe's 65,535 rounds: for each of four points and two bodies 32 neighbours, of at most 128 planes and 64 vertices.
struct Places {
    vec3 point;
    vec3 normal;  // of the contact, unit, outward
    vec3 ahead;   // `away` along a tangent, m
    vec3 aside;   // and across
    float away;   // m
};
CONSTANT uint ALL_PLACES = 511u;
LAW Places places_round(vec3 point, vec3 normal, float away) {
    Places at;
    at.point = point;
    at.normal = normal;
    at.ahead = tangent(normal) * away;
    at.aside = cross3(normal, at.ahead);
    at.away = away;
    return at;
}
// How far the four places of bits 2 to 16 lie from the point along a direction, m.
LAW vec4 aways_along(Places at, vec3 direction) {
    float x = dot3(direction, at.ahead), y = dot3(direction, at.aside);
    return vec4(x, 0.70710678f * (x + y), y, 0.70710678f * (y - x));
}
// The places where a value is at most `most`: `round_it + change` at those of bits 2 to 16, `round_it - change` opposite.
LAW uint places_within(float at_point, float round_it, vec4 change, float most) {
    uint within = at_point <= most ? 1u : 0u;
    within |= round_it + change.x <= most ? 2u : 0u;
    within |= round_it + change.y <= most ? 4u : 0u;
    within |= round_it + change.z <= most ? 8u : 0u;
    within |= round_it + change.w <= most ? 16u : 0u;
    within |= round_it - change.x <= most ? 32u : 0u;
    within |= round_it - change.y <= most ? 64u : 0u;
    within |= round_it - change.z <= most ? 128u : 0u;
    within |= round_it - change.w <= most ? 256u : 0u;
    return within;
}
// Those in a solid, or within `room` (m) of it.
LAW uint places_in(Hulls hulls, Solid solid, Places at, uint among, float room) {
    uint held = among;
    for (uint k = 0u; k < solid.planes && held != 0u; ++k) {
        uvec4 plane = hull_record(hulls, solid.first + k);
        float height = dot3(point_in(plane), at.point) - uintBitsToFloat(plane.w);
        held &= places_within(height, height, aways_along(at, point_in(plane)), room);
    }
    return held;
}
// Those over whose plane a solid rises.
LAW uint places_under(Hulls hulls, Solid solid, Places at, uint among, float room) {
    uint under = 0u;
    for (uint k = 0u; k < solid.vertices && under != among; ++k) {
        vec3 way = point_in(hull_record(hulls, solid.first + solid.planes + k)) - at.point;
        float height = dot3(way, at.normal) - room, squared = RISE_SQUARED * dot3(way, way);
        vec4 nearer = aways_along(at, way * RISE_SQUARED);  // half of it
        uint risen = places_within(squared, squared + RISE_SQUARED * (at.away * at.away), -(nearer + nearer), height * height);
        under |= height > 0.0f ? among & risen : 0u;
    }
    return under;
}
// Whether it is the normal of a face.
LAW bool has_face(Hulls hulls, Solid solid, vec3 normal) {
    bool has = false;
    for (uint k = 0u; k < solid.planes && !has; ++k)
        has = dot3(point_in(hull_record(hulls, solid.first + k)), normal) > SAME_FACE;
    return has;
}
// Whether a contact point on the surface of a part, with the outward unit normal of the contact, is hidden: a neighbour covers
// it, that holds it and rises over the plane of the contact, and so are the places of the face that lie beside it, if it is on a
// face. In the part's frame.
LAW bool is_hidden(Hulls hulls, uint seams, vec3 point, vec3 normal) {
    uvec4 head = hull_record(hulls, seams);
    float room = uintBitsToFloat(head.y);
    Solid own = solid_at(hulls, seams + 1u);
    Places at = places_round(point, normal, BESIDE * room);
    uint covered = 0u, place = place_behind(own);
    for (uint k = 1u; k < head.x && covered != ALL_PLACES; ++k) {
        Solid solid = solid_at(hulls, place);
        uint held = places_in(hulls, solid, at, ALL_PLACES & ~covered, room);
        covered |= places_under(hulls, solid, at, held, room);
        place = place_behind(solid);
    }
    bool covers = (covered & 1u) != 0u;
    uint shown = covers ? ALL_PLACES & ~covered : 0u;
    if (shown != 0u) shown = has_face(hulls, own, normal) ? places_in(hulls, own, at, shown, 0.25f * room) : 0u;
    return covers && shown == 0u;
}

// A manifold of A and B without the points that are hidden on a part of one of them, A if `outward` is 1, B if it is -1. The
// points are from that part's centre. `deepest`: what is pressed in further keeps its contact, m (a depth, < 0).
LAW ManifoldBuffer without_hidden(ManifoldBuffer touch, uint seams, vec4 orientation, float outward, float deepest, Hulls hulls) {
    ManifoldBuffer left = manifold_along(touch.manifold.normal);
    vec3 normal = rotate_back(orientation, touch.manifold.normal * outward);
    for (int k = 0; k < 4; ++k) {
        vec4 point = touch.manifold.points[k];
        vec3 place = rotate_back(orientation, xyz(point)) - normal * (0.5f * point.w);
        bool there = uint(k) < touch.count;
        bool stays = there && (point.w < deepest || !is_hidden(hulls, seams, place, normal));
        left = with_point(stays, left, xyz(point), point.w, feature_at(touch, k), 1.0e30f);
    }
    return left;
}

// What remains of the manifold of (A, B), from A's centre. Seams: as in PoseInBody; 0: a body, or a part without neighbours.
LAW ManifoldBuffer shown_manifold(ManifoldBuffer touch, BodyProperties ta, Pose pose_a, uint seams_a, BodyProperties tb,
                                  Pose pose_b, uint seams_b, Hulls hulls) {
    float deepest = -(UNDER_FACE * smaller(min_half_width(ta), min_half_width(tb)));
    for (uint side = 0u; side < 2u; ++side) {
        uint seams = side == 0u ? seams_a : seams_b;
        if (seams == 0u) continue;
        vec3 offset = side == 0u ? vec3(0.0f) : pose_b.position - pose_a.position;
        touch = without_hidden(seen_from(true, touch, offset), seams - 1u, side == 0u ? pose_a.orientation : pose_b.orientation,
                               side == 0u ? 1.0f : -1.0f, deepest, hulls);
        touch = seen_from(true, touch, -offset);
    }
    return touch;
}

LAWS_END

#endif
