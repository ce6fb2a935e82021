// Bodies of a draw of labels.
#ifndef SCREE_RENDER_LABEL_ROWS_H
#define SCREE_RENDER_LABEL_ROWS_H

// Lists of covers, which have 1 in the lower bits of the push constant, have bodies that move alone.
bool is_told(BodyProperties body) {
    return !is_absent(body.motion) && ((pushed & 255u) == 0u || (body.motion & 3u) == MOTION_DYNAMIC);
}

#endif
