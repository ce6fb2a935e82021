// Reference joint stages: each block of joints as one sparse linear system, solved directly.
#include "shaders/physics/solve/joint_block.h"

#include <algorithm>
#include <atomic>
#include <span>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/contact_solver.h"

namespace scree::reference {

namespace {

using physics::Joint;
using physics::JointRow;
using physics::NONE;

// An end of a joint: the body's record in the block, and the sign of the impulse.
struct End {
    physics::uint block_body;
    bool is_b;
};

class Block {
public:
    Block(State& state, std::size_t index)
        : state_(state), p_(state.fixed()), all_(state.joints), first_(all_[index].first_of_block) {
        joints_ = std::span(all_).subspan(first_, all_[first_].block_joints);
        members_ = std::span(all_).subspan(first_, all_[first_].block_bodies);
    }

    std::span<Joint> joints() const { return joints_; }
    std::span<Joint> block_bodies() const { return members_; }
    bool moves() const {
        return std::any_of(members_.begin(), members_.end(), [](const Joint& record) { return record.slot != NONE; });
    }

    template <class Visit>
    void for_each_whole(const Visit& visit) {
        for (Joint& joint : joints_)
            if (!joint.broken) visit(joint);
    }
    // The axes that constrain.
    template <class Visit>
    static void for_each_axis(Joint& joint, const Visit& visit) {
        for (physics::uint k = 0; k < 6; ++k)
            if (physics::row_acts(joint.axes[k], joint.rows[k])) visit(k, joint.axes[k], joint.rows[k]);
    }

    // Whether a body of the block has an impact in this substep: then joints are relaxed after the contacts as well.
    bool struck() const {
        return std::any_of(members_.begin(), members_.end(),
                           [&](const Joint& record) { return state_.forces[record.block_body].impacts != 0; });
    }

    void lend(bool after_contacts) {
        for (Joint& record : members_)
            record.mass = physics::mass_of_member(state_.masses[record.block_body], record.slot != NONE, record.blocks,
                                                  record.normal_sum, after_contacts, p_);
    }

    void coordinate(bool after_contacts) {
        take_velocities(after_contacts);
        for_each_whole([&](Joint& joint) {
            const physics::JointConfiguration at = physics::joint_configuration(joint.anchor_a, joint.frame_a, pose(joint.a),
                                                                                joint.anchor_b, joint.frame_b, pose(joint.b));
            const physics::VelocityPair v = speeds(joint);
            const physics::uint ends = shared(joint, joint);
            for (physics::uint k = 0; k < 6; ++k)
                if (joint.axes[k].mode != 0)
                    joint.rows[k] = physics::placed_row(joint.rows[k], at, k, joint.flags, v, mass(joint.block_body_a),
                                                        mass(joint.block_body_b), ends, p_.h);
        });
    }

    void solve(bool biased) {
        const bool after_contacts = biased || struck();
        lend(after_contacts);
        for (Joint& joint : joints_) joint.solved_axes = 0;
        coordinate(after_contacts);
        bool others = true;
        for (physics::uint round = 0; round < physics::JOINT_ROUNDS && others; ++round) {
            for (Joint& record : members_) record.velocity = record.velocity_before;
            for_each_whole([&](Joint& joint) { apply_given(joint, biased); });
            for_each_whole([&](Joint& joint) { set_up(joint, biased); });
            for_each_whole([&](Joint& joint) {
                for (physics::uint k = 0; k < 6; ++k)
                    if (unknown(joint, k)) eliminate(joint, k);
            });
            for (std::size_t j = joints_.size(); j-- > 0;)
                for (physics::uint k = 6; k-- > 0;)
                    if (!joints_[j].broken && unknown(joints_[j], k)) substitute(joints_[j], k);
            for_each_whole([&](Joint& joint) {
                for (physics::uint k = 0; k < 6; ++k)
                    if (unknown(joint, k)) push(joint, k, joint.solution[k]);
            });
            others = false;
            for_each_whole([&](Joint& joint) { others |= other_bounds(joint, biased, round >= physics::SETTLING_ROUND); });
        }
        joints_[0].unsettled = others;
    }

