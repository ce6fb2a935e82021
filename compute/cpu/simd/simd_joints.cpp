// The equations of joints in SIMD. The build compiles this file for baseline vectors and for AVX2 (compute/CMakeLists.txt).
#include "compute/cpu/simd/simd_joints.h"

// Defines the types of the laws, so before them.
#include "compute/cpu/simd/simd_types.h"

#include "shaders/physics/joint/joint_matrix.h"
#include "shaders/physics/joint/joint_turns.h"

#undef float
#undef bool

// Uses these types.
#include "compute/cpu/simd/joint_placement.h"

LAWS_BEGIN

namespace {

using reference::JointColumns;
using reference::JointLanes;
using reference::WideJoint;

static_assert(lanes == reference::lanes_of_joints);

constexpr size_t axes_at = offsetof(Joint, axes) / sizeof(Words), rows_at = offsetof(Joint, rows) / sizeof(Words);
constexpr size_t rotors_at = offsetof(Joint, rotors) / sizeof(Words), words_of_rotor = sizeof(JointRotor) / sizeof(Words);
constexpr size_t twist_at = offsetof(Joint, twist) / sizeof(Words);
constexpr size_t words_of_axis = sizeof(JointAxis) / sizeof(Words), words_of_row = sizeof(JointRow) / sizeof(Words);

SCREE_INLINE Float loaded(const JointLanes& from) {
    Floats floats;
    __builtin_memcpy(&floats, from, sizeof floats);
    return floats;
}
SCREE_INLINE vec3 loaded(const JointLanes (&from)[3]) {
    return {loaded(from[0]), loaded(from[1]), loaded(from[2])};
}
SCREE_INLINE void store(JointLanes& to, Float x) {
    __builtin_memcpy(to, &x.v, sizeof x.v);
}
SCREE_INLINE void store(JointLanes (&to)[3], vec3 v) {
    store(to[0], v.x);
    store(to[1], v.y);
    store(to[2], v.z);
}
SCREE_INLINE vec3 one_of(const JointLanes (&from)[3], int k) {
    return {Float(from[0][k]), Float(from[1][k]), Float(from[2][k])};
}
template <typename Record>
SCREE_INLINE Record broadcast(const uint32_t* words) {
    Record record;
    lanes_8::broadcast(words, record);
    return record;
}
SCREE_INLINE Uint axis_numbers() {
    return Words{0, 1, 2, 3, 4, 5, 6, 7};
}

// A joint per lane; lanes beyond the end repeat the last one.
void place(const WideJoint* joints, size_t count, float h) {
    for (size_t first = 0; first < count; first += lanes) {
        uint32_t* record[lanes];
        const uint32_t *pose_a[lanes], *pose_b[lanes], *velocity_a[lanes], *velocity_b[lanes], *mass_a[lanes], *mass_b[lanes];
        for (size_t lane = 0; lane < lanes; ++lane) {
            const WideJoint& joint = joints[first + lane < count ? first + lane : count - 1];
            record[lane] = joint.record;
            pose_a[lane] = joint.pose_a;
            pose_b[lane] = joint.pose_b;
            velocity_a[lane] = joint.velocity_a;
            velocity_b[lane] = joint.velocity_b;
            mass_a[lane] = joint.mass_a;
            mass_b[lane] = joint.mass_b;
        }
        const Placement joint = gather_at<Placement>(record);
        JointAxis axes[6];
#pragma GCC unroll 6
        for (int k = 0; k < 6; ++k) axes[k] = gather_at<JointAxis>(record, axes_at + k * words_of_axis);
        Float twist;
        for (size_t lane = 0; lane < lanes; ++lane) twist.v[lane] = __builtin_bit_cast(float, record[lane][twist_at]);
        const JointConfiguration at =
            turned_configuration(joint_configuration(joint.anchor_a, joint.frame_a, gather_at<Pose>(pose_a), joint.anchor_b,
                                                     joint.frame_b, gather_at<Pose>(pose_b)),
                                 joint.flags, twist, axes[3], axes[4], axes[5]);
        for (size_t lane = 0; lane < lanes && first + lane < count; ++lane)
            if (joints[first + lane].holds) record[lane][twist_at] = floatBitsToUint(at.turned).v[lane];
        const VelocityPair v{gather_at<Velocity>(velocity_a), gather_at<Velocity>(velocity_b)};
        const Mass a = gather_at<Mass>(mass_a), b = gather_at<Mass>(mass_b);
        const Bool has_a = joint.block_body_a != NONE, has_b = joint.block_body_b != NONE;
#pragma GCC unroll 6
        for (int k = 0; k < 6; ++k) {
            const Bool used = axes[k].mode != 0u;
            if (none(used)) continue;
            const size_t row_at = rows_at + k * words_of_row;
            Float inertia;
            for (size_t lane = 0; lane < lanes; ++lane)
                inertia.v[lane] = __builtin_bit_cast(float, record[lane][rotors_at + k * words_of_rotor]);
            const JointRow row =
                placed_row(gather_at<JointRow>(record, row_at), at, k, joint.flags, v, a, b, has_a, has_b, inertia, Float(h));
            uint32_t* to[lanes];
            for (size_t lane = 0; lane < lanes; ++lane) {
                const WideJoint& one = joints[first + lane < count ? first + lane : count - 1];
                to[lane] = used.v[lane] && one.holds ? one.record : nullptr;
            }
            scatter_at(to, row_at, row);
        }
    }
}

struct Push {
    vec3 direction;
    Float pad0;
    vec3 turn;
    Float pad1;
};
SCREE_INLINE void store_pushes(JointLanes (&to)[6], vec3 direction, vec3 turn) {
    uint32_t* pointers[lanes] = {};
    for (int k = 0; k < 6; ++k) pointers[k] = reinterpret_cast<uint32_t*>(to[k]);
    scatter_at(pointers, 0, Push{direction, 0.0f, turn, 0.0f});
}

SCREE_INLINE Float speed_of(const JointRow& row, const uint32_t* a, const uint32_t* b) {
    return row_speed(row, is_linear(axis_numbers()), VelocityPair{broadcast<Velocity>(a), broadcast<Velocity>(b)});
}

void prepare(WideJoint* joints, size_t count) {
    for (size_t j = 0; j < count; ++j) {
        WideJoint& joint = joints[j];
        const uint32_t* rows[lanes];
        for (size_t k = 0; k < lanes; ++k) rows[k] = joint.record + rows_at + (k < 6 ? k : 5) * words_of_row;
        const JointRow row = gather_at<JointRow>(rows);
        const RowResponse to = row_response(row, axis_numbers(), broadcast<Mass>(joint.mass_a), broadcast<Mass>(joint.mass_b));
        store(joint.direction, row.direction);
        store(joint.angular_a, row.angular_a);
        store(joint.angular_b, row.angular_b);
        store(joint.turn_a, to.turn_a);
        store(joint.turn_b, to.turn_b);
        store(joint.speed_before, speed_of(row, joint.velocity_before_a, joint.velocity_before_b));
        store_pushes(joint.push_a, row.direction, to.turn_a);
        store_pushes(joint.push_b, row.direction, to.turn_b);
    }
}

void speeds(const WideJoint& joint, JointLanes& out) {
    JointRow row;
    row.direction = loaded(joint.direction);
    row.angular_a = loaded(joint.angular_a);
    row.angular_b = loaded(joint.angular_b);
    store(out, speed_of(row, joint.velocity_a, joint.velocity_b));
}

// row_pushed of one body by rows in turn: eight lanes are the words of its velocity, of which two are padding.
SCREE_INLINE void push_body(uint32_t* velocity, const JointLanes (&pushes)[6], const Mass& mass, uint32_t axes, Float impulses) {
    JointLanes linear, angular;
    store(linear, impulses * mass.inverse_mass * mass.split);
    store(angular, impulses * mass.split);
    const Masks both{-1, -1, -1, 0, -1, -1, -1, 0}, turns{0, 0, 0, 0, -1, -1, -1, 0}, first{-1, -1, -1, -1, 0, 0, 0, 0};
    Float v;
    __builtin_memcpy(&v.v, velocity, sizeof v.v);
    for (uint32_t left = axes; left != 0; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const Float scale = choose(Bool(first), linear[k], angular[k]);
        v = choose(Bool(k < 3 ? both : turns), flush_tiny(v + loaded(pushes[k]) * scale), v);
    }
    __builtin_memcpy(velocity, &v.v, sizeof v.v);
}
void push(const WideJoint& joint, uint32_t axes, const JointLanes& impulses) {
    const Float all_impulses = loaded(impulses);
    if (joint.pushed_a != nullptr) push_body(joint.pushed_a, joint.push_a, broadcast<Mass>(joint.mass_a), axes, -all_impulses);
    if (joint.pushed_b != nullptr) push_body(joint.pushed_b, joint.push_b, broadcast<Mass>(joint.mass_b), axes, all_impulses);
}

// ---- equations: column k of a tile has an entry per axis of the later joint
SCREE_INLINE void fill(JointColumns& tile, const WideJoint& joint, const WideJoint& later, int32_t ends) {
    const vec3 direction = loaded(later.direction), angular_a = loaded(later.angular_a), angular_b = loaded(later.angular_b);
    const Mass a = broadcast<Mass>(joint.mass_a), b = broadcast<Mass>(joint.mass_b);
    RowResponse to;
    to.inverse_mass_a = a.inverse_mass;
    to.inverse_mass_b = b.inverse_mass;
    to.split_a = a.split;
    to.split_b = b.split;
    for (int k = 0; k < 6; ++k) {
        if ((joint.unknowns >> k & 1) == 0) {
            store(tile.of[k], Float(0.0f));
            continue;
        }
        to.axis = Uint(k);
        to.direction = one_of(joint.direction, k);
        to.turn_a = one_of(joint.turn_a, k);
        to.turn_b = one_of(joint.turn_b, k);
        store(tile.of[k], row_entry(direction, angular_a, angular_b, axis_numbers(), to, ends));
    }
}

SCREE_INLINE Float lessened(const JointLanes& column, Float multiplier, float other) {
    return less_multiple(loaded(column), multiplier, Float(other));
}

// Eliminates the unknowns of a joint from its own later equations; `inverse`: of its pivots.
SCREE_INLINE void factor(JointColumns& own, WideJoint& joint, JointLanes& inverse) {
    for (int k = 0; k < 6; ++k) {
        if ((joint.unknowns >> k & 1) == 0) continue;
        const Float over = reciprocal(Float(own.of[k][k]));
        inverse[k] = over.v[0];
        const Float multiplier = multiplier_of(loaded(own.of[k]), over);
        const Bool behind = axis_numbers() > Uint(k);
        store(joint.solution, choose(behind, lessened(joint.solution, multiplier, joint.solution[k]), loaded(joint.solution)));
        for (int c = k + 1; c < 6; ++c) store(own.of[c], lessened(own.of[c], multiplier, own.of[k][c]));
    }
}
// From the equations of a later joint that are coupled with them.
SCREE_INLINE void factor_link(JointColumns& tile, const JointColumns& own, const WideJoint& joint, WideJoint& later,
                              const JointLanes& inverse) {
    Float solution = loaded(later.solution), columns[6];
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) columns[k] = loaded(tile.of[k]);
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
        if ((joint.unknowns >> k & 1) == 0) continue;
        const Float multiplier = multiplier_of(columns[k], Float(inverse[k]));
        solution = less_multiple(solution, multiplier, Float(joint.solution[k]));
#pragma GCC unroll 6
        for (int c = k + 1; c < 6; ++c) columns[c] = less_multiple(columns[c], multiplier, Float(own.of[k][c]));
    }
    store(later.solution, solution);
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) store(tile.of[k], columns[k]);
}
// From the entries between two later joints, `row` the later of them.
SCREE_INLINE void lessen(JointColumns& target, const JointColumns& row, const JointColumns& column, uint32_t unknowns,
                         const JointLanes& inverse) {
    Float columns[6];
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c) columns[c] = loaded(target.of[c]);
    for (uint32_t left = unknowns; left != 0; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const Float multiplier = multiplier_of(loaded(row.of[k]), Float(inverse[k]));
#pragma GCC unroll 6
        for (int c = 0; c < 6; ++c) columns[c] = less_multiple(columns[c], multiplier, Float(column.of[k][c]));
    }
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c) store(target.of[c], columns[c]);
}

