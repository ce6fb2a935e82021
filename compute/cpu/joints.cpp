// Reference joint stages.
#include <algorithm>
#include <atomic>
#include <span>

#include "compute/cpu/equal_blocks.h"
#include "compute/cpu/joint_block.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

using physics::BlockBody;
using physics::Joint;
using physics::JointRow;
using physics::NONE;

bool may_move(const State& state, std::uint32_t body) {
    return physics::any_stirs(state.counted()) &&
           physics::is_movable(state.properties[body].motion, state.sleep_states[body], state.fixed().sleep_steps);
}

// Fine-grained parts: a block is as much work as many contacts, so all threads share even few blocks.
std::size_t parts_of(std::size_t items, const Threads& threads) {
    return threads.count() == 1 ? 1 : std::min<std::size_t>(items, 128);
}
template <class Work>
void for_all_blocks(State& state, const Threads& threads, const Work& work) {
    if (state.counted().overflow) return;
    const std::size_t blocks = state.fixed().joint_blocks, parts = parts_of(blocks, threads);
    threads.for_each(parts, [&](std::size_t part) {
        const std::size_t last = (part + 1) * blocks / parts;
        for (std::size_t i = part * blocks / parts; i < last; ++i) work(i);
    });
}
// Those that this rank solves.
template <class Work>
void for_each_block(State& state, const Threads& threads, const Work& work) {
    for_all_blocks(state, threads, [&](std::size_t i) {
        if (state.owns_block(state.joint_blocks[i])) work(JointBlock(state, i));
    });
}

// A pass over some blocks: begin(block, room), then the rows of a few blocks together, then finish(block).
template <class Begin, class Finish>
void pass_singly(State& state, int lanes, std::span<const std::uint32_t> indices, const Begin& begin, const Finish& finish) {
    constexpr std::size_t together = 64;  // joints whose rows are placed together: they stay in the cache
    thread_local JointRoom room;
    thread_local std::vector<JointBlock> blocks;
    room.wide = wide_joint_stages(lanes);
    if (room.equations.size() < most_wide_joints) room.equations.resize(most_wide_joints);
    while (!indices.empty()) {
        blocks.clear();
        room.joints.clear();
        std::size_t count = 0;
        for (std::size_t joints = 0; count < indices.size() && joints < together; ++count) {
            JointBlock& block = blocks.emplace_back(state, indices[count]);
            joints += block.joints().size();
            begin(block, room);
        }
        indices = indices.subspan(count);
        JointBlock::place_rows(room, blocks);
        for (JointBlock& block : blocks) finish(block);
    }
}

