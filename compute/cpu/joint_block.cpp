// The pass over a block of joints.
#include "compute/cpu/joint_block.h"

#include <cstddef>

#include "compute/compile/joint_blocks.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

using physics::BlockBody;
using physics::Joint;
using physics::JointRow;
using physics::NONE;

namespace {

// An end of a joint: the body's record in the block, and the sign of the impulse.
struct End {
    physics::uint block_body;
    bool is_b;
};

template <class Record>
std::uint32_t* words_of(Record& record) {
    return reinterpret_cast<std::uint32_t*>(&record);
}
template <class Record>
const std::uint32_t* words_of(const Record& record) {
    return reinterpret_cast<const std::uint32_t*>(&record);
}

constexpr physics::Pose pose_of_world{vec3(0), 0, physics::vec4(0, 0, 0, 1)};
constexpr physics::Velocity at_rest{};
constexpr physics::Mass immovable{};

}  // namespace

// ---- bodies
physics::Pose JointBlock::pose(physics::uint body) const {
    return body == NONE ? pose_of_world : state_.poses[body];
}
physics::Velocity JointBlock::speed(physics::uint body, physics::uint block_body) const {
    if (block_body != NONE) return all_bodies_[block_body].velocity;
    return body == NONE ? at_rest : state_.velocities[body];
}
physics::Mass JointBlock::mass(physics::uint block_body) const {
    return block_body == NONE ? immovable : all_bodies_[block_body].mass;
}

// After the contacts with this pass's changes by them, whose slots come before those of joints.
void JointBlock::take_velocities(bool after_contacts) {
    for (BlockBody& member : members_) {
        const physics::uint body = member.body;
        physics::Velocity velocity = state_.velocities[body];
        if (after_contacts && member.slot != NONE) {
            const std::size_t first = state_.first_slot_of(body);
            for (std::size_t k = first; k < state_.slot_ends[body] - member.blocks; ++k)
                velocity = physics::changed_by(velocity, state_.slots[k]);
        }
        member.velocity = member.velocity_before = velocity;
    }
}

// ---- rows
void JointBlock::begin(JointRoom& room, bool lend_after_contacts, bool take_after_contacts) {
    room_ = &room;
    for (BlockBody& member : members_)
        member.mass = physics::mass_of_member(state_.masses[member.body], member.slot != NONE, member.blocks, member.normal_sum,
                                              lend_after_contacts, p_);
    take_velocities(take_after_contacts);
    if (room.wide) describe(room);
}

void JointBlock::describe(JointRoom& room) {
    first_wide_ = room.joints.size();
    std::uint32_t tiles = 0;
    for (Joint& joint : joints_) {
        WideJoint& wide = room.joints.emplace_back();
        const bool has_a = joint.block_body_a != NONE, has_b = joint.block_body_b != NONE;
        const auto velocity_of = [&](physics::uint body) { return words_of(body == NONE ? at_rest : state_.velocities[body]); };
        wide.record = words_of(joint);
        wide.holds = !joint.broken;
        wide.pose_a = words_of(joint.a == NONE ? pose_of_world : state_.poses[joint.a]);
        wide.pose_b = words_of(joint.b == NONE ? pose_of_world : state_.poses[joint.b]);
        wide.velocity_before_a = velocity_of(joint.a);
        wide.velocity_before_b = velocity_of(joint.b);
        wide.velocity_a = has_a ? words_of(all_bodies_[joint.block_body_a].velocity) : wide.velocity_before_a;
        wide.velocity_b = has_b ? words_of(all_bodies_[joint.block_body_b].velocity) : wide.velocity_before_b;
        wide.mass_a = words_of(has_a ? all_bodies_[joint.block_body_a].mass : immovable);
        wide.mass_b = words_of(has_b ? all_bodies_[joint.block_body_b].mass : immovable);
        wide.pushed_a = has_a ? words_of(all_bodies_[joint.block_body_a].velocity) : nullptr;
        wide.pushed_b = has_b ? words_of(all_bodies_[joint.block_body_b].velocity) : nullptr;
        wide.unknowns = 0;
        wide.links = joint.fill_in;
        wide.first_tile = tiles;
        tiles += 1 + joint.fill_in;
        const auto ends = [&](const Joint& other) {
            return physics::shared_ends(other.block_body_a, other.block_body_b, joint.block_body_a, joint.block_body_b);
        };
        wide.own_ends = ends(joint);
        for (physics::uint l = 0; l < joint.fill_in; ++l) {
            wide.link[l] = joint.fill_in_of[l] - block_.first_joint;
            wide.ends[l] = ends(all_[joint.fill_in_of[l]]);
        }
    }
    if (room.tiles.size() < tiles) room.tiles.resize(tiles);
}

