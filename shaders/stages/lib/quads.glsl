// The tables of quads (tables.h) in one buffer: constant scene data, of which READ_QUADS(table, i) is the i-th record.
#ifndef SCREE_STAGES_QUADS_GLSL
#define SCREE_STAGES_QUADS_GLSL

#include "shaders/stages/lib/record_readers.glsl"

#ifdef SCREE_TEXELS
#define SCREE_QUAD(table, i) texelFetch(quads_texels, int(PARAMETERS.table##_offset + (i)))
#else
#define SCREE_QUAD(table, i) quads.at[PARAMETERS.table##_offset + (i)]
#endif

#define READ_QUADS(table, i) read_##table(i)
uvec4 read_hulls(uint i) {
    return SCREE_QUAD(hulls, i);
}
uvec4 read_filters(uint i) {
    return SCREE_QUAD(filters, i);
}
uvec4 read_exclusions(uint i) {
    return SCREE_QUAD(exclusions, i);
}
uvec4 read_gravities(uint i) {
    return SCREE_QUAD(gravities, i);
}
SCREE_READER_PoseInBody(parts, SCREE_QUAD, SCREE_IN_TURN) SCREE_READER_Fracturing(fractures, SCREE_QUAD, SCREE_IN_TURN)
    SCREE_READER_PoseInBody(pieces, SCREE_QUAD, SCREE_IN_TURN) SCREE_READER_Tyre(tyres, SCREE_QUAD, SCREE_IN_TURN)
        SCREE_READER_Surface(surfaces, SCREE_QUAD, SCREE_IN_TURN) SCREE_READER_Immersion(immersions, SCREE_QUAD, SCREE_IN_TURN)
            SCREE_READER_WayPoint(way_points, SCREE_QUAD, SCREE_IN_TURN) SCREE_READER_Bond(bonds, SCREE_QUAD, SCREE_IN_TURN)

    // The pose of a part in its body.
    PoseInBody part_in(uint row) {
    return READ_QUADS(parts, row - PARAMETERS.first_part);
}

#endif