// A pass over the blocks that move: those of equal structure several at a time by solve_equal(), others by begin() and finish().
template <class Begin, class Finish, class SolveEqual>
void pass_over_blocks(State& state, const Threads& threads, const Begin& begin, const Finish& finish,
                      const SolveEqual& solve_equal) {
    if (state.counted().overflow) return;
    const JointGroups& groups = state.joint_groups;
    const int lanes = state.is_periodic() ? 1 : threads.lanes();  // lanes do not ask for images
    const std::size_t cuts = groups.cuts.size() - 1, parts = parts_of(cuts, threads);
    threads.for_each(parts, [&](std::size_t part) {
        thread_local EqualBlocks equal;
        thread_local std::vector<std::uint32_t> single, coupled;
        single.clear();
        coupled.clear();
        std::size_t at = groups.cuts[part * cuts / parts];
        const std::size_t last = groups.cuts[(part + 1) * cuts / parts];
        while (at < last) {
            at = equal.take(state, at, last, lanes);
            if (!equal.blocks().empty() && state.joint_blocks[equal.blocks().front()].couplings != 0)
                coupled.insert(coupled.end(), equal.blocks().begin(), equal.blocks().end());
            else if (!solve_equal(equal))
                single.insert(single.end(), equal.blocks().begin(), equal.blocks().end());
        }
        pass_singly(state, lanes, single, begin, finish);
        pass_singly(state, 1, coupled, begin, finish);
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
    JointBlock::tear(joint);
}

// Whether a body of the block has an active contact.
bool touches(const State& state, const BlockBody& member) {
    if (member.slot == NONE) return false;
    const std::size_t first = state.first_slot_of(member.body);
    const std::size_t contacts = state.slot_ends[member.body] - first - member.blocks;
    return std::any_of(&state.slots[first], &state.slots[first] + contacts,
                       [](const physics::VelocityDelta& slot) { return slot.weight > 0; });
}

bool sets_rotor_in_motion(const Joint& joint, const State& state) {
    const auto burden = [&](physics::uint body, physics::uint k) {
        if (body == NONE) return physics::IMMOVABLE_BURDEN;
        return physics::burden_of(state.properties[body], state.forces[body], !physics::is_linear(k), state.fixed());
    };
    for (physics::uint k = 0; k < 6; ++k) {
        if (!physics::has_rotor(joint.axes[k])) continue;
        const float a = burden(joint.a, k), b = burden(joint.b, k);
        if (physics::rotor_yields(physics::impulse_of_rotor(joint.rows[k], joint.rotors[k]), std::min(a, b)))
            return !touches(state, state.block_bodies[a < b ? joint.block_body_a : joint.block_body_b]);
    }
    return false;
}

// Tells the bodies of a block how long the least quiet of them has been quiet.
void tell_quiet(JointBlock& block, State& state) {
    float quiet = physics::FOREVER;
    block.for_each_whole([&](const Joint& joint) {
        if (sets_rotor_in_motion(joint, state)) quiet = physics::BESIDE_MOVING;
        for (const physics::uint body : {joint.a, joint.b})
            if (body != NONE)
                quiet = std::min(quiet, physics::quiet_steps_shown(state.properties[body].motion, state.velocities[body],
                                                                   state.sleep_states[body]));
    });
    for (const BlockBody& member : block.bodies())
        if (member.slot != NONE) state.neighbours_quiet[member.slot] = quiet;
}

}  // namespace

void wake_joined(State& state, const Threads& threads, std::uint32_t wakes) {
    if (!state.counted().sleepers || !physics::any_stirs(state.counted())) return;
    const auto restless = [&](physics::uint body) {
        return body != NONE &&
               physics::stirs_joined(state.properties[body].motion, state.velocities[body], state.sleep_states[body]);
    };
    for_each_block(state, threads, [&](JointBlock block) {
        if (!wakes) {
            block.restless() = 0;
            block.for_each_whole([&](const Joint& joint) {
                if (restless(joint.a) || restless(joint.b)) block.restless() = 1;
            });
        } else if (block.restless()) {
            for (const BlockBody& member : block.bodies()) {
                const std::atomic_ref rest(state.sleep_states[member.body]);
                if (physics::has_slept(rest.load(std::memory_order_relaxed), state.fixed().sleep_steps))
                    rest.fetch_or(physics::WOKEN, std::memory_order_relaxed);
            }
        }
    });
}

void share_stops(State& state, const Threads& threads, std::uint32_t pass) {
    if (state.counted().fast == 0) return;
    const std::size_t written = 1 - pass / 2 % 2, other = 1 - written;
    const auto stop = [&](const BlockBody& member, std::size_t k) {
        return std::atomic_ref(state.bounds[member.body].sweep.stops[k]);
    };
    const auto lower = [](std::atomic_ref<physics::uint> value, physics::uint to) {
        physics::uint was = value.load(std::memory_order_relaxed);
        while (to < was && !value.compare_exchange_weak(was, to, std::memory_order_relaxed)) continue;
    };
    for_each_block(state, threads, [&](JointBlock block) {
        const std::span<BlockBody> members = block.bodies();
        if (pass % 2 != 0) {
            for (const BlockBody& member : members)
                lower(stop(member, written), stop(member, other).load(std::memory_order_relaxed));
            return;
        }
        physics::uint stops[2 * physics::MAX_BLOCK_JOINTS];
        bool some = false;
        for (std::size_t m = 0; m < members.size(); ++m) {
            stops[m] = stop(members[m], written).load(std::memory_order_relaxed);
            some = some || physics::uintBitsToFloat(stops[m]) < 1;
        }
        const std::size_t first = block.first_body();
        for (bool changed = some; changed;) {
            changed = false;
            block.for_each_whole([&](const Joint& joint) {
                if (joint.block_body_a == NONE || joint.block_body_b == NONE) return;
                physics::uint &a = stops[joint.block_body_a - first], &b = stops[joint.block_body_b - first];
                const physics::uint least = std::min(a, b);
                if (a == b || physics::uintBitsToFloat(least) >= 1) return;
                a = b = least;
                changed = true;
            });
        }
        if (!some) return;
        for (std::size_t m = 0; m < members.size(); ++m) lower(stop(members[m], other), stops[m]);
    });
}

void count_joint_slots(State& state, const Threads& threads, std::uint32_t) {
    const auto gone = [&](physics::uint body) { return body != NONE && physics::is_out_of_play(state.properties[body].motion); };
    for_all_blocks(state, threads, [&](std::size_t i) {
        const JointBlock block(state, i);
        // On every rank: none owns a block whose bodies are all gone.
        for (Joint& joint : block.joints())
            if (gone(joint.a) || gone(joint.b)) joint.broken = 1;
        if (!state.owns_block(state.joint_blocks[i])) return;
        for (BlockBody& member : block.bodies()) {
            member.slot = NONE;
            if (may_move(state, member.body)) std::atomic_ref(state.slot_ends[member.body]).fetch_add(1);
        }
    });
}

void fill_joint_slots(State& state, const Threads& threads, std::uint32_t) {
    for_each_block(state, threads, [&](const JointBlock& block) {
        for (const BlockBody& member : block.bodies()) {
            if (!may_move(state, member.body)) continue;
            const std::uint32_t slot = std::atomic_ref(state.slot_ends[member.body]).fetch_add(1);
            state.slot_sides[slot] = physics::OF_JOINT | static_cast<std::uint32_t>(&member - state.block_bodies.data());
        }
    });
}

void prepare_joints(State& state, const Threads& threads, std::uint32_t) {
    const auto begin = [](JointBlock& block, JointRoom& room) {
        block.note_pressing();
        block.begin(room, /* lend_after_contacts */ true, /* take_after_contacts */ false);
    };
    const auto finish = [](JointBlock& block) {
        block.for_each_whole([](Joint& joint) { joint.force = joint.torque = vec3(0); });
        block.take_rotor_speeds();
        if (block.coupled()) block.place_couplings();
        block.gather_warm_start();
        block.write_deltas(1, true);
    };
    pass_over_blocks(state, threads, begin, finish, [](EqualBlocks&) { return false; });
}

void solve_joints(State& state, const Threads& threads, std::uint32_t) {
    const auto begin = [](JointBlock& block, JointRoom& room) { block.begin(room, true, true); };
    const auto finish = [](JointBlock& block) {
        block.solve(true);
        block.gather(/* warms */ false);
        block.for_each_whole([](Joint& joint) { JointBlock::commit(joint, /* warms */ false); });
        if (block.coupled()) block.commit_couplings(/* with_load */ false);
        block.write_deltas(0, false);
    };
    pass_over_blocks(state, threads, begin, finish, [&](EqualBlocks& equal) { return equal.solve(state); });
}

void relax_joints(State& state, const Threads& threads, std::uint32_t last) {
    const auto begin = [](JointBlock& block, JointRoom& room) {
        const bool struck = block.struck();
        block.begin(room, struck, struck);
    };
    // The impulses of an impact must not warm start the next substep.
    const auto end = [&](JointBlock& block) {
        const bool struck = block.struck();
        block.for_each_whole([&](Joint& joint) {
            if (last) take_stock(joint, state);
            if (struck) JointBlock::tear(joint);
        });
        block.note_pressing();
        block.write_deltas(1, true);
        if (last) tell_quiet(block, state);
    };
    const auto finish = [&](JointBlock& block) {
        block.solve(false);
        const bool warms = !last && !block.struck();
        block.gather(warms);
        if (block.coupled()) block.commit_couplings(/* with_load */ true);
        block.for_each_whole([&](Joint& joint) {
            JointBlock::commit(joint, warms);
            joint.force += JointBlock::impulse_of(joint, 0);
            joint.torque += JointBlock::impulse_of(joint, 3);
        });
        end(block);
    };
    pass_over_blocks(state, threads, begin, finish, [&](EqualBlocks& equal) {
        if (!equal.relax(state, last != 0)) return false;
        for (const std::uint32_t index : equal.blocks()) {
            JointBlock block(state, index);
            if (last) end(block);
        }
        return true;
    });
}

}  // namespace scree::reference
