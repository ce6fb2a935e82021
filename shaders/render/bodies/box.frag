// Boxes: flat faces with normals of rounded edges, so that highlights show the orientation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 own;
layout(location = 2) flat in vec4 size_axis;
layout(location = 3) flat in vec4 turn;
layout(location = 4) flat in vec4 color;
layout(location = 0) out vec4 out_color;

void main() {
    vec3 d = sight_to(point);
    float pixel = pixel_at(point);
    vec3 size = size_axis.xyz;
    float smallest = min(size.x, min(size.y, size.z));
    float natural = min(0.14 * smallest, 0.06);  // m; narrow on large bodies
    float bevel = min(max(natural, 1.2 * pixel), 0.5 * smallest);
    // Edges narrower than a pixel or two would be dotted lines, so they fade.
    float shown = clamp(natural / (1.8 * pixel), 0.0, 1.0);
    shown *= shown;
    // Normal of a box with edges rounded by `bevel`, evaluated on the flat face.
    vec3 over = max(abs(own) - (size - bevel), 0.0) * sign(own);
    // The face with the largest signed distance. At an edge either will do, since the normals are equal.
    vec3 out_by = abs(own) - size;
    int axis = out_by.x > out_by.y ? (out_by.x > out_by.z ? 0 : 2) : (out_by.y > out_by.z ? 1 : 2);
    vec3 face = vec3(0);
    face[axis] = sign(own[axis]);
    vec3 rounded = over - face * dot(over, face) + face * bevel;
    vec3 normal = turned(turn, normalize(mix(face, normalize(rounded), shown)));
    float edge = shown * clamp(length(over - face * dot(over, face)) / bevel, 0.0, 1.0);
    // Lighter edges, and a tone per axis that distinguishes faces in the shade.
    float tone = (axis == 1 ? 1.0 : (axis == 0 ? 0.95 : 0.90)) * (1.0 + 0.22 * edge * edge);
    vec3 inside = size - abs(own);
    float border = axis == 0 ? min(inside.y, inside.z) : axis == 1 ? min(inside.x, inside.z) : min(inside.x, inside.y);
    tone *= 1.0 - seam_at(border, pixel, 2.0 * smallest) * (1.0 - 0.5 * shown);
    vec3 shaded = lit(color.rgb * tone, point, normal, d, 0.6) + color.rgb * (0.12 * color.a * color.a);
    out_color = finished(hazed(shaded, length(point)));
}
