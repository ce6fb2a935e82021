// Convex shapes in general: support points, faces, and the features used by clipping.
#ifndef SCREE_PHYSICS_CONVEX_SUPPORT_H
#define SCREE_PHYSICS_CONVEX_SUPPORT_H

#include "shaders/physics/body/sweep.h"
#include "shaders/physics/collide/shape_data.h"

LAWS_BEGIN

// A convex core with a radius around it (spheres and capsules; else 0). Directions and points in world axes, from the
// body's centre.
struct ConvexShape {
    Axes axes;
    vec3 size;      // as in BodyProperties
    uint shape;     // SHAPE_*, but no plane
    HullHead head;  // of a hull its own; of a box vertices and faces; else the number of flat faces
    uint hull;      // index in the table of hulls
    float radius;   // m
    float scale;    // min_half_width, m; of a triangle its largest half extent
};

// ONLY_HULLS removes the code for other shapes.
LAW ConvexShape convex_shape_of(BodyProperties properties, vec4 orientation, Hulls hulls) {
    ConvexShape solid;
    solid.axes = axes_of(orientation);
    solid.size = properties.size;
#ifdef ONLY_HULLS
    solid.shape = SHAPE_HULL;
#else
    solid.shape = properties.shape == SHAPE_TRIANGLE ? SHAPE_HULL : properties.shape;
#endif
    solid.hull = hull_of(properties);
    solid.radius = has_round_core(properties.shape) ? properties.size.x : 0.0f;
    solid.scale = min_half_width(properties);
    if (properties.shape == SHAPE_TRIANGLE) solid.scale = largest_component(properties.size);
    solid.head.vertices = solid.shape == SHAPE_BOX ? 8u : 0u;
    solid.head.faces = flat_faces(solid.shape);
    solid.head.across = 0u;
    solid.head.inner = inner_radius(solid.shape, solid.size);
    if (solid.shape == SHAPE_HULL) solid.head = hull_head(hulls, solid.hull);
    return solid;
}

// A subset of the vertices of a box or a hull, or all.
struct Corners {
    uvec4 list;  // their indices, from the second byte on; unused if `all`
    uint count;
    bool all;
};
// A superset of the vertices that support a direction (body frame) or any within 1.8 degrees of it: a hull's cell lists
// few, so an eighth of the vertices of two hulls of 32 is read.
LAW Corners corners_towards(ConvexShape solid, vec3 local, Hulls hulls) {
    Corners corners;
    corners.list = uvec4(0u);
    corners.count = solid.head.vertices;
    corners.all = true;
    if (solid.head.across > 0u) {
        corners.list = hull_record(hulls, hull_first_cell(solid.hull, solid.head) + 2u * cell_of(local, solid.head.across));
        uint listed = byte_of(corners.list, 0u);
        corners.all = listed == 0u;
        if (listed > 0u) corners.count = listed;
    }
    return corners;
}
LAW uint corner_in(Corners corners, uint k) {
    return corners.all ? k : byte_of(corners.list, k + 1u);
}
// A vertex and how far it lies along a direction, m.
struct Farthest {
    vec3 vertex;
    float reach;
};
LAW Farthest farther(Farthest best, Corners corners, uint k, ConvexShape solid, vec3 local, Hulls hulls) {
    uint last = corners.count - 1u;
    vec3 vertex = hull_vertex(hulls, solid.hull, corner_in(corners, k < last ? k : last));
    float reach = dot3(vertex, local);
    if (reach > best.reach) {
        best.reach = reach;
        best.vertex = vertex;
    }
    return best;
}
// The support vertex of a hull (the first of equals), hull frame. Four in a round, and cells, keep loops short: lavapipe silently
// ends a shader's loops after 65,535 rounds in all, and two fragments that touch through a step took more, one by one.
LAW vec3 farthest_vertex(ConvexShape solid, vec3 local, Hulls hulls) {
    Corners corners = corners_towards(solid, local, hulls);
    Farthest best;
    best.vertex = local;
    best.reach = -1.0e30f;
    for (uint k = 0u; k < corners.count; k += 4u) {
        best = farther(best, corners, k, solid, local, hulls);
        best = farther(best, corners, k + 1u, solid, local, hulls);
        best = farther(best, corners, k + 2u, solid, local, hulls);
        best = farther(best, corners, k + 3u, solid, local, hulls);
    }
    return best.vertex;
}

// Support point of the core (`direction` of any length but 0).
LAW vec3 support_of(ConvexShape solid, vec3 direction, Hulls hulls) {
    if (solid.shape == SHAPE_HULL) return in_world(solid.axes, farthest_vertex(solid, in_body(solid.axes, direction), hulls));
    return support_by_size(solid.shape, solid.size, solid.axes, direction);
}

// The plane of a face: xyz: outward unit normal; w: distance from the centre, m. Faces 2k and 2k + 1 of a box are those
// towards -axis k and +axis k; a cylinder's are those towards -y and +y.
LAW vec4 plane_of(ConvexShape solid, uint face, Hulls hulls) {
    if (solid.shape == SHAPE_HULL) {
        vec4 plane = hull_plane(hulls, solid.hull, solid.head, face);
        vec3 normal = in_world(solid.axes, vec3(plane.x, plane.y, plane.z));
        return vec4(normal.x, normal.y, normal.z, plane.w);
    }
    vec3 axis = solid.axes.y;
    float reach = solid.size.y;
    if (solid.shape == SHAPE_BOX && face < 2u) {
        axis = solid.axes.x;
        reach = solid.size.x;
    }
    if (solid.shape == SHAPE_BOX && face > 3u) {
        axis = solid.axes.z;
        reach = solid.size.z;
    }
    if (solid.shape == SHAPE_CONE) reach = -cone_base(solid.size);
    if ((face & 1u) == 0u) axis = -axis;
    return vec4(axis.x, axis.y, axis.z, reach);
}

