// Reference joint stages: each block of joints as a sparse system of linear equations that is solved at once.
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

// An end of a joint: the body's record in the block, and which way it is pushed.
struct End {
    physics::uint member;
    bool is_b;
};

class Block {
public:
    Block(State& state, std::size_t index)
        : state_(state), p_(state.fixed()), all_(state.joints), first_(all_[index].first_of_block) {
        joints_ = std::span(all_).subspan(first_, all_[first_].block_joints);
        members_ = std::span(all_).subspan(first_, all_[first_].block_members);
    }

    std::span<Joint> joints() const { return joints_; }
    std::span<Joint> members() const { return members_; }
    bool moves() const {
        return std::any_of(members_.begin(), members_.end(), [](const Joint& record) { return record.slot != NONE; });
    }

    template <class Visit>
    void for_each_whole(const Visit& visit) {
        for (Joint& joint : joints_)
            if (!joint.broken) visit(joint);
    }
    // The axes on which a joint acts at all.
    template <class Visit>
    static void for_each_axis(Joint& joint, const Visit& visit) {
        for (physics::uint k = 0; k < 6; ++k)
            if (physics::row_acts(joint.axes[k], joint.rows[k])) visit(k, joint.axes[k], joint.rows[k]);
    }

    void lend(bool biased) {
        for (Joint& record : members_) {
            record.mass = physics::mass_of_member(state_.masses[record.member], record.slot != NONE, record.blocks,
                                                  state_.loads[record.member].blows, record.pressed, biased, p_);
        }
    }

    void place(bool biased) {
        take_velocities(biased);
        for_each_whole([&](Joint& joint) {
            const physics::JointPlace at =
                physics::joint_place(joint.anchor_a, joint.frame_a, pose(joint.a), joint.anchor_b, joint.frame_b, pose(joint.b));
            const physics::Couple v = speeds(joint);
            const physics::uint ends = shared(joint, joint);
            for (physics::uint k = 0; k < 6; ++k)
                if (joint.axes[k].mode != 0)
                    joint.rows[k] = physics::placed_row(joint.rows[k], at, k, joint.flags, v, mass(joint.member_a),
                                                        mass(joint.member_b), ends, p_.h);
        });
    }