void JointBlock::place(Joint& joint) {
    if ((joint.flags & physics::JOINT_COUPLES) != 0) return;
    const physics::JointConfiguration at = configuration_of(joint, pose(joint.a), pose(joint.b), p_);
    joint.twist = at.turned;
    const physics::VelocityPair v = speeds(joint);
    for (int k = 0; k < 6; ++k)
        if (joint.axes[k].mode != 0)
            joint.rows[k] =
                physics::placed_row(joint.rows[k], at, k, joint.flags, v, mass(joint.block_body_a), mass(joint.block_body_b),
                                    joint.block_body_a != NONE, joint.block_body_b != NONE, joint.rotors[k].inertia, p_.h);
}

void JointBlock::place_rows(JointRoom& room, std::span<JointBlock> blocks) {
    if (blocks.empty()) return;
    if (room.wide) {
        room.wide->place(room.joints.data(), room.joints.size(), blocks[0].p_.h);
        room.wide->prepare(room.joints.data(), room.joints.size());
        return;
    }
    for (JointBlock& block : blocks) block.for_each_whole([&](Joint& joint) { block.place(joint); });
}

void JointBlock::take_rotor_speeds() {
    const auto was_set = [&](physics::uint body) { return body != NONE && physics::was_set(state_.sleep_states[body]); };
    const auto at_rest = [&](physics::uint body) {
        return body == NONE || state_.properties[body].motion != physics::MOTION_DYNAMIC ||
               physics::was_at_rest(state_.sleep_states[body], p_.sleep_steps);
    };
    for_each_whole([&](Joint& joint) {
        const bool set = was_set(joint.a) || was_set(joint.b), rested = at_rest(joint.a) && at_rest(joint.b);
        if (!set && !rested) return;
        JointLanes speed{};
        bool known = !set;
        for_each_rotor(joint, [&](physics::uint k, physics::JointRotor& rotor) {
            if (!known) speeds_of_rows(joint, speed);
            known = true;
            rotor = physics::rotor_as_step_begins(rotor, set, rested, speed[k]);
        });
    });
}

// ---- impulses
void JointBlock::push(const Joint& joint, physics::uint axes, const JointLanes& impulses) {
    if (room_->wide) {
        room_->wide->push(*wide(joint), axes, impulses);
        return;
    }
    for (physics::uint k = 0; k < 6; ++k) {
        if ((axes >> k & 1) == 0) continue;
        const JointRow& row = joint.rows[k];
        for (const End end : {End{joint.block_body_a, false}, End{joint.block_body_b, true}}) {
            if (end.block_body == NONE) continue;
            BlockBody& pushed = all_bodies_[end.block_body];
            pushed.velocity = physics::row_pushed(pushed.velocity, row.direction, arm(row, end.is_b),
                                                  end.is_b ? impulses[k] : -impulses[k], physics::is_linear(k), pushed.mass);
        }
    }
}

vec3 JointBlock::impulse_of(const Joint& joint, physics::uint from) {
    vec3 sum(0);
    for (physics::uint k = from; k < from + 3; ++k)
        if (joint.axes[k].mode != 0) sum += physics::row_push(joint.rows[k], joint.rotors[k]);
    return sum;
}
void JointBlock::note_pressing() {
    for (BlockBody& member : members_) member.normal_sum = 0;
    for_each_whole([&](Joint& joint) {
        float normal_impulse = physics::length3(impulse_of(joint, 0));
        if (coupled()) normal_impulse = with_couplings(normal_impulse, joint);
        for (const physics::uint block_body : {joint.block_body_a, joint.block_body_b})
            if (block_body != NONE) all_bodies_[block_body].normal_sum += normal_impulse;
    });
}

// ---- rounds
// Their laws take the parameters by value: [[gnu::flatten]] spares a copy of half a kilobyte a call.
void JointBlock::solve(bool biased) {
    if (coupled()) return solve_coupled(biased);
    for (Joint& joint : joints_) joint.solved_axes = 0;
    bool others = true;
    for (physics::uint round = 0; round < physics::JOINT_ROUNDS && others; ++round) {
        for (BlockBody& member : members_) member.velocity = member.velocity_before;
        for_each_whole([&](Joint& joint) { apply_given(joint, biased); });
        for_each_whole([&](Joint& joint) { demand(joint, biased); });
        solve_equations();
        others = false;
        for_each_whole([&](Joint& joint) { others |= other_bounds(joint, biased, round >= physics::SETTLING_ROUND); });
    }
    block_.unsettled = others;
}