// Where a joint has its columns with the later joint `with`.
SCREE_INLINE uint32_t tile_with(const WideJoint& joint, uint32_t with) {
    uint32_t l = 0;
    while (l + 1 < joint.links && joint.link[l] != with) ++l;  // ends also for forged tables
    return joint.first_tile + 1 + l;
}

SCREE_INLINE void eliminate(WideJoint* joints, size_t j, JointColumns* tiles, JointLanes& inverse) {
    WideJoint& joint = joints[j];
    JointColumns* const own = tiles + joint.first_tile;
    factor(*own, joint, inverse);
    for (uint32_t l = 0; l < joint.links; ++l) factor_link(own[1 + l], *own, joint, joints[joint.link[l]], inverse);
    for (uint32_t l = 0; l < joint.links; ++l) {
        const WideJoint& later = joints[joint.link[l]];
        if (later.unknowns == 0) continue;
        for (uint32_t e = 0; e < l; ++e) {
            const WideJoint& middle = joints[joint.link[e]];
            if (middle.unknowns == 0) continue;
            lessen(tiles[tile_with(middle, joint.link[l])], own[1 + l], own[1 + e], joint.unknowns, inverse);
        }
        lessen(tiles[later.first_tile], own[1 + l], own[1 + l], joint.unknowns, inverse);
    }
}

