// Shadows of spheres, ellipsoids and capsules: discards fragments outside the disc.
#version 460

layout(location = 0) in vec2 place;

void main() {
    if (dot(place, place) > 1.0) discard;
}
