// Broadphase search: calls found(), which the stage defines, for the partners of the pairs that one body owns. Partners
// are bodies with overlapping bounds; between inactive bodies, those of last step's contacts. Loops are tested at their
// foot, since lavapipe runs others once more: of nested ones that is most of the work. WITH_IMAGES: in a periodic cell; the
// constant PERIODIC in its place took lavapipe half as long again, though it is false.
#ifndef SCREE_STAGES_NEIGHBOURS_GLSL
#define SCREE_STAGES_NEIGHBOURS_GLSL

#include "shaders/physics/body/filter.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/stages/lib/ids.glsl"

// Whether a joint disables collision between two bodies. Only bodies that joints move have a list of joints.
bool kept_apart(uint body, uint other) {
    uint listed = READ(properties, body).joints != NONE ? body : other;
    uint partner = listed == body ? other : body;
    for (uint j = READ(properties, listed).joints; j != NONE;) {
        bool is_a = joints.at[j].a == listed;
        if ((is_a ? joints.at[j].b : joints.at[j].a) == partner && joints.at[j].broken == 0u &&
            (joints.at[j].flags & JOINT_COLLIDES) == 0u)
            return true;
        j = is_a ? joints.at[j].next_a : joints.at[j].next_b;
    }
    return false;
}
// Whether filters and excluded pairs allow two rows to collide.
bool may_collide(uint row, uint other) {
    uvec4 own = READ_QUADS(filters, row);
    if (!filters_allow(own, READ_QUADS(filters, other))) return false;
    if (own.w == NONE) return true;
    uint partner = id_of(body_of(other));
    for (uint k = own.w; k != NONE;) {
        uvec4 entry = READ_QUADS(exclusions, k);
        if (entry.x == partner) return false;
        k = entry.y;
    }
    return true;
}
// Whether this rank moves the body of a row, one that contacts move.
bool is_owned(uint row) {
    BodyProperties properties = READ(properties, row);
    return motion_of(properties) == MOTION_DYNAMIC && !is_foreign(properties);
}
void meets(uint body, uint other) {
    if (GHOSTS) {
        if (!is_owned(body) && !is_owned(other)) return;
    }
    if (FILTERS) {
        if (!may_collide(body, other)) return;
    }
    if (JOINTS) {
        if (kept_apart(body_of(body), body_of(other))) return;
    }
    found(other);
}

#ifdef WITH_IMAGES
// From which images of the body the rows of cells are looked through, and the middle of its own bounds.
vec3 periods, middle;

// At the image that the body meets.
CellEntry nearest_of(CellEntry entry, BodyProperties own, Bounds around) {
    vec3 apart = middle_of(entry.lower, entry.upper) - middle_of(around.lower, around.upper);
    Image image = image_of_b(own, READ(properties, entry.body), apart, PARAMETERS);
    entry.lower = lower_at_image(entry.lower, image, PARAMETERS);
    entry.upper = upper_at_image(entry.upper, image, PARAMETERS);
    return entry;
}
#endif

void look_through_large(uint body, BodyProperties own, Bounds around) {
    uint own_bucket = PARAMETERS.buckets + (COPIES ? around.level >> COPY_SHIFT : 0u), last = READ_WORD(cell_ends, own_bucket);
    uint next = READ_WORD(cell_ends, own_bucket - 1u);
    if (next >= last) return;
    do {
        CellEntry entry = READ(cell_entries, next++);
        uint other = entry.body;
        if (!finds_large(id_of(body), around.level, is_large(own), id_of(other), entry.level)) continue;
#ifdef WITH_IMAGES
        entry = nearest_of(entry, own, around);
#endif
        if (!boxes_overlap(around.lower, around.upper, entry.lower, entry.upper)) continue;
        BodyProperties theirs = READ(properties, other);
        if (!can_touch(own, theirs)) continue;
        bool near = true;
        if (theirs.shape == SHAPE_PLANE)
            near = reaches_plane(around.lower, around.upper, theirs.size, READ(poses, other).position);
        else if (own.shape == SHAPE_PLANE)
            near = reaches_plane(entry.lower, entry.upper, own.size, READ(poses, body).position);
        if (near) meets(body, other);
    } while (next < last);
}

