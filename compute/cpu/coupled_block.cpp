// The pass over a block of joints with couplings: as that over others, with the border of couplings around its equations.
#include <array>
#include <cstddef>

#include "compute/cpu/joint_block.h"

namespace scree::reference {

using physics::Joint;
using physics::JointRow;
using physics::NONE;
using physics::uint;

namespace {

constexpr physics::JointRotor no_rotor{};

float factor_of(const Joint& coupling, uint t) {
    return (t < 4 ? coupling.frame_a : coupling.frame_b)[static_cast<int>(t % 4)];
}
// Calls visit(joint's index in the table, axis, factor) for each term.
template <class Visit>
void for_each_term(const Joint& coupling, const Visit& visit) {
    for (uint t = 0; t < physics::terms_of_coupling(coupling.flags); ++t)
        visit(physics::joint_of_term(coupling.fill_in_of[t]), physics::axis_of_term(coupling.fill_in_of[t]),
              factor_of(coupling, t));
}

physics::JointAxis coupling_axis(const Joint& coupling) {
    return physics::axis_of_coupling(coupling.axes[0], coupling.flags);
}
// The axis whose unit, m or rad, the coupling has: that of its first term.
uint index_of(const Joint& coupling) {
    return physics::axis_of_term(coupling.fill_in_of[0]);
}

}  // namespace

bool JointBlock::acts(const Joint& coupling) const {
    bool whole = !coupling.broken && physics::terms_of_coupling(coupling.flags) != 0;
    for_each_term(coupling, [&](uint joint, uint, float) { whole = whole && !all_[joint].broken; });
    return whole;
}

void JointBlock::place_couplings() {
    for_each_coupling([&](Joint& coupling) {
        const uint count = physics::terms_of_coupling(coupling.flags);
        physics::CoupledSum sum{};
        for (uint t = 0; t < count; ++t) {
            const Joint& joint = all_[physics::joint_of_term(coupling.fill_in_of[t])];
            const uint k = physics::axis_of_term(coupling.fill_in_of[t]);
            const JointRow& row = joint.rows[k];
            const float turns = physics::turns_of_term(k, row.coordinate, joint.twist);
            if ((coupling.flags & physics::JOINT_CURVED) == 0 || t + 1 != count) {
                sum = physics::with_term(sum, factor_of(coupling, t), row, turns);
                continue;
            }
            const physics::CurvePoint at = physics::point_of_curve(coupling.frame_b, physics::with_turns(row.coordinate, turns));
            sum = physics::with_curve(sum, at, row, physics::row_speed(row, physics::is_linear(k), speeds(joint)), p_.h);
            coupling.frame_a[static_cast<int>(t)] = at.slope;
        }
        coupling.rows[0] = physics::row_of_coupling(coupling.rows[0], sum, coupling.anchor_a.x);
    });
}

void JointBlock::commit_couplings(bool with_load) {
    for_each_coupling([&](Joint& coupling) {
        coupling.rows[0] = physics::committed(coupling.rows[0]);
        if (!with_load) return;
        float& load = physics::is_linear(index_of(coupling)) ? coupling.force.x : coupling.torque.x;
        load += physics::row_impulse(coupling.rows[0], no_rotor);
    });
}

// ---- impulses
float JointBlock::with_couplings(float normal_impulse, const Joint& joint) {
    for_each_coupling([&](const Joint& coupling) {
        for_each_term(coupling, [&](uint of, uint k, float factor) {
            if (&all_[of] == &joint && physics::is_linear(k))
                normal_impulse = physics::with_push(normal_impulse, factor, physics::row_impulse(coupling.rows[0], no_rotor));
        });
    });
    return normal_impulse;
}
// Adds a coupling's impulse, times its factors, to the impulses of its joints' rows.
void JointBlock::add_to_terms(const Joint& coupling, float impulse) {
    if (impulse == 0) return;
    for_each_term(coupling, [&](uint of, uint k, float factor) {
        CoupledJoint& joint = coupled(all_[of]);
        const float before = (joint.axes >> k & 1) != 0 ? joint.impulses[k] : 0;
        joint.impulses[k] = physics::with_part(before, factor, impulse);
        joint.axes |= 1u << k;
    });
}
void JointBlock::push_coupled() {
    for_each_whole([&](Joint& joint) {
        const CoupledJoint& of = coupled(joint);
        if (of.axes != 0) push(joint, of.axes, of.impulses);
    });
}

void JointBlock::gather_coupled(const std::function<float(const JointRow&, const physics::JointRotor&)>& impulse) {
    if (room_->coupled.size() < joints_.size()) room_->coupled.resize(joints_.size());
    for (BlockBody& body : members_) {
        body.velocity = {};
        body.mass.split = 1;
    }
    for (Joint& joint : joints_) coupled(joint).axes = 0;
    for_each_whole([&](Joint& joint) {
        CoupledJoint& of = coupled(joint);
        for_each_axis(joint, [&](uint k, const physics::JointAxis&, const JointRow& row) {
            of.impulses[k] = impulse(row, joint.rotors[k]);
            if (of.impulses[k] != 0) of.axes |= 1u << k;
        });
    });
    for_each_coupling([&](Joint& coupling) {
        if (physics::row_acts(coupling_axis(coupling), coupling.rows[0]))
            add_to_terms(coupling, impulse(coupling.rows[0], no_rotor));
    });
    push_coupled();
}

// ---- a round
float JointBlock::speed_of_coupling(const Joint& coupling, bool before) const {
    float sum = 0;
    for_each_term(coupling, [&](uint of, uint k, float factor) {
        const Joint& joint = all_[of];
        const physics::VelocityPair v =
            before ? physics::VelocityPair{speed(joint.a, NONE), speed(joint.b, NONE)} : speeds(joint);
        sum = physics::with_part(sum, factor, physics::row_speed(joint.rows[k], physics::is_linear(k), v));
    });
    return sum;
}

void JointBlock::solve_coupled(bool biased) {
    if (room_->coupled.size() < joints_.size()) room_->coupled.resize(joints_.size());
    place_couplings();
    for (Joint& joint : joints_) joint.solved_axes = 0;
    bool others = true;
    for (uint round = 0; round < physics::JOINT_ROUNDS && others; ++round) {
        for (BlockBody& member : members_) member.velocity = member.velocity_before;
        for (Joint& joint : joints_) {
            coupled(joint).axes = 0;
            coupled(joint).unknown = false;
        }
        for_each_whole([&](Joint& joint) {
            CoupledJoint& of = coupled(joint);
            of.axes = choose_given(joint, biased, of.impulses);
        });
        for_each_coupling([&](Joint& coupling) {
            const physics::JointAxis axis = coupling_axis(coupling);
            JointRow& row = coupling.rows[0];
            if (!physics::row_acts(axis, row)) return;
            const uint active_flags = physics::active_set_of(coupling.active_set, 0);
            coupled(coupling).unknown = physics::row_is_unknown(axis, row, active_flags, biased, p_);
            row = physics::row_given(axis, row, active_flags, speed_of_coupling(coupling, true), biased, p_);
            add_to_terms(coupling, physics::given_push(axis, row));
        });
        push_coupled();
        for_each_whole([&](Joint& joint) { demand(joint, biased); });
        for_each_coupling([&](Joint& coupling) {
            CoupledJoint& of = coupled(coupling);
            if (!of.unknown) return;
            const physics::RowTarget wants =
                physics::row_demand(coupling_axis(coupling), coupling.rows[0], no_rotor, index_of(coupling),
                                    physics::active_set_of(coupling.active_set, 0), biased, p_);
            of.solution = physics::right_hand_side(speed_of_coupling(coupling, false), wants.bias);
            of.compliance = wants.compliance;
        });
        solve_coupled_equations();
        others = false;
        for_each_whole([&](Joint& joint) { others |= other_bounds(joint, biased, round >= physics::SETTLING_ROUND); });
        for_each_coupling(
            [&](Joint& coupling) { others |= other_bounds_of_coupling(coupling, biased, round >= physics::SETTLING_ROUND); });
    }
    block_.unsettled = others;
}

bool JointBlock::other_bounds_of_coupling(Joint& coupling, bool biased, bool settling) {
    const physics::JointAxis axis = coupling_axis(coupling);
    if (!physics::row_acts(axis, coupling.rows[0])) return false;
    const CoupledJoint& of = coupled(coupling);
    const uint before = coupling.active_set;
    const physics::RowAfter after = physics::row_after_round(
        axis, coupling.rows[0], no_rotor, index_of(coupling), physics::active_set_of(before, 0), of.unknown,
        of.unknown ? of.solution : 0, speed_of_coupling(coupling, false), biased, settling, p_);
    coupling.rows[0] = after.row;
    coupling.active_set = physics::with_active_set(before, 0, after.active_flags);
    return coupling.active_set != before;
}

// ---- equations
// The entry of row k of a joint with a coupling's row.
float JointBlock::coupled_entry(const Joint& joint, uint k, const Joint& coupling) const {
    float sum = 0;
    for_each_term(coupling, [&](uint of, uint axis, float factor) {
        const Joint& other = all_[of];
        if (physics::shared_ends(joint.block_body_a, joint.block_body_b, other.block_body_a, other.block_body_b) == 0) return;
        const physics::RowResponse to =
            physics::row_response(other.rows[axis], axis, mass(other.block_body_a), mass(other.block_body_b));
        sum = physics::with_entry(sum, factor, entry(joint, k, other, to));
    });
    return sum;
}
float JointBlock::entry_between(const Joint& coupling, const Joint& other) const {
    float sum = 0;
    for_each_term(coupling, [&](uint of, uint k, float factor) {
        sum = physics::with_entry(sum, factor, coupled_entry(all_[of], k, other));
    });
    return sum;
}

void JointBlock::solve_coupled_equations() {
    for_each_whole([&](Joint& joint) { set_up(joint); });
    for_each_whole([&](Joint& joint) { for_each_unknown(joint, [&](uint k) { eliminate(joint, k); }); });
    solve_border();
    for (std::size_t j = joints_.size(); j-- > 0;)
        for (uint k = 6; k-- > 0;)
            if (!joints_[j].broken && unknown(joints_[j], k)) substitute(joints_[j], k);
    for_each_whole([&](Joint& joint) {
        CoupledJoint& of = coupled(joint);
        of.axes = joint.solved_axes;
        for_each_unknown(joint, [&](uint k) { of.impulses[k] = equations(joint).solution[k]; });
    });
    for_each_coupling([&](Joint& coupling) {
        if (coupled(coupling).unknown) add_to_terms(coupling, coupled(coupling).solution);
    });
    push_coupled();
}

void JointBlock::solve_border() {
    const std::span<Joint> all = couplings();
    const std::span<Joint> inner = joints_.first(joints_.size() - all.size());
    const auto place = [&](const Joint& joint) { return 6 * static_cast<std::size_t>(&joint - joints_.data()); };
    const auto for_each_row = [&](const auto& visit) {  // visit(place, axis, equations)
        for (const Joint& joint : inner) for_each_unknown(joint, [&](uint k) { visit(place(joint) + k, k, equations(joint)); });
    };
    // Forward elimination of the border by the joints' factors.
    for (const Joint& coupling : all) {
        if (!coupled(coupling).unknown) continue;
        float* const column = coupled(coupling).column;
        for (const Joint& joint : inner)
            for_each_unknown(joint, [&](uint k) { column[place(joint) + k] = coupled_entry(joint, k, coupling); });
        for (const Joint& joint : inner) {
            const physics::JointEquations& own = equations(joint);
            for_each_unknown(joint, [&](uint k) {
                const float entry = column[place(joint) + k], inverse = own.tiles[7 * k];
                if (entry == 0) return;
                const auto lessen = [&](std::size_t at, float factor) {
                    column[at] = physics::less_multiple(column[at], physics::multiplier_of(factor, inverse), entry);
                };
                for (uint n = k + 1; n < 6; ++n)
                    if (unknown(joint, n)) lessen(place(joint) + n, own.tiles[6 * n + k]);
                for (uint l = 0; l < joint.fill_in; ++l) {
                    const Joint& later = all_[joint.fill_in_of[l]];
                    for_each_unknown(later, [&](uint n) { lessen(place(later) + n, own.tiles[36 + 36 * l + 6 * n + k]); });
                }
            });
        }
    }
    // Elimination of the couplings themselves.
    for (std::size_t g = 0; g < all.size(); ++g) {
        CoupledJoint& own = coupled(all[g]);
        if (!own.unknown) continue;
        // Eliminates the joints' rows and the couplings before `before` from an entry.
        const auto eliminated = [&](float entry, const CoupledJoint& with, std::size_t before) {
            for_each_row([&](std::size_t at, uint k, const physics::JointEquations& rows) {
                if (with.column[at] == 0 || own.column[at] == 0) return;
                entry = physics::less_multiple(entry, physics::multiplier_of(with.column[at], rows.tiles[7 * k]), own.column[at]);
            });
            for (std::size_t e = 0; e < before; ++e) {
                const CoupledJoint& earlier = coupled(all[e]);
                const std::size_t at = place(all[e]);
                if (earlier.unknown)
                    entry = physics::less_multiple(entry, physics::multiplier_of(with.column[at], earlier.inverse_pivot),
                                                   own.column[at]);
            }
            return entry;
        };
        for (std::size_t e = 0; e < g; ++e)
            if (coupled(all[e]).unknown)
                own.column[place(all[e])] = eliminated(entry_between(all[e], all[g]), coupled(all[e]), e);
        own.inverse_pivot =
            physics::reciprocal(eliminated(physics::softened(entry_between(all[g], all[g]), own.compliance), own, g));
        for_each_row([&](std::size_t at, uint k, const physics::JointEquations& rows) {
            if (own.column[at] != 0)
                own.solution = physics::less_multiple(own.solution, physics::multiplier_of(own.column[at], rows.tiles[7 * k]),
                                                      rows.solution[k]);
        });
        for (std::size_t e = 0; e < g; ++e) {
            const CoupledJoint& earlier = coupled(all[e]);
            if (earlier.unknown)
                own.solution = physics::less_multiple(
                    own.solution, physics::multiplier_of(own.column[place(all[e])], earlier.inverse_pivot), earlier.solution);
        }
    }
    // Back substitution, then the couplings' impulses on the joints' right-hand sides.
    for (std::size_t g = all.size(); g-- > 0;) {
        CoupledJoint& own = coupled(all[g]);
        if (!own.unknown) continue;
        for (std::size_t later = g + 1; later < all.size(); ++later)
            if (coupled(all[later]).unknown)
                own.solution =
                    physics::less_multiple(own.solution, coupled(all[later]).column[place(all[g])], coupled(all[later]).solution);
        own.solution = physics::substituted(own.solution, own.inverse_pivot);
    }
    for (const Joint& coupling : all) {
        const CoupledJoint& own = coupled(coupling);
        if (!own.unknown) continue;
        for (const Joint& joint : inner)
            for_each_unknown(joint, [&](uint k) {
                float& side = equations(joint).solution[k];
                if (own.column[place(joint) + k] != 0)
                    side = physics::less_multiple(side, own.column[place(joint) + k], own.solution);
            });
    }
}

}  // namespace scree::reference