    // Writes the whole bodies' velocity changes by `impulse(row)` of every row to their slots.
    template <class Impulse>
    void gather(const Impulse& impulse) {
        for (Joint& record : members_) {
            record.velocity = {};
            record.mass.split = 1;
        }
        for_each_whole([&](Joint& joint) {
            for_each_axis(joint, [&](physics::uint k, const physics::JointAxis&, const JointRow& row) {
                const float push_by = impulse(row);
                if (push_by != 0) push(joint, k, push_by);
            });
        });
    }
    template <class Payload>
    void hand_out(float active, const Payload& payload) {
        for (const Joint& record : members_)
            if (record.slot != NONE)
                state_.slots[record.slot] = physics::velocity_delta(record.velocity, active, payload(record));
    }

    static vec3 impulse_of(const Joint& joint, physics::uint from) {
        vec3 sum(0);
        for (physics::uint k = from; k < from + 3; ++k)
            if (joint.axes[k].mode != 0) sum += physics::row_push(joint.rows[k]);
        return sum;
    }
    void note_pressing() {
        for (Joint& record : members_) record.normal_sum = 0;
        for_each_whole([&](Joint& joint) {
            const float normal_impulse = physics::length3(impulse_of(joint, 0));
            for (const physics::uint block_body : {joint.block_body_a, joint.block_body_b})
                if (block_body != NONE) all_[block_body].normal_sum += normal_impulse;
        });
    }
    static void commit(Joint& joint) {
        for (JointRow& row : joint.rows) row = physics::committed(row);
    }

private:
    static bool unknown(const Joint& joint, physics::uint k) { return (joint.solved_axes >> k & 1) != 0; }
    static const vec3& arm(const JointRow& row, bool is_b) { return is_b ? row.angular_b : row.angular_a; }

    physics::Pose pose(physics::uint body) const {
        return body == NONE ? physics::Pose{vec3(0), 0, physics::vec4(0, 0, 0, 1)} : state_.poses[body];
    }
    physics::Velocity speed(physics::uint body, physics::uint block_body) const {
        if (block_body != NONE) return all_[block_body].velocity;
        return body == NONE ? physics::Velocity{} : state_.velocities[body];
    }
    physics::Mass mass(physics::uint block_body) const { return block_body == NONE ? physics::Mass{} : all_[block_body].mass; }
    static physics::uint shared(const Joint& left, const Joint& right) {
        return physics::shared_ends(left.block_body_a, left.block_body_b, right.block_body_a, right.block_body_b);
    }
    physics::VelocityPair speeds(const Joint& joint) const {
        return {speed(joint.a, joint.block_body_a), speed(joint.b, joint.block_body_b)};
    }
    // After the contacts with this pass's changes by them, whose slots come before those of joints.
    void take_velocities(bool after_contacts) {
        for (Joint& record : members_) {
            const physics::uint body = record.block_body;
            physics::Velocity velocity = state_.velocities[body];
            if (after_contacts && record.slot != NONE) {
                const std::size_t first = body == 0 ? 0 : state_.slot_ends[body - 1];
                for (std::size_t k = first; k < state_.slot_ends[body] - record.blocks; ++k)
                    velocity = physics::changed_by(velocity, state_.slots[k]);
            }
            record.velocity = record.velocity_before = velocity;
        }
    }

    void push(const Joint& joint, physics::uint k, float impulse) {
        const JointRow& row = joint.rows[k];
        for (const End end : {End{joint.block_body_a, false}, End{joint.block_body_b, true}}) {
            if (end.block_body == NONE) continue;
            Joint& record = all_[end.block_body];
            record.velocity = physics::row_pushed(record.velocity, row.direction, arm(row, end.is_b),
                                                  end.is_b ? impulse : -impulse, physics::is_linear(k), record.mass);
        }
    }