void JointBlock::speeds_of_rows(const Joint& joint, JointLanes& found) const {
    if (room_->wide) {
        room_->wide->speeds(*wide(joint), found);
        return;
    }
    const physics::VelocityPair v = speeds(joint);
    for (physics::uint k = 0; k < 6; ++k) found[k] = physics::row_speed(joint.rows[k], physics::is_linear(k), v);
}

// Chooses the axes that are unknowns; the impulses of the others are given. Returns those that are not 0.
[[gnu::flatten]] physics::uint JointBlock::choose_given(Joint& joint, bool biased, JointLanes& given) {
    const WideJoint* const lanes = wide(joint);
    const physics::VelocityPair before{speed(joint.a, NONE), speed(joint.b, NONE)};
    physics::uint unknowns = 0, pushed = 0;
    for_each_axis(joint, [&](physics::uint k, const physics::JointAxis& axis, JointRow& row) {
        const physics::uint active_flags = physics::active_set_of(joint.active_set, k);
        if (physics::row_is_unknown(axis, row, active_flags, biased, p_)) unknowns |= 1u << k;
        const float speed = lanes ? lanes->speed_before[k] : physics::row_speed(row, k < 3, before);
        row = physics::row_given(axis, row, active_flags, speed, biased, p_);
        given[k] = physics::given_push(axis, row);
        if (given[k] != 0) pushed |= 1u << k;
    });
    joint.solved_axes = unknowns;
    return pushed;
}
// And applies them at once.
void JointBlock::apply_given(Joint& joint, bool biased) {
    JointLanes given{};
    const physics::uint pushed = choose_given(joint, biased, given);
    if (pushed != 0) push(joint, pushed, given);
}

// Right-hand sides and compliances.
[[gnu::flatten]] void JointBlock::demand(Joint& joint, bool biased) {
    JointLanes speed;
    speeds_of_rows(joint, speed);
    WideJoint* const lanes = wide(joint);
    if (lanes) lanes->unknowns = joint.solved_axes;
    for_each_unknown(joint, [&](physics::uint k) {
        physics::JointAxis turned;
        const physics::RowTarget wants = physics::row_demand(axis_of(joint, k, turned), joint.rows[k], joint.rotors[k], k,
                                                             physics::active_set_of(joint.active_set, k), biased, p_);
        const float side = physics::right_hand_side(speed[k], wants.bias);
        if (lanes) {
            lanes->solution[k] = side;
            lanes->compliance[k] = wants.compliance;
        } else {
            equations(joint).solution[k] = side;
            equations(joint).tiles[7 * k] = wants.compliance;
        }
    });
}

void JointBlock::solve_equations() {
    if (room_->wide) {
        room_->wide->solve(&room_->joints[first_wide_], joints_.size(), room_->tiles.data());
    } else {
        for_each_whole([&](Joint& joint) { set_up(joint); });
        for_each_whole([&](Joint& joint) { for_each_unknown(joint, [&](physics::uint k) { eliminate(joint, k); }); });
        for (std::size_t j = joints_.size(); j-- > 0;)
            for (physics::uint k = 6; k-- > 0;)
                if (!joints_[j].broken && unknown(joints_[j], k)) substitute(joints_[j], k);
    }
    for_each_whole([&](Joint& joint) {
        JointLanes impulses{};
        for_each_unknown(
            joint, [&](physics::uint k) { impulses[k] = room_->wide ? wide(joint)->solution[k] : equations(joint).solution[k]; });
        push(joint, joint.solved_axes, impulses);
    });
}

[[gnu::flatten]] bool JointBlock::other_bounds(Joint& joint, bool biased, bool settling) {
    JointLanes speed;
    speeds_of_rows(joint, speed);
    const WideJoint* const lanes = wide(joint);
    const physics::uint before = joint.active_set;
    for_each_axis(joint, [&](physics::uint k, const physics::JointAxis& axis, JointRow& row) {
        const physics::uint active_flags = physics::active_set_of(joint.active_set, k);
        const bool solved = unknown(joint, k);
        const float solution = !solved ? 0 : lanes ? lanes->solution[k] : equations(joint).solution[k];
        const physics::RowAfter after = physics::row_after_round(axis, row, joint.rotors[k], k, active_flags, solved, solution,
                                                                 speed[k], biased, settling, p_);
        row = after.row;
        if (physics::has_rotor(axis)) joint.rotors[k].change = after.rotor_change;
        joint.active_set = physics::with_active_set(joint.active_set, k, after.active_flags);
    });
    return joint.active_set != before;
}