// Cells along x are consecutive buckets, which may wrap round the end of the grid's entries.
void look_through_row(uint body, BodyProperties own, Bounds around, ivec3 from, int last_x, uint level) {
    uint key = COPIES ? level | (around.level & COPY_BITS) : level;
    uint low = bucket_of(from, key, PARAMETERS.buckets);
    uint high = bucket_of(ivec3(last_x, from.y, from.z), key, PARAMETERS.buckets);
    uint end = READ_WORD(cell_ends, PARAMETERS.buckets - 1u);
    uint first = low == 0u ? 0u : READ_WORD(cell_ends, low - 1u);
    uint id = id_of(body);
    uint entries = low <= high ? READ_WORD(cell_ends, high) - first : end - first + READ_WORD(cell_ends, high);
    if (entries == 0u) return;
    uint next = 0u;
    do {
        uint place = first + next < end ? first + next : first + next - end;
        ++next;
        CellEntry entry = READ(cell_entries, place);
        if ((entry.level & ~(INACTIVE | MOVES)) != key) continue;
        if (!boxes_overlap(around.lower, around.upper, entry.lower, entry.upper)) continue;
        if (!finds(id, around.level, id_of(entry.body), entry.level & ~MOVES)) continue;
        ivec3 cell = cell_of(entry.lower, entry.upper, level, PARAMETERS.inverse_cell);
        if (cell.y != from.y || cell.z != from.z) continue;  // another row of cells, hashed to the same buckets
#ifdef WITH_IMAGES
        if (!is_nearest_image(periods, middle_of(entry.lower, entry.upper) - middle, PARAMETERS)) continue;
#endif
        if (PARTS && is_part(own) && entry.body >= PARAMETERS.first_part && READ(properties, entry.body).owner == own.owner)
            continue;
        if (motion_of(own) == MOTION_DYNAMIC || (entry.level & MOVES) != 0u) meets(body, entry.body);
    } while (next < entries);
}

void look_through_level(uint body, BodyProperties own, Bounds around, uint level) {
    CellRange range = cells_in_reach(around.lower, around.upper, level, PARAMETERS);
    int z = range.first.z;
    do {
        int y = range.first.y;
        do look_through_row(body, own, around, ivec3(range.first.x, y, z), range.last.x, level);
        while (++y <= range.last.y);
    } while (++z <= range.last.z);
}

// Partners of an inactive body that are inactive too: those of its contacts in the last step, if one of them is dynamic still.
void carry_over(uint body) {
    uint last = READ_WORD(first_contacts, body + 1u);
    bool moves = motion_of(READ(properties, body)) == MOTION_DYNAMIC;
    for (uint k = READ_WORD(first_contacts, body); k < last; ++k) {
        uint a = READ(contacts_before, k).a;
        uint other = a == body ? READ(contacts_before, k).b : a;
        if ((READ(bounds, other).level & INACTIVE) == 0u) continue;
        if (!moves && motion_of(READ(properties, other)) != MOTION_DYNAMIC) continue;
        if (GHOSTS) {
            if (!is_owned(body) && !is_owned(other)) continue;
        }
        if (FILTERS) {
            if (!may_collide(body, other)) continue;
        }
        found(other);
    }
}

void look_around(uint body) {
    Bounds around = READ(bounds, body);
    if ((around.level & NOT_IN_GRID) != 0u) return;
    bool still = (around.level & INACTIVE) != 0u;
    if (still) carry_over(body);
    uint levels = levels_to_search(around.level, COUNTED);
    if (still && levels == 0u && (COUNTED.large_stirring & 1u) == 0u) return;
    if (COPIES && still && (READ_WORD(copy_states, around.level >> COPY_SHIFT) & COPY_STIRS) == 0u) return;
    BodyProperties own = READ(properties, body);
    look_through_large(body, own, around);
    if (is_large(own)) return;
    if (levels == 0u) return;
    do {
        uint level = uint(findLSB(levels));
        levels &= levels - 1u;
#ifdef WITH_IMAGES
        middle = middle_of(around.lower, around.upper);
        ImageRange images = images_in_reach(around.lower, around.upper, level, PARAMETERS);
        ivec3 at = images.first;
        do {
            periods = vec3(at);
            Image image = image_at(periods, PARAMETERS);
            Bounds there = around;
            there.lower = lower_at_image(around.lower, image, PARAMETERS);
            there.upper = upper_at_image(around.upper, image, PARAMETERS);
            look_through_level(body, own, there, level);
            at = next_image(at, images);
        } while (at.z <= images.last.z);
#else
        look_through_level(body, own, around, level);
#endif
    } while (levels != 0u);
}

#endif