    // The matrix entry of row n of a joint and the row of a response of another joint.
    static float entry(const Joint& left, physics::uint n, const Joint& right, const physics::RowResponse& to) {
        const JointRow& row = left.rows[n];
        return physics::row_entry(row.direction, row.angular_a, row.angular_b, n, to, shared(left, right));
    }

    void apply_given(Joint& joint, bool biased) {
        joint.solved_axes = 0;
        const physics::VelocityPair before{speed(joint.a, NONE), speed(joint.b, NONE)};
        for_each_axis(joint, [&](physics::uint k, const physics::JointAxis& axis, JointRow& row) {
            const physics::uint active_flags = physics::active_set_of(joint.active_set, k);
            if (physics::row_is_unknown(axis, row, active_flags, biased, p_)) joint.solved_axes |= 1u << k;
            row = physics::row_given(axis, row, active_flags, physics::row_speed(row, k < 3, before), biased, p_);
            const float given = physics::given_change(row);
            if (given != 0) push(joint, k, given);
        });
    }

    void set_up(Joint& joint, bool biased) {
        const physics::VelocityPair v = speeds(joint);
        for (physics::uint k = 0; k < 6; ++k) {
            if (!unknown(joint, k)) continue;
            const JointRow& row = joint.rows[k];
            const physics::RowTarget wants =
                physics::row_demand(joint.axes[k], row, k, physics::active_set_of(joint.active_set, k), biased, p_);
            const physics::RowResponse to = physics::row_response(row, k, mass(joint.block_body_a), mass(joint.block_body_b));
            joint.solution[k] = physics::right_hand_side(physics::row_speed(row, k < 3, v), wants);
            for (physics::uint n = k; n < 6; ++n)
                if (unknown(joint, n)) joint.diagonal[6 * n + k] = entry(joint, n, joint, to);
            joint.diagonal[7 * k] = physics::softened(joint.diagonal[7 * k], wants);
            for (physics::uint l = 0; l < joint.fill_in; ++l)
                for (physics::uint n = 0; n < 6; ++n)
                    if (const Joint& later = all_[joint.fill_in_of[l]]; unknown(later, n))
                        joint.coupling[36 * l + 6 * n + k] = entry(later, n, joint, to);
        }
    }

    static float* coupling(Joint& joint, physics::uint with) {
        const std::span fill_in(joint.fill_in_of, joint.fill_in);
        return joint.coupling + 36 * (std::find(fill_in.begin(), fill_in.end(), with) - fill_in.begin());
    }

    void eliminate(Joint& joint, physics::uint k) {
        const float inverse = physics::reciprocal(joint.diagonal[7 * k]);
        joint.diagonal[7 * k] = inverse;
        for (physics::uint n = k + 1; n < 6; ++n) {
            if (!unknown(joint, n)) continue;
            const float multiplier = physics::multiplier_of(joint.diagonal[6 * n + k], inverse);
            joint.solution[n] = physics::less_multiple(joint.solution[n], multiplier, joint.solution[k]);
            for (physics::uint c = k + 1; c <= n; ++c)
                if (unknown(joint, c))
                    joint.diagonal[6 * n + c] =
                        physics::less_multiple(joint.diagonal[6 * n + c], multiplier, joint.diagonal[6 * c + k]);
        }
        for (physics::uint l = 0; l < joint.fill_in; ++l) {
            Joint& later = all_[joint.fill_in_of[l]];
            float* own = joint.coupling + 36 * l;
            for (physics::uint n = 0; n < 6; ++n) {
                if (!unknown(later, n)) continue;
                const float multiplier = physics::multiplier_of(own[6 * n + k], inverse);
                later.solution[n] = physics::less_multiple(later.solution[n], multiplier, joint.solution[k]);
                for (physics::uint c = k + 1; c < 6; ++c)
                    if (unknown(joint, c))
                        own[6 * n + c] = physics::less_multiple(own[6 * n + c], multiplier, joint.diagonal[6 * c + k]);
                for (physics::uint c = 0; c <= n; ++c)
                    if (unknown(later, c))
                        later.diagonal[6 * n + c] = physics::less_multiple(later.diagonal[6 * n + c], multiplier, own[6 * c + k]);
                for (physics::uint e = 0; e < l; ++e) {
                    Joint& middle = all_[joint.fill_in_of[e]];
                    float* theirs = coupling(middle, joint.fill_in_of[l]);
                    for (physics::uint c = 0; c < 6; ++c)
                        if (unknown(middle, c))
                            theirs[6 * n + c] =
                                physics::less_multiple(theirs[6 * n + c], multiplier, joint.coupling[36 * e + 6 * c + k]);
                }
            }
        }
    }

