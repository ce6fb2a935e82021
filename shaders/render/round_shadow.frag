// Shadows of spheres and capsules: cuts the discs out of their squares.
#version 460

layout(location = 0) in vec2 place;

void main() {
    if (dot(place, place) > 1.0) discard;
}
