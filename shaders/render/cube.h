// The sides of a box that one sees from a place: three at most, which meet in the nearest corner; seven corners in all.
#ifndef SCREE_RENDER_CUBE_H
#define SCREE_RENDER_CUBE_H

// `index` from 0 to 6, as the mesh of boxes numbers them: bit k of index + 1 tells whether the corner lies on the near side of
// axis k. `toward` points from the box to the place, in the box's frame. In units of half extents.
vec3 near_corner(uint index, vec3 toward) {
    vec3 near = vec3(toward.x < 0.0 ? -1.0 : 1.0, toward.y < 0.0 ? -1.0 : 1.0, toward.z < 0.0 ? -1.0 : 1.0);
    uint bits = index + 1u;
    // An odd number of mirrored axes would turn triangles inside out; so would exchanging two axes.
    if (near.x * near.y * near.z < 0.0) bits = (bits & 4u) | ((bits & 1u) << 1) | ((bits >> 1) & 1u);
    return near * vec3((bits & 1u) != 0u ? 1.0 : -1.0, (bits & 2u) != 0u ? 1.0 : -1.0, (bits & 4u) != 0u ? 1.0 : -1.0);
}

#endif