    void substitute(Joint& joint, physics::uint k) {
        float sum = joint.solution[k];
        for (physics::uint n = k + 1; n < 6; ++n)
            if (unknown(joint, n)) sum = physics::less_multiple(sum, joint.diagonal[6 * n + k], joint.solution[n]);
        for (physics::uint l = 0; l < joint.fill_in; ++l)
            for (physics::uint n = 0; n < 6; ++n)
                if (const Joint& later = all_[joint.fill_in_of[l]]; unknown(later, n))
                    sum = physics::less_multiple(sum, joint.coupling[36 * l + 6 * n + k], later.solution[n]);
        joint.solution[k] = physics::substituted(sum, joint.diagonal[7 * k]);
    }

    bool other_bounds(Joint& joint, bool biased, bool settling) {
        const physics::VelocityPair v = speeds(joint);
        const physics::uint before = joint.active_set;
        for_each_axis(joint, [&](physics::uint k, const physics::JointAxis& axis, JointRow& row) {
            const physics::uint active_flags = physics::active_set_of(joint.active_set, k);
            const bool solved = unknown(joint, k);
            const float solution = solved ? joint.solution[k] : 0;
            const physics::RowAfter after =
                physics::row_after_round(axis, row, k, active_flags, solved, solution, v, biased, settling, p_);
            row = after.row;
            joint.active_set = physics::with_active_set(joint.active_set, k, after.active_flags);
        });
        return joint.active_set != before;
    }