    void solve(bool biased) {
        lend(biased);
        for (Joint& joint : joints_) joint.solved = 0;
        place(biased);
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

    // What whole bodies feel of `impulse(row)` of every row, handed to their slots.
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
    template <class Told>
    void hand_out(const Told& told) {
        for (const Joint& record : members_)
            if (record.slot != NONE) state_.slots[record.slot] = physics::slot_of(record.velocity, 1, told(record));
    }

    static vec3 impulse_of(const Joint& joint, physics::uint from) {
        vec3 sum(0);
        for (physics::uint k = from; k < from + 3; ++k)
            if (joint.axes[k].mode != 0) sum += physics::row_push(joint.rows[k]);
        return sum;
    }
    void note_pressing() {
        for (Joint& record : members_) record.pressed = 0;
        for_each_whole([&](Joint& joint) {
            const float pressing = physics::length3(impulse_of(joint, 0));
            for (const physics::uint member : {joint.member_a, joint.member_b})
                if (member != NONE) all_[member].pressed += pressing;
        });
    }
    static void commit(Joint& joint) {
        for (JointRow& row : joint.rows) row = physics::committed(row);
    }

private:
    static bool unknown(const Joint& joint, physics::uint k) { return (joint.solved >> k & 1) != 0; }
    static const vec3& arm(const JointRow& row, bool is_b) { return is_b ? row.arm_b : row.arm_a; }

    physics::Pose pose(physics::uint body) const {
        return body == NONE ? physics::Pose{vec3(0), 0, physics::vec4(0, 0, 0, 1)} : state_.poses[body];
    }
    physics::Velocity speed(physics::uint body, physics::uint member) const {
        if (member != NONE) return all_[member].velocity;
        return body == NONE ? physics::Velocity{} : state_.velocities[body];
    }
    physics::Mass mass(physics::uint member) const { return member == NONE ? physics::Mass{} : all_[member].mass; }
    static physics::uint shared(const Joint& left, const Joint& right) {
        return physics::shared_ends(left.member_a, left.member_b, right.member_a, right.member_b);
    }
    physics::Couple speeds(const Joint& joint) const { return {speed(joint.a, joint.member_a), speed(joint.b, joint.member_b)}; }
    // In the biased pass with what the contacts have done, whose slots come before those of the blocks.
    void take_velocities(bool biased) {
        for (Joint& record : members_) {
            const physics::uint body = record.member;
            physics::Velocity velocity = state_.velocities[body];
            if (biased && record.slot != NONE) {
                const std::size_t first = body == 0 ? 0 : state_.slot_ends[body - 1];
                for (std::size_t k = first; k < state_.slot_ends[body] - record.blocks; ++k)
                    velocity = physics::changed_by(velocity, state_.slots[k]);
            }
            record.velocity = record.velocity_before = velocity;
        }
    }

    void push(const Joint& joint, physics::uint k, float impulse) {
        const JointRow& row = joint.rows[k];
        for (const End end : {End{joint.member_a, false}, End{joint.member_b, true}}) {
            if (end.member == NONE) continue;
            Joint& record = all_[end.member];
            record.velocity = physics::row_pushed(record.velocity, row.direction, arm(row, end.is_b),
                                                  end.is_b ? impulse : -impulse, physics::is_linear(k), record.mass);
        }
    }

    // The entry of row n of a joint and a row of another, of that response.
    static float entry(const Joint& left, physics::uint n, const Joint& right, const physics::RowResponse& to) {
        const JointRow& row = left.rows[n];
        return physics::row_entry(row.direction, row.arm_a, row.arm_b, n, to, shared(left, right));
    }

    void apply_given(Joint& joint, bool biased) {
        joint.solved = 0;
        const physics::Couple before{speed(joint.a, NONE), speed(joint.b, NONE)};
        for_each_axis(joint, [&](physics::uint k, const physics::JointAxis& axis, JointRow& row) {
            const physics::uint pin = physics::pins_of(joint.pins, k);
            if (physics::row_is_unknown(axis, row, pin, biased, p_)) joint.solved |= 1u << k;
            row = physics::row_given(axis, row, pin, physics::row_speed(row, k < 3, before), biased, p_);
            const float given = physics::given_change(row);
            if (given != 0) push(joint, k, given);
        });
    }

    void set_up(Joint& joint, bool biased) {
        const physics::Couple v = speeds(joint);
        for (physics::uint k = 0; k < 6; ++k) {
            if (!unknown(joint, k)) continue;
            const JointRow& row = joint.rows[k];
            const physics::Demand wants = physics::row_demand(joint.axes[k], row, k, physics::pins_of(joint.pins, k), biased, p_);
            const physics::RowResponse to = physics::row_response(row, k, mass(joint.member_a), mass(joint.member_b));
            joint.solution[k] = physics::right_hand_side(physics::row_speed(row, k < 3, v), wants);
            for (physics::uint n = k; n < 6; ++n)
                if (unknown(joint, n)) joint.diagonal[6 * n + k] = entry(joint, n, joint, to);
            joint.diagonal[7 * k] = physics::softened(joint.diagonal[7 * k], wants);
            for (physics::uint l = 0; l < joint.links; ++l)
                for (physics::uint n = 0; n < 6; ++n)
                    if (const Joint& later = all_[joint.links_to[l]]; unknown(later, n))
                        joint.coupling[36 * l + 6 * n + k] = entry(later, n, joint, to);
        }
    }

    static float* coupling(Joint& joint, physics::uint with) {
        const std::span links(joint.links_to, joint.links);
        return joint.coupling + 36 * (std::find(links.begin(), links.end(), with) - links.begin());
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
        for (physics::uint l = 0; l < joint.links; ++l) {
            Joint& later = all_[joint.links_to[l]];
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
                    Joint& middle = all_[joint.links_to[e]];
                    float* theirs = coupling(middle, joint.links_to[l]);
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
        for (physics::uint l = 0; l < joint.links; ++l)
            for (physics::uint n = 0; n < 6; ++n)
                if (const Joint& later = all_[joint.links_to[l]]; unknown(later, n))
                    sum = physics::less_multiple(sum, joint.coupling[36 * l + 6 * n + k], later.solution[n]);
        joint.solution[k] = physics::substituted(sum, joint.diagonal[7 * k]);
    }

    bool other_bounds(Joint& joint, bool biased, bool settling) {
        const physics::Couple v = speeds(joint);
        const physics::uint before = joint.pins;
        for_each_axis(joint, [&](physics::uint k, const physics::JointAxis& axis, JointRow& row) {
            const physics::uint pin = physics::pins_of(joint.pins, k);
            const bool solved = unknown(joint, k);
            const float solution = solved ? joint.solution[k] : 0;
            const physics::RowAfter after =
                physics::row_after_round(axis, row, k, pin, solved, solution, v, biased, settling, p_);
            row = after.row;
            joint.pins = physics::with_pins(joint.pins, k, after.pin);
        });
        return joint.pins != before;
    }

    State& state_;
    const physics::Parameters& p_;
    std::vector<Joint>& all_;
    std::size_t first_;
    std::span<Joint> joints_, members_;
};

bool movable(const State& state, std::uint32_t body) {
    return physics::any_stirs(state.counted()) &&
           physics::is_movable(state.traits[body].motion, state.rests[body], state.fixed().sleep_steps);
}

template <class Work>
void for_each_block(State& state, const Threads& threads, const Work& work) {
    if (state.counted().overflow) return;
    // A block is as much work as many contacts: all threads take part although there are few.
    const std::size_t blocks = state.fixed().joint_blocks;
    const std::size_t parts = threads.count() == 1 ? 1 : 128;
    threads.for_each(parts, [&](std::size_t part) {
        for (std::size_t i = part * blocks / parts; i < (part + 1) * blocks / parts; ++i) work(Block(state, i));
    });
}

void take_stock(Joint& joint, const State& state) {
    const physics::JointLoad load =
        physics::mean_load({joint.force, joint.greatest_force, joint.torque, joint.greatest_torque}, state.fixed());
    joint.force = load.force;
    joint.greatest_force = load.greatest_force;
    joint.torque = load.torque;
    joint.greatest_torque = load.greatest_torque;
    if (!physics::joint_tears(joint.force, joint.break_force, joint.torque, joint.break_torque)) return;
    joint.broken = 1;
    joint.pins = 0;
    for (JointRow& row : joint.rows) row = physics::torn(row);
}

}  // namespace

void wake_joined(State& state, const Threads& threads, std::uint32_t wakes) {
    if (!state.counted().sleepers || !physics::any_stirs(state.counted())) return;
    const auto restless = [&](physics::uint body) {
        return body != NONE && physics::stirs_joined(state.traits[body].motion, state.velocities[body], state.rests[body]);
    };
    for_each_block(state, threads, [&](Block block) {
        if (!wakes) {
            block.joints()[0].restless = 0;
            block.for_each_whole([&](const Joint& joint) {
                if (restless(joint.a) || restless(joint.b)) block.joints()[0].restless = 1;
            });
        } else if (block.joints()[0].restless) {
            for (const Joint& record : block.members()) {
                const std::atomic_ref rest(state.rests[record.member]);
                if (physics::has_slept(rest.load(std::memory_order_relaxed), state.fixed().sleep_steps))
                    rest.fetch_or(physics::WOKEN, std::memory_order_relaxed);
            }
        }
    });
}

void count_joint_slots(State& state, const Threads& threads, std::uint32_t) {
    const auto gone = [&](physics::uint body) { return body != NONE && physics::is_absent(state.traits[body].motion); };
    for_each_block(state, threads, [&](const Block& block) {
        for (Joint& joint : block.joints())
            if (gone(joint.a) || gone(joint.b)) joint.broken = 1;
        for (Joint& record : block.members()) {
            record.slot = NONE;
            if (movable(state, record.member)) std::atomic_ref(state.slot_ends[record.member]).fetch_add(1);
        }
    });
}

void fill_joint_slots(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [&](const Block& block) {
        for (const Joint& record : block.members()) {
            if (!movable(state, record.member)) continue;
            const std::uint32_t slot = std::atomic_ref(state.slot_ends[record.member]).fetch_add(1);
            state.slot_sides[slot] = physics::OF_JOINT | static_cast<std::uint32_t>(&record - state.joints.data());
        }
    });
}

