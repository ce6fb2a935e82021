// Finding runs of stages that one workgroup can do.
#include "compute/plan/stage_fusion.h"

#include <algorithm>
#include <string>

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/joint/joint_block.h"

namespace scree {

namespace {

// A dispatch costs lavapipe 7 us, but a fused stage runs on one core: a step of 155 boxes with 238 contacts takes 2.0
// ms fused and 2.3 ms unfused, one with 552 contacts 3.7 and 4.0, on two cores that were also busy otherwise.
constexpr std::uint32_t most_contacts = 320;
constexpr std::uint32_t most_items = 2048;

bool is_small(const physics::Parameters& p) {
    return p.contact_capacity <= most_contacts && std::max(p.pair_capacity, p.bodies) <= most_items &&
           p.buckets + p.copies <= most_items + 1;
}

// lavapipe silently ends a shader's loops after 65,535 rounds in all, and one vector of its threads runs through
// everything here.
constexpr std::uint32_t most_rounds = 60000;
// Loop rounds of both passes over a contact: eight sweeps over four points each, and a few loops over the points. 160
// were measured.
constexpr std::uint32_t contact_rounds = 200;

// Substeps per dispatch. Bodies gather their slots one by one, twice a substep.
std::uint32_t substeps_at_once(const physics::Parameters& p, std::uint32_t threads) {
    const std::uint32_t rounds = (p.contact_capacity / threads + 1) * contact_rounds + 4 * p.contact_capacity + 2 * p.bodies;
    return std::max(1u, most_rounds / rounds);
}

// Loop rounds left for a joint block (shaders/stages/lib/pass_joints.glsl) if its bodies have some thousand contacts.
constexpr std::uint32_t most_joint_rounds = 50000;
// Rounds of a loop over the axes of a joint, with that of the enclosing loop over joints.
constexpr std::uint32_t axis_rounds = 7;
// Rounds of the loops over a joint's own six rows in its elimination: loading, factoring and storing them.
constexpr std::uint32_t own_rounds = 190;

using Names = std::vector<std::string>;

struct Run {
    std::string name;
    Names parts;
};

Names scan(const std::string& what) {
    return {"scan_" + what + "_sums", "scan_" + what + "_spine", "scan_" + what + "_offsets"};
}

Names joined(Names names, const Names& more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
}

// Longer runs precede those that they contain.
const std::vector<Run>& runs() {
    static const std::vector<Run> all = {
        {"scan_cells", scan("cells")},
        {"scan_pairs", scan("pairs")},
        {"bin_pairs", joined(joined({"count_pair_types"}, scan("pair_types")), {"fill_pair_types"})},
        {"scan_contacts", scan("contacts")},
        {"list_slots", joined(joined({"count_slots"}, scan("slots")), {"fill_slots", "sort_slots"})},
        {"scan_slots", scan("slots")},
        {"substeps", {"begin_substep", "solve_contacts", "move_bodies", "relax_contacts"}},
    };
    return all;
}

bool begins_at(const Run& run, const std::vector<Stage>& plan, std::size_t first) {
    return first + run.parts.size() <= plan.size() &&
           std::equal(run.parts.begin(), run.parts.end(), plan.begin() + static_cast<std::ptrdiff_t>(first),
                      [](const std::string& name, const Stage& stage) { return name == stage.name; });
}

// Number of consecutive repetitions of a run.
std::uint32_t times_at(const Run& run, const std::vector<Stage>& plan, std::size_t first) {
    std::uint32_t times = 0;
    while (begins_at(run, plan, first + times * run.parts.size())) ++times;
    return times;
}

// Whether nothing comes between the repetitions: a substep is told its number among those of its run.
bool is_whole(const Run& run, const std::vector<Stage>& plan, std::size_t first) {
    const auto begins = std::count_if(plan.begin(), plan.end(), [&](const Stage& stage) { return stage.name == run.parts[0]; });
    return times_at(run, plan, first) == static_cast<std::uint32_t>(begins);
}

// push.pass of shaders/stages/contacts/substeps.comp: `part` of `whole` substeps, after `before`.
std::uint32_t pass_of(std::uint32_t before, std::uint32_t part, std::uint32_t whole) {
    return before | part << 8 | whole << 16;
}

Stage in_one(const Run& run, const std::vector<Stage>& plan, std::size_t first) {
    Stage all;
    all.name = run.name;
    for (std::size_t k = 0; k < run.parts.size(); ++k) {
        const Stage& part = plan[first + k];
        for (const Access& access : part.reads) all.reads.push_back({access.table});
        for (const Access& access : part.writes) all.writes.push_back({access.table});
        all.tested_features |= part.tested_features;
        all.features |= part.features;
    }
    return all;
}

}  // namespace

std::vector<Stage> fused(const std::vector<Stage>& plan, const physics::Parameters& parameters, std::uint32_t threads) {
    if (!is_small(parameters)) return plan;
    std::vector<Stage> stages;
    for (std::size_t i = 0; i < plan.size();) {
        const auto run = std::find_if(runs().begin(), runs().end(),
                                      [&](const Run& each) { return begins_at(each, plan, i) && is_whole(each, plan, i); });
        if (run == runs().end()) {
            stages.push_back(plan[i++]);
            continue;
        }
        const std::uint32_t times = times_at(*run, plan, i), at_once = substeps_at_once(parameters, threads);
        for (std::uint32_t done = 0; done < times; done += at_once) {
            stages.push_back(in_one(*run, plan, i));
            stages.back().pass = pass_of(done, std::min(at_once, times - done), times);
        }
        i += times * run->parts.size();
    }
    set_barriers(stages);
    return stages;
}

namespace {

// Rounds of the loops over the terms of a coupling.
constexpr std::uint32_t term_rounds = most_coupled_axes + 1;

// Of the couplings of a block (shaders/stages/lib/pass_couplings.glsl): choosing, entries of the columns, their elimination by
// each joint, by each other, and what is left to the joints.
std::uint32_t coupled_rounds_of(std::span<const physics::Joint> joints, const physics::JointBlock& block, std::uint32_t threads) {
    const std::uint32_t couplings = block.couplings, inner = block.joints - couplings;
    if (couplings == 0) return 0;
    const auto shared = [&](std::uint32_t items) { return (items + threads - 1) / threads; };
    std::uint32_t column = 0;
    for (const physics::Joint& joint : joints.subspan(block.first_joint, inner))
        column += axis_rounds + 6 * (axis_rounds + joint.fill_in * axis_rounds);
    std::uint32_t pairs = 0;  // of couplings, by rounds of the threads
    for (std::uint32_t g = 0; g < couplings; ++g) pairs += shared(g + 1);
    return 8 * term_rounds * couplings + term_rounds * couplings * shared(6 * inner) + column * shared(couplings) +
           pairs * (term_rounds * term_rounds + axis_rounds * inner) + couplings * couplings * couplings / 4 +
           couplings * (axis_rounds * inner + 2 * couplings) + couplings * shared(6 * inner);
}

// Loop rounds of a pass over a block.
struct BlockRounds {
    std::uint32_t most = 0;  // in each of the pass's rounds
    std::uint32_t once = 0;
    void take(const BlockRounds& other) {
        most = std::max(most, other.most);
        once = std::max(once, other.once);
    }
    bool fit() const { return most + once <= most_joint_rounds; }
    std::uint32_t at_once() const {
        return std::clamp((most_joint_rounds - std::min(once, most_joint_rounds)) / std::max(1u, most), 1u,
                          physics::JOINT_ROUNDS);
    }
};
BlockRounds rounds_of(std::span<const physics::Joint> joints, const physics::JointBlock& block, std::uint32_t threads) {
    const auto shared = [&](std::uint32_t items) { return (items + threads - 1) / threads; };
    std::uint32_t each = (2 * axis_rounds + axis_rounds) * shared(block.joints) + 2 * shared(block.bodies);
    for (const physics::Joint& joint : joints.subspan(block.first_joint, block.joints)) {
        const std::uint32_t links = joint.fill_in, pairs = links * (links + 1) / 2;
        each += 4 * axis_rounds;                                // pushes to both bodies, twice
        each += own_rounds;                                     // its own rows
        each += (2 + 3 * axis_rounds) * shared(6 * links);      // rows of the joints linked with it
        each += (8 + 9 * axis_rounds) * shared(6 * pairs);      // and between two of them
        each += 6 * (axis_rounds + (links + 1) * axis_rounds);  // substitution
    }
    each += (1 + axis_rounds) * (physics::MAX_FILL_IN + 1) * shared(6 * block.joints);
    each += coupled_rounds_of(joints, block, threads);
    return {each, 8 * block.bodies + 30 * block.joints + 8 * axis_rounds * shared(block.joints) +
                      4 * term_rounds * block.couplings * block.joints};
}

}  // namespace

JointDispatches joint_dispatches(std::span<const physics::Joint> joints, std::span<const physics::JointBlock> blocks,
                                 std::uint32_t subgroup) {
    constexpr std::uint32_t most_threads = 128, few_threads = 32;
    JointDispatches found;
    const std::uint32_t threads = subgroup > 0 ? subgroup : most_threads;
    BlockRounds of_large, of_coupled, of_coupled_singly;
    for (const physics::JointBlock& block : blocks) {
        if (block.couplings != 0) {
            found.threads_a_coupled_block = threads;
            of_coupled.take(rounds_of(joints, block, threads));
            of_coupled_singly.take(rounds_of(joints, block, 1));
        } else if (block.joints <= physics::SMALL_BLOCK_JOINTS) {
            found.threads_a_small_block = subgroup > 0 ? 1 : few_threads;
        } else {
            found.threads_a_block = threads;
            of_large.take(rounds_of(joints, block, threads));
        }
    }
    found.rounds_at_once = of_large.at_once();
    const bool singly = subgroup > 0 && found.threads_a_coupled_block > 0 && of_coupled_singly.fit();
    if (singly) found.threads_a_coupled_block = 1;
    found.coupled_rounds_at_once = (singly ? of_coupled_singly : of_coupled).at_once();
    return found;
}

std::vector<Stage> dispatches_of(const Stage& stage, const JointDispatches& joints) {
    const bool prepares = stage.name == "prepare_joints";
    if (stage.domain != DispatchDomain::joint_blocks ||
        (stage.name != "solve_joints" && stage.name != "relax_joints" && !prepares))
        return {stage};
    std::vector<Stage> dispatches;
    const auto add_rounds = [&](const char* way, std::uint32_t threads, std::uint32_t at_once) {
        for (std::uint32_t done = 0; threads > 0 && done < physics::JOINT_ROUNDS; done += at_once) {
            Stage& part = dispatches.emplace_back(stage);
            part.way = way;
            part.threads_an_item = threads == 1 ? 0 : threads;
            part.pass |= done << 8 | std::min(at_once, physics::JOINT_ROUNDS - done) << 16;
            part.barrier_after = done + at_once < physics::JOINT_ROUNDS || stage.barrier_after;
        }
    };
    const bool coupled = joints.threads_a_coupled_block > 0;
    if (prepares) {
        dispatches.push_back(stage);
        if (!coupled) return dispatches;
        dispatches.back().barrier_after = false;
        dispatches.push_back(stage);
        dispatches.back().way = ".coupled";
        return dispatches;
    }
    if (joints.threads_a_small_block > 0 || (joints.threads_a_block == 0 && !coupled)) {
        Stage& small = dispatches.emplace_back(stage);
        const bool singly = joints.threads_a_small_block <= 1;
        small.way = singly ? ".singly" : ".small";
        small.threads_an_item = singly ? 0 : joints.threads_a_small_block;
        small.barrier_after = joints.threads_a_block == 0 && !coupled && stage.barrier_after;
    }
    add_rounds("", joints.threads_a_block, joints.rounds_at_once);
    if (coupled && !dispatches.empty()) dispatches.back().barrier_after = false;
    const bool singly = joints.threads_a_coupled_block == 1;
    add_rounds(singly ? ".coupled_singly" : ".coupled", joints.threads_a_coupled_block, joints.coupled_rounds_at_once);
    return dispatches;
}

std::vector<std::string> parts_of(const std::string& name) {
    const auto run = std::find_if(runs().begin(), runs().end(), [&](const Run& each) { return each.name == name; });
    return run == runs().end() ? std::vector{name} : run->parts;
}

}  // namespace scree