    State& state_;
    const physics::Parameters& p_;
    std::vector<Joint>& all_;
    std::size_t first_;
    std::span<Joint> joints_, members_;
};

bool may_move(const State& state, std::uint32_t body) {
    return physics::any_stirs(state.counted()) &&
           physics::is_movable(state.properties[body].motion, state.sleep_states[body], state.fixed().sleep_steps);
}

template <class Work>
void for_each_block(State& state, const Threads& threads, const Work& work) {
    if (state.counted().overflow) return;
    // Fine-grained parts: a block is as much work as many contacts, so all threads share even few blocks.
    const std::size_t blocks = state.fixed().joint_blocks;
    const std::size_t parts = threads.count() == 1 ? 1 : 128;
    threads.for_each(parts, [&](std::size_t part) {
        for (std::size_t i = part * blocks / parts; i < (part + 1) * blocks / parts; ++i)
            if (Block block(state, i); state.is_owned(block.block_bodies()[0].block_body)) work(block);
    });
}

void take_stock(Joint& joint, const State& state) {
    const physics::JointLoad load =
        physics::mean_load({joint.force, joint.max_force, joint.torque, joint.max_torque}, state.fixed());
    joint.force = load.force;
    joint.max_force = load.max_force;
    joint.torque = load.torque;
    joint.max_torque = load.max_torque;
    if (!physics::joint_tears(joint.force, joint.break_force, joint.torque, joint.break_torque)) return;
    joint.broken = 1;
    joint.active_set = 0;
    for (JointRow& row : joint.rows) row = physics::torn(row);
}

}  // namespace

void wake_joined(State& state, const Threads& threads, std::uint32_t wakes) {
    if (!state.counted().sleepers || !physics::any_stirs(state.counted())) return;
    const auto restless = [&](physics::uint body) {
        return body != NONE &&
               physics::stirs_joined(state.properties[body].motion, state.velocities[body], state.sleep_states[body]);
    };
    for_each_block(state, threads, [&](Block block) {
        if (!wakes) {
            block.joints()[0].restless = 0;
            block.for_each_whole([&](const Joint& joint) {
                if (restless(joint.a) || restless(joint.b)) block.joints()[0].restless = 1;
            });
        } else if (block.joints()[0].restless) {
            for (const Joint& record : block.block_bodies()) {
                const std::atomic_ref rest(state.sleep_states[record.block_body]);
                if (physics::has_slept(rest.load(std::memory_order_relaxed), state.fixed().sleep_steps))
                    rest.fetch_or(physics::WOKEN, std::memory_order_relaxed);
            }
        }
    });
}

void count_joint_slots(State& state, const Threads& threads, std::uint32_t) {
    const auto gone = [&](physics::uint body) { return body != NONE && physics::is_absent(state.properties[body].motion); };
    for_each_block(state, threads, [&](const Block& block) {
        for (Joint& joint : block.joints())
            if (gone(joint.a) || gone(joint.b)) joint.broken = 1;
        for (Joint& record : block.block_bodies()) {
            record.slot = NONE;
            if (may_move(state, record.block_body)) std::atomic_ref(state.slot_ends[record.block_body]).fetch_add(1);
        }
    });
}

void fill_joint_slots(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [&](const Block& block) {
        for (const Joint& record : block.block_bodies()) {
            if (!may_move(state, record.block_body)) continue;
            const std::uint32_t slot = std::atomic_ref(state.slot_ends[record.block_body]).fetch_add(1);
            state.slot_sides[slot] = physics::OF_JOINT | static_cast<std::uint32_t>(&record - state.joints.data());
        }
    });
}

void prepare_joints(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [](Block block) {
        if (!block.moves()) return;
        block.note_pressing();
        block.lend(true);
        block.coordinate(false);
        block.for_each_whole([](Joint& joint) { joint.force = joint.torque = vec3(0); });
        block.gather(physics::row_impulse);
        block.hand_out(1, [](const Joint& record) { return record.normal_sum; });
    });
}

void solve_joints(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [](Block block) {
        if (!block.moves()) return;
        block.solve(true);
        block.gather([](const JointRow& row) { return physics::handed_impulse(row, /* warms */ false); });
        block.for_each_whole(Block::commit);
        block.hand_out(0, [](const Joint&) { return 1.0f; });  // marks the body as joined (restitution.h)
    });
}

void relax_joints(State& state, const Threads& threads, std::uint32_t last) {
    for_each_block(state, threads, [&](Block block) {
        if (!block.moves()) return;
        block.solve(false);
        const bool struck = block.struck();  // the impulses of an impact must not warm start the next substep
        block.gather([&](const JointRow& row) { return physics::handed_impulse(row, /* warms */ !last && !struck); });
        float quiet = physics::FOREVER;
        block.for_each_whole([&](Joint& joint) {
            Block::commit(joint);
            joint.force += Block::impulse_of(joint, 0);
            joint.torque += Block::impulse_of(joint, 3);
            if (last) take_stock(joint, state);
            if (struck)
                for (JointRow& row : joint.rows) row = physics::torn(row);
        });
        block.for_each_whole([&](const Joint& joint) {
            for (const physics::uint body : {joint.a, joint.b})
                if (last && body != NONE)
                    quiet = std::min(quiet, physics::quiet_steps_shown(state.properties[body].motion, state.velocities[body],
                                                                       state.sleep_states[body]));
        });
        block.note_pressing();
        block.hand_out(1, [&](const Joint& record) { return last ? quiet : record.normal_sum; });
    });
}

}  // namespace scree::reference
