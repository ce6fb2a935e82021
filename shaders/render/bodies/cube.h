// The visible faces of a box: at most three, which meet in the nearest vertex; seven vertices in all.
#ifndef SCREE_RENDER_CUBE_H
#define SCREE_RENDER_CUBE_H

// Vertex `index` (0..6) in units of half extents: bit k of index + 1 is set on the near side of axis k. `toward`
// points from the box to the eye, in the box's frame.
vec3 near_corner(uint index, vec3 toward) {
    vec3 near = vec3(toward.x < 0.0 ? -1.0 : 1.0, toward.y < 0.0 ? -1.0 : 1.0, toward.z < 0.0 ? -1.0 : 1.0);
    uint bits = index + 1u;
    // An odd number of mirrored axes reverses the winding; exchanging two axes restores it.
    if (near.x * near.y * near.z < 0.0) bits = (bits & 4u) | ((bits & 1u) << 1) | ((bits >> 1) & 1u);
    return near * vec3((bits & 1u) != 0u ? 1.0 : -1.0, (bits & 2u) != 0u ? 1.0 : -1.0, (bits & 4u) != 0u ? 1.0 : -1.0);
}

#endif
