// A block of joints in a pass of the reference runner: one sparse linear system, solved directly; in plain loops
// (joint_block.cpp), or with those of compute/cpu/simd/simd_joints.h, in the same bits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "compute/cpu/simd/simd_joints.h"
#include "compute/tables/state.h"
#include "shaders/physics/contact/contact_solver.h"
#include "shaders/physics/joint/joint_coupling.h"

namespace scree::reference {

// Scratch of a pass over a block with couplings, for each of its joints. A joint uses the first two members: the impulses of its
// rows, couplings included, and their axes. A coupling uses the others: its equation, whose column is by row, 6 joint + axis.
struct CoupledJoint {
    JointLanes impulses;
    physics::uint axes;
    bool unknown;
    float solution, compliance, inverse_pivot;
    float column[6 * physics::MAX_COUPLED_BLOCK];
};

// Room for the equations of blocks, reused by one thread.
struct JointRoom {
    const WideJointStages* wide = nullptr;  // null: plain loops
    std::vector<WideJoint> joints;          // of several blocks
    std::vector<JointColumns> tiles;        // of one block
    std::vector<physics::JointEquations> equations;
    std::vector<CoupledJoint> coupled;  // by joint of a block with couplings
};

class JointBlock {
public:
    using Joint = physics::Joint;
    using JointRow = physics::JointRow;
    using BlockBody = physics::BlockBody;

    JointBlock(State& state, std::size_t index)
        : state_(state),
          p_(state.fixed()),
          all_(state.joints),
          all_bodies_(state.block_bodies),
          block_(state.joint_blocks[index]) {
        joints_ = std::span(all_).subspan(block_.first_joint, block_.joints);
        members_ = std::span(all_bodies_).subspan(block_.first_body, block_.bodies);
    }

    std::span<Joint> joints() const { return joints_; }
    std::span<BlockBody> bodies() const { return members_; }
    std::size_t first_body() const { return block_.first_body; }
    physics::uint& restless() const { return block_.restless; }
    bool moves() const {
        return std::any_of(members_.begin(), members_.end(), [](const BlockBody& body) { return body.slot != physics::NONE; });
    }
    template <class Visit>
    void for_each_whole(const Visit& visit) {
        for (Joint& joint : joints_)
            if (!joint.broken) visit(joint);
    }
    // Whether a body of the block has an impact in this substep: then joints are relaxed after the contacts as well.
    bool struck() const {
        return std::any_of(members_.begin(), members_.end(),
                           [&](const BlockBody& body) { return state_.forces[body.body].impact_weight != 0; });
    }

    // ---- a pass: begin() for several blocks, place_rows() once for all, then solve() or gather() of each
    // Masses and velocities of the block's bodies, in the relax pass of a block that is not struck before the contacts.
    void begin(JointRoom& room, bool lend_after_contacts, bool take_after_contacts);
    static void place_rows(JointRoom& room, std::span<JointBlock> blocks);
    void solve(bool biased);
    // The whole bodies' velocity changes by the impulses handed out.
    void gather(bool warms) {
        if (coupled())
            return gather_coupled([&](const JointRow& row, const physics::JointRotor& rotor) {
                return physics::handed_impulse(row, rotor, warms);
            });
        gather_by(
            [&](const JointRow& row, const physics::JointRotor& rotor) { return physics::handed_impulse(row, rotor, warms); });
    }
    void gather_warm_start() {
        coupled() ? gather_coupled(physics::row_impulse) : gather_by(physics::row_impulse);
        for_each_whole([](Joint& joint) {
            for_each_rotor(joint, [&](physics::uint k, physics::JointRotor& rotor) {
                rotor = physics::rotor_slowed(rotor, physics::impulse_of_rotor(joint.rows[k], rotor));
            });
        });
    }
    // Writes them to the bodies' slots.
    void write_deltas(float weight, bool with_normal_impulse) {
        for (const BlockBody& body : members_)
            if (body.slot != physics::NONE)
                state_.slots[body.slot] =
                    physics::velocity_delta(body.velocity, weight, with_normal_impulse ? body.normal_sum : 0);
    }

    static vec3 impulse_of(const Joint& joint, physics::uint from);
    void note_pressing();
    static void commit(Joint& joint, bool warms) {
        for (physics::uint k = 0; k < 6; ++k)  // a row that no longer constrains keeps its change of the last pass that it did
            if (joint.axes[k].mode != 0) joint.rows[k] = physics::committed(joint.rows[k]);
        for_each_rotor(joint, [&](physics::uint k, physics::JointRotor& rotor) {
            rotor = physics::rotor_after_pass(rotor, joint.rows[k], warms);
        });
    }
    // Clears the impulses of a joint.
    static void tear(Joint& joint) {
        for (JointRow& row : joint.rows) row = physics::torn(row);
        for (physics::JointRotor& rotor : joint.rotors) rotor = physics::torn_rotor(rotor);
    }
    // ---- couplings, the last joints of the block (coupled_block.cpp). Such a block is solved in plain loops.
    bool coupled() const { return block_.couplings != 0; }
    void place_couplings();                 // after place_rows()
    void commit_couplings(bool with_load);  // with their impulse added to the load

