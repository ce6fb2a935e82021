// The tables of quads (tables.h), which share one buffer: what the scene describes, each in its own record.
#ifndef SCREE_STAGES_QUADS_GLSL
#define SCREE_STAGES_QUADS_GLSL

#ifdef SCREE_TEXELS
#define QUAD(place) texelFetch(quads_texels, int(place))
#else
#define QUAD(place) quads.at[place]
#endif

PoseInBody pose_in_body_at(uint place) {
    vec4 position = uintBitsToFloat(QUAD(place));
    return PoseInBody(xyz(position), position.w, uintBitsToFloat(QUAD(place + 1u)));
}

// Where a row behind all bodies lies in its body.
PoseInBody read_part(uint row) {
    return pose_in_body_at(PARAMETERS.parts_begin + 2u * (row - PARAMETERS.first_part));
}
PoseInBody read_piece(uint place) {
    return pose_in_body_at(PARAMETERS.pieces_begin + 2u * place);
}
Fracturing read_fracture(uint place) {
    uvec4 first = QUAD(PARAMETERS.fractures_begin + 2u * place);
    uvec4 second = QUAD(PARAMETERS.fractures_begin + 2u * place + 1u);
    return Fracturing(uintBitsToFloat(first.x), first.y, first.z, first.w, second.x, second.y, second.z, second.w);
}
Tyre read_tyre(uint place) {
    vec4 tyre = uintBitsToFloat(QUAD(PARAMETERS.tyres_begin + place));
    return Tyre(tyre.x, tyre.y, tyre.z, tyre.w);
}
WayPoint read_way_point(uint place) {
    vec4 point = uintBitsToFloat(QUAD(PARAMETERS.way_points_begin + place));
    return WayPoint(xyz(point), point.w);
}
uvec4 read_hull(uint place) {
    return QUAD(PARAMETERS.hulls_begin + place);
}

#endif