// ---- equations in plain loops
// The matrix entry of row n of a joint and the row of a response of another joint.
float JointBlock::entry(const Joint& left, physics::uint n, const Joint& right, const physics::RowResponse& to) {
    const JointRow& row = left.rows[n];
    return physics::row_entry(row.direction, row.angular_a, row.angular_b, n, to,
                              physics::shared_ends(left.block_body_a, left.block_body_b, right.block_body_a, right.block_body_b));
}

void JointBlock::set_up(const Joint& joint) {
    physics::JointEquations& own = equations(joint);
    for_each_unknown(joint, [&](physics::uint k) {
        const physics::RowResponse to =
            physics::row_response(joint.rows[k], k, mass(joint.block_body_a), mass(joint.block_body_b));
        const float compliance = own.tiles[7 * k];
        for (physics::uint n = k; n < 6; ++n)
            if (unknown(joint, n)) {
                if (n == k)
                    own.tiles[7 * k] = physics::softened(entry(joint, n, joint, to), compliance);
                else
                    own.tiles[6 * n + k] = entry(joint, n, joint, to);
            }
        for (physics::uint l = 0; l < joint.fill_in; ++l)
            for_each_unknown(all_[joint.fill_in_of[l]], [&](physics::uint n) {
                own.tiles[36 + 36 * l + 6 * n + k] = entry(all_[joint.fill_in_of[l]], n, joint, to);
            });
    });
}

float* JointBlock::coupling(const Joint& joint, physics::uint with) const {
    const std::span fill_in(joint.fill_in_of, joint.fill_in);
    return equations(joint).tiles + 36 + 36 * (std::find(fill_in.begin(), fill_in.end(), with) - fill_in.begin());
}

void JointBlock::eliminate(const Joint& joint, physics::uint k) {
    physics::JointEquations& own = equations(joint);
    const float inverse = physics::reciprocal(own.tiles[7 * k]);
    own.tiles[7 * k] = inverse;
    for (physics::uint n = k + 1; n < 6; ++n) {
        if (!unknown(joint, n)) continue;
        const float multiplier = physics::multiplier_of(own.tiles[6 * n + k], inverse);
        own.solution[n] = physics::less_multiple(own.solution[n], multiplier, own.solution[k]);
        for (physics::uint c = k + 1; c <= n; ++c)
            if (unknown(joint, c))
                own.tiles[6 * n + c] = physics::less_multiple(own.tiles[6 * n + c], multiplier, own.tiles[6 * c + k]);
    }
    for (physics::uint l = 0; l < joint.fill_in; ++l) {
        const Joint& later = all_[joint.fill_in_of[l]];
        physics::JointEquations& theirs = equations(later);
        float* link = own.tiles + 36 + 36 * l;
        for_each_unknown(later, [&](physics::uint n) {
            const float multiplier = physics::multiplier_of(link[6 * n + k], inverse);
            theirs.solution[n] = physics::less_multiple(theirs.solution[n], multiplier, own.solution[k]);
            for (physics::uint c = k + 1; c < 6; ++c)
                if (unknown(joint, c))
                    link[6 * n + c] = physics::less_multiple(link[6 * n + c], multiplier, own.tiles[6 * c + k]);
            for (physics::uint c = 0; c <= n; ++c)
                if (unknown(later, c))
                    theirs.tiles[6 * n + c] = physics::less_multiple(theirs.tiles[6 * n + c], multiplier, link[6 * c + k]);
            for (physics::uint e = 0; e < l; ++e) {
                const Joint& middle = all_[joint.fill_in_of[e]];
                float* between = coupling(middle, joint.fill_in_of[l]);
                for_each_unknown(middle, [&](physics::uint c) {
                    between[6 * n + c] =
                        physics::less_multiple(between[6 * n + c], multiplier, own.tiles[36 + 36 * e + 6 * c + k]);
                });
            }
        });
    }
}

void JointBlock::substitute(const Joint& joint, physics::uint k) {
    physics::JointEquations& own = equations(joint);
    float sum = own.solution[k];
    for (physics::uint n = k + 1; n < 6; ++n)
        if (unknown(joint, n)) sum = physics::less_multiple(sum, own.tiles[6 * n + k], own.solution[n]);
    for (physics::uint l = 0; l < joint.fill_in; ++l) {
        const Joint& later = all_[joint.fill_in_of[l]];
        for_each_unknown(later, [&](physics::uint n) {
            sum = physics::less_multiple(sum, own.tiles[36 + 36 * l + 6 * n + k], equations(later).solution[n]);
        });
    }
    own.solution[k] = physics::substituted(sum, own.tiles[7 * k]);
}

}  // namespace scree::reference
