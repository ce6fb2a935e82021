// A cube of half extent 1 as 36 corners: faces +x, +y, +z, -x, -y, -z, two triangles each, counterclockwise from outside.
#ifndef SCREE_RENDER_CUBE_H
#define SCREE_RENDER_CUBE_H

vec3 cube_corner(int index) {
    int face = index / 6;
    int k = index % 6;
    float u = k == 1 || k == 2 || k == 4 ? 1.0 : -1.0;
    float v = k == 2 || k == 4 || k == 5 ? 1.0 : -1.0;
    int axis = face % 3;
    float side = face < 3 ? 1.0 : -1.0;
    vec3 p = vec3(side, u * side, v);
    return axis == 0 ? p : (axis == 1 ? p.zxy : p.yzx);
}

#endif