SCREE_INLINE void substitute(WideJoint* joints, size_t j, const JointColumns* tiles, const JointLanes& inverse) {
    WideJoint& joint = joints[j];
    const JointColumns* const own = tiles + joint.first_tile;
    for (int k = 5; k >= 0; --k) {
        if ((joint.unknowns >> k & 1) == 0) continue;
        Float sum = joint.solution[k];
        for (int n = k + 1; n < 6; ++n)
            if (joint.unknowns >> n & 1) sum = less_multiple(sum, Float(own->of[k][n]), Float(joint.solution[n]));
        for (uint32_t l = 0; l < joint.links; ++l) {
            const WideJoint& later = joints[joint.link[l]];
            for (uint32_t left = later.unknowns; left != 0; left &= left - 1) {
                const int n = __builtin_ctz(left);
                sum = less_multiple(sum, Float(own[1 + l].of[k][n]), Float(later.solution[n]));
            }
        }
        joint.solution[k] = substituted(sum, Float(inverse[k])).v[0];
    }
}

void solve(WideJoint* joints, size_t count, JointColumns* tiles) {
    JointLanes inverses[reference::most_wide_joints];
    for (size_t j = 0; j < count; ++j) {
        const WideJoint& joint = joints[j];
        JointColumns* const own = tiles + joint.first_tile;
        fill(*own, joint, joint, joint.own_ends);
        for (int k = 0; k < 6; ++k)
            if (joint.unknowns >> k & 1) own->of[k][k] = softened(Float(own->of[k][k]), Float(joint.compliance[k])).v[0];
        for (uint32_t l = 0; l < joint.links; ++l) fill(own[1 + l], joint, joints[joint.link[l]], joint.ends[l]);
    }
    for (size_t j = 0; j < count; ++j) eliminate(joints, j, tiles, inverses[j]);
    for (size_t j = count; j-- > 0;) substitute(joints, j, tiles, inverses[j]);
}

}  // namespace

LAWS_END

namespace scree::reference {

const WideJointStages SCREE_JOINT_STAGES = {lanes_8::place, lanes_8::prepare, lanes_8::speeds, lanes_8::push, lanes_8::solve};

}  // namespace scree::reference