    // As a step begins, sets the speeds of rotors whose bodies do not go on as they did. After place_rows().
    void take_rotor_speeds();

private:
    static bool unknown(const Joint& joint, physics::uint k) { return (joint.solved_axes >> k & 1) != 0; }
    static const vec3& arm(const JointRow& row, bool is_b) { return is_b ? row.angular_b : row.angular_a; }
    // An axis after the turns that the joint has made; `turned`: room for the one that makes any.
    static const physics::JointAxis& axis_of(const Joint& joint, physics::uint k, physics::JointAxis& turned) {
        if (k != 3) return joint.axes[k];
        turned = physics::axis_after_turns(joint.axes[k], joint.twist, joint.rows[k].coordinate);
        return turned;
    }
    // The axes that constrain.
    template <class Visit>
    static void for_each_axis(Joint& joint, const Visit& visit) {
        physics::JointAxis turned;
        for (physics::uint k = 0; k < 6; ++k)
            if (physics::row_acts(joint.axes[k], joint.rows[k])) visit(k, axis_of(joint, k, turned), joint.rows[k]);
    }
    template <class Visit>
    static void for_each_rotor(Joint& joint, const Visit& visit) {
        for (physics::uint k = 0; k < 6; ++k)
            if (physics::has_rotor(joint.axes[k])) visit(k, joint.rotors[k]);
    }
    template <class Visit>
    static void for_each_unknown(const Joint& joint, const Visit& visit) {
        for (physics::uint k = 0; k < 6; ++k)
            if (unknown(joint, k)) visit(k);
    }

    physics::Pose pose(physics::uint body) const;
    physics::Velocity speed(physics::uint body, physics::uint block_body) const;
    physics::Mass mass(physics::uint block_body) const;
    physics::VelocityPair speeds(const Joint& joint) const {
        return {speed(joint.a, joint.block_body_a), speed(joint.b, joint.block_body_b)};
    }
    WideJoint* wide(const Joint& joint) const {
        return room_->wide ? &room_->joints[first_wide_ + static_cast<std::size_t>(&joint - joints_.data())] : nullptr;
    }
    physics::JointEquations& equations(const Joint& joint) const {
        return room_->equations[static_cast<std::size_t>(&joint - joints_.data())];
    }

    void take_velocities(bool after_contacts);
    void describe(JointRoom& room);
    void place(Joint& joint);
    void push(const Joint& joint, physics::uint axes, const JointLanes& impulses);
    template <class Impulse>
    void gather_by(const Impulse& impulse) {
        for (BlockBody& body : members_) {
            body.velocity = {};
            body.mass.split = 1;
        }
        for_each_whole([&](Joint& joint) {
            JointLanes impulses{};
            physics::uint axes = 0;
            for_each_axis(joint, [&](physics::uint k, const physics::JointAxis&, const JointRow& row) {
                impulses[k] = impulse(row, joint.rotors[k]);
                if (impulses[k] != 0) axes |= 1u << k;
            });
            if (axes != 0) push(joint, axes, impulses);
        });
    }

    // ---- couplings
    std::span<Joint> couplings() const { return joints_.last(block_.couplings); }
    bool acts(const Joint& coupling) const;  // neither it nor a joint of it has broken, and a body can move
    template <class Visit>
    void for_each_coupling(const Visit& visit) {
        for (Joint& coupling : couplings())
            if (acts(coupling)) visit(coupling);
    }
    CoupledJoint& coupled(const Joint& joint) const { return room_->coupled[static_cast<std::size_t>(&joint - joints_.data())]; }
    void gather_coupled(const std::function<float(const JointRow&, const physics::JointRotor&)>& impulse);
    void push_coupled();
    float with_couplings(float normal_impulse, const Joint& joint);  // those that push along the joint
    void add_to_terms(const Joint& coupling, float impulse);
    float speed_of_coupling(const Joint& coupling, bool before) const;
    float coupled_entry(const Joint& joint, physics::uint k, const Joint& coupling) const;
    float entry_between(const Joint& coupling, const Joint& other) const;
    void solve_coupled(bool biased);
    void solve_coupled_equations();
    void solve_border();
    bool other_bounds_of_coupling(Joint& coupling, bool biased, bool settling);

    // ---- a round
    void speeds_of_rows(const Joint& joint, JointLanes& found) const;
    physics::uint choose_given(Joint& joint, bool biased, JointLanes& given);
    void apply_given(Joint& joint, bool biased);
    void demand(Joint& joint, bool biased);
    void solve_equations();
    bool other_bounds(Joint& joint, bool biased, bool settling);

    // ---- equations in plain loops
    static float entry(const Joint& left, physics::uint n, const Joint& right, const physics::RowResponse& to);
    void set_up(const Joint& joint);
    float* coupling(const Joint& joint, physics::uint with) const;
    void eliminate(const Joint& joint, physics::uint k);
    void substitute(const Joint& joint, physics::uint k);

    State& state_;
    const physics::Parameters& p_;
    std::vector<Joint>& all_;
    std::vector<BlockBody>& all_bodies_;
    physics::JointBlock& block_;
    std::span<Joint> joints_;
    std::span<BlockBody> members_;
    JointRoom* room_ = nullptr;
    std::size_t first_wide_ = 0;  // its joints in the room
};

}  // namespace scree::reference