void prepare_joints(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [](Block block) {
        if (!block.moves()) return;
        block.note_pressing();
        block.lend(true);
        block.place(false);
        block.for_each_whole([](Joint& joint) { joint.force = joint.torque = vec3(0); });
        block.gather(physics::row_impulse);
        block.hand_out([](const Joint& record) { return record.pressed; });
    });
}

void solve_joints(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [](Block block) {
        if (!block.moves()) return;
        block.solve(true);
        block.gather([](const JointRow& row) { return physics::handed_impulse(row, /* warms */ false); });
        block.for_each_whole(Block::commit);
        block.hand_out([](const Joint&) { return 0.0f; });
    });
}

void relax_joints(State& state, const Threads& threads, std::uint32_t last) {
    for_each_block(state, threads, [&](Block block) {
        if (!block.moves()) return;
        block.solve(false);
        block.gather([&](const JointRow& row) { return physics::handed_impulse(row, /* warms */ !last); });
        float told = physics::FOREVER;
        block.for_each_whole([&](Joint& joint) {
            Block::commit(joint);
            joint.force += Block::impulse_of(joint, 0);
            joint.torque += Block::impulse_of(joint, 3);
            if (last) take_stock(joint, state);
        });
        block.for_each_whole([&](const Joint& joint) {
            for (const physics::uint body : {joint.a, joint.b})
                if (last && body != NONE)
                    told =
                        std::min(told, physics::told_quiet(state.traits[body].motion, state.velocities[body], state.rests[body]));
        });
        block.note_pressing();
        block.hand_out([&](const Joint& record) { return last ? told : record.pressed; });
    });
}

}  // namespace scree::reference