// A subset of the faces, or all.
struct Faces {
    uvec4 list;  // their indices, from the third byte on; unused if `all`
    uint count;
    bool all;
    float beyond;  // greatest cosine between the asked direction and the normals of all faces not listed
};
LAW Faces all_faces(ConvexShape solid) {
    Faces faces;
    faces.list = uvec4(0u);
    faces.count = solid.head.faces;
    faces.all = true;
    faces.beyond = -2.0f;
    return faces;
}
// A superset of the faces whose normals are nearest to a direction (body frame).
LAW Faces faces_towards(ConvexShape solid, vec3 local, Hulls hulls) {
    Faces faces = all_faces(solid);
    if (solid.head.across == 0u) return faces;
    faces.list = hull_record(hulls, hull_first_cell(solid.hull, solid.head) + 2u * cell_of(local, solid.head.across) + 1u);
    if (byte_of(faces.list, 0u) == solid.head.faces) return faces;
    faces.count = byte_of(faces.list, 0u);
    faces.all = false;
    faces.beyond = cosine_of(byte_of(faces.list, 1u));
    return faces;
}
LAW uint face_at(Faces faces, uint k) {
    return faces.all ? k : byte_of(faces.list, k + 2u);
}

// The feature that supports a direction: a face, an edge or a point. A face of many corners is reduced to every second,
// or third ... of them, at most MOST_SIDES.
CONSTANT uint MOST_SIDES = 16u;
struct Feature {
    vec3 first;   // of an edge, or the point, m
    uint points;  // 1, 2, or corners of the face
    vec3 second;  // of an edge, m; of a disc the unit vector from its centre to the first corner
    uint face;
    uint stride;        // index step between corners
    uint first_corner;  // of a hull's face, index into the hull's list
};
LAW Feature line_between(vec3 first, vec3 second) {
    Feature feature;
    feature.first = first;
    feature.second = second;
    feature.points = 2u;
    feature.face = 0u;
    feature.stride = 1u;
    feature.first_corner = 0u;
    return feature;
}
LAW Feature point_at(vec3 point) {
    Feature feature = line_between(point, point);
    feature.points = 1u;
    return feature;
}
// The corners of a disc begin at its support point, so that a rim rolls on its lowest point; if the disc leans by less
// than this (sine, squared: 1.1 degrees), they are fixed to the body.
CONSTANT float FLAT_SQUARED = 0.0004f;
LAW Feature face_as_feature(ConvexShape solid, uint face, vec3 direction, Hulls hulls) {
    Feature feature = line_between(solid.axes.y, solid.axes.x);
    feature.face = face;
    feature.points = 4u;
    if (solid.shape == SHAPE_HULL) {
        uvec4 corners = hull_face(hulls, solid.hull, solid.head, face);
        feature.first_corner = corners.x;
        for (uint k = 0u; k < 4u; ++k)
            if (corners.y > MOST_SIDES * feature.stride) feature.stride = feature.stride + 1u;
        feature.points = 0u;
        for (uint k = 0u; k < corners.y; k += feature.stride) feature.points = feature.points + 1u;
    } else if (solid.shape != SHAPE_BOX) {
        feature.points = MOST_SIDES;
        vec3 across = direction - solid.axes.y * dot3(solid.axes.y, direction);
        if (dot3(across, across) > FLAT_SQUARED * dot3(direction, direction)) feature.second = unit3(across, solid.axes.x);
    }
    return feature;
}

// `from` rotated towards `quarter` by k sixteenths of a turn.
LAW vec3 sixteenth(uint k, vec3 from, vec3 quarter) {
    uint eighth = k & 3u;
    float along = eighth == 0u ? 1.0f : (eighth == 1u ? 0.92387953f : (eighth == 2u ? 0.70710678f : 0.38268343f));
    float across = eighth == 1u ? 0.38268343f : (eighth == 2u ? 0.70710678f : 0.92387953f);
    vec3 v = eighth == 0u ? from : from * along + quarter * across;
    vec3 w = eighth == 0u ? quarter : quarter * along - from * across;
    if (k >= 12u) return -w;
    if (k >= 8u) return -v;
    return k >= 4u ? w : v;
}
// Corner k, counter-clockwise seen from outside.
LAW vec3 corner_of(ConvexShape solid, Feature feature, uint k, Hulls hulls) {
    if (feature.points <= 2u) return k == 0u ? feature.first : feature.second;
    if (solid.shape == SHAPE_HULL)
        return in_world(solid.axes, hull_corner(hulls, solid.hull, solid.head, feature.first_corner + k * feature.stride));
    vec4 plane = plane_of(solid, feature.face, hulls);
    vec3 normal = vec3(plane.x, plane.y, plane.z);
    if (solid.shape == SHAPE_BOX) {
        vec3 e = feature.face < 2u ? solid.axes.y * solid.size.y : solid.axes.x * solid.size.x;
        vec3 f = feature.face > 3u ? solid.axes.y * solid.size.y : solid.axes.z * solid.size.z;
        if (dot3(cross3(e, f), normal) < 0.0f) f = -f;
        vec3 side = k == 0u || k == 3u ? e : -e;
        return (normal * plane.w + side) + (k < 2u ? f : -f);
    }
    return normal * plane.w + sixteenth(k * feature.stride, feature.second, cross3(normal, feature.second)) * solid.size.x;
}

LAWS_END

#endif
