// Rays through the tree: the nearest hit (step 0), any (step 1), the number of hits (step 2), all hits, each ray's from its
// start in the list on (step 3).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/queries/tables.glsl"

const uint NEAREST = 0u;
const uint ANY = 1u;
const uint COUNT = 2u;
const uint ALL = 3u;
const uint TRIANGLE_EDGES = 3u;

Hulls hulls;
QueryRay ray;
QueryMeeting best;
float reach;
uint found;
uint rounds;

// The body's id, by which equally distant hits are ordered; then by row, as the parts of a body are.
uint id_of(uint row) {
    uint body = row < PARAMETERS.first_part ? row : properties.at[row].owner;
    return (push.flags & IS_REORDERED) != 0u ? words.at[PARAMETERS.ids_offset + body] : body;
}
bool is_nearer(float distance, uint row) {
    if (best.row == NONE || distance != best.distance) return best.row == NONE || distance < best.distance;
    uint id = id_of(row), other = id_of(best.row);
    return id < other || (id == other && row < best.row);
}

void offer(uint row, float near) {
    uint category = (push.flags & HAS_FILTERS) != 0u ? quads.at[PARAMETERS.filters_offset + row].x : 1u;
    if ((category & ray.mask) == 0u) return;
    BodyProperties body = properties.at[row];
    if (body.shape == SHAPE_HULL) rounds += 2u * hull_head(hulls, body.shape_data).faces;
    if (body.shape == SHAPE_TRIANGLE) rounds += 2u + TRIANGLE_EDGES;
    RayMeeting met = met_in_box(meet_row(body, poses.at[row], ray.from, ray.along, ray.solid != 0u, hulls), near, ray.reach);
    if (met.distance < 0.0f) return;
    QueryMeeting meeting = QueryMeeting(met.normal, met.distance, row, 0u, 0u, 0u);
    if (push.step == ALL) meetings.at[found] = meeting;
    found += 1u;
    if (push.step >= COUNT || !is_nearer(met.distance, row)) return;
    best = meeting;
    reach = push.step == ANY ? -1.0f : met.distance;
}

void main() {
    uint i = push.first + gl_GlobalInvocationID.x;
    if (i >= push.items) return;
    ray = rays.at[i];
    hulls.bound = 0u;
    reach = ray.reach;
    best = QueryMeeting(ray.along, RAY_MISSES, NONE, 0u, 0u, 0u);
    found = push.step == ALL ? starts.at[i] : 0u;
    rounds = 0u;
    // Nothing to write: none is met, or the count said that it takes too long.
    if (push.step == ALL && found == starts.at[i + 1u]) return;

    uint planes = digits.at[PLANES];
    for (uint k = 0u; k < planes && rounds < push.rounds; ++k) {
        rounds += 1u;
        if (reach >= 0.0f) offer(row_boxes.at[k].row, 0.0f);
    }
    vec3 inverse = ray_inverse3(ray.along);
    uint nodes[32];
    float entries[32];
    uint size = 1u;
    nodes[0] = 1u;
    entries[0] = entry_into_box(node_boxes.at[1].lower, node_boxes.at[1].upper, ray.from, inverse, reach);
    while (size > 0u && rounds < push.rounds) {
        rounds += 1u;
        size -= 1u;
        uint node = nodes[size];
        if (entries[size] > reach) continue;
        if (node >= push.leaves) {
            uint first = (node - push.leaves) * LEAF_ROWS;
            for (uint k = first; k < first + LEAF_ROWS; ++k) {
                rounds += 1u;
                Box box = row_boxes.at[k];
                float near = entry_into_box(box.lower, box.upper, ray.from, inverse, reach);
                if (near <= reach) offer(box.row, near);
            }
            continue;
        }
        Box one = node_boxes.at[2u * node], other = node_boxes.at[2u * node + 1u];
        float near = entry_into_box(one.lower, one.upper, ray.from, inverse, reach);
        float far = entry_into_box(other.lower, other.upper, ray.from, inverse, reach);
        uint swap = near <= far ? 1u : 0u;  // the nearer one is taken up first
        float first = smaller(near, far), second = larger(near, far);
        if (second <= reach) {
            nodes[size] = 2u * node + swap;
            entries[size] = second;
            size += 1u;
        }
        if (first <= reach) {
            nodes[size] = 2u * node + 1u - swap;
            entries[size] = first;
            size += 1u;
        }
    }
    bool too_long = size > 0u;
    if (push.step == COUNT) starts.at[i] = too_long ? NONE : found;
    if (push.step >= COUNT) return;
    if (too_long) best.distance = RAY_TOO_LONG;
    meetings.at[i] = best;
}
