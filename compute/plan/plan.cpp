// The plan of a step.
#include "compute/plan/plan.h"

#include <algorithm>

#include "shaders/physics/base/passes.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/continuous/clamping.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

std::uint32_t feature_bits(const SceneFeatures& features) {
    return (features.bounces ? physics::FEATURE_BOUNCES : 0) | (features.rolls ? physics::FEATURE_ROLLS : 0) |
           (features.round ? physics::FEATURE_ROUND : 0) | (features.tyres ? physics::FEATURE_TYRES : 0) |
           (features.moving_parts ? physics::FEATURE_PARTS : 0) | (features.reordered ? physics::FEATURE_REORDERED : 0) |
           (features.joints ? physics::FEATURE_JOINTS : 0) | (features.sums ? physics::FEATURE_SUMS : 0) |
           (features.surfaces ? physics::FEATURE_SURFACES : 0) | (features.filters ? physics::FEATURE_FILTERS : 0) |
           (features.copies ? physics::FEATURE_COPIES : 0) | (features.gravities ? physics::FEATURE_GRAVITIES : 0) |
           (features.blocks ? physics::FEATURE_BLOCKS : 0) | (features.ghosts ? physics::FEATURE_GHOSTS : 0) |
           (features.periodic ? physics::FEATURE_PERIODIC : 0);
}

struct Order {
    std::vector<Stage> stages;
    std::uint32_t features;
    void add(const std::string& name, std::uint32_t pass = 0) {
        const StageDeclaration& declared = stage_declaration(name);
        stages.push_back({declared, pass, features & declared.tested_features});
    }
    void add_scan(const std::string& what) {
        for (const char* part : {"_sums", "_spine", "_offsets"}) add("scan_" + what + part);
    }
};

bool has_pair_type(const SceneFeatures& features, std::uint32_t pair_type) {
    if (pair_type >= physics::PAIR_PERSISTENT) return true;
    if (pair_type == physics::PAIR_HULL_HULL) return features.hulls;
    if (pair_type >= physics::PAIR_SPHERE_TRIANGLE) return features.triangles;
    return pair_type < physics::PAIR_PLANE_CONVEX || features.convex || features.triangles;
}

const Access* written_by(const StageDeclaration& stage, Table table) {
    const auto found = std::find_if(stage.writes.begin(), stage.writes.end(), [&](const Access& a) { return a.table == table; });
    return found == stage.writes.end() ? nullptr : &*found;
}

// Tables that several stages write in parts are compared after the last of them.
void set_compared(std::vector<Stage>& stages) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
        for (const Access& access : stages[i].writes) {
            if (access.manner == Manner::unordered || access.manner == Manner::unfinished) continue;
            const Access* next = i + 1 < stages.size() ? written_by(stages[i + 1], access.table) : nullptr;
            if (access.manner == Manner::in_parts && next && next->manner == Manner::in_parts) continue;
            const BufferLength whole = table_infos()[static_cast<std::size_t>(access.table)].length;
            stages[i].compared.push_back({access.table, access.as_long_as.value_or(whole)});
        }
    }
}

std::vector<Table> tables_read_before_written(const std::vector<Stage>& stages) {
    std::vector<Table> lasting{Table::parameters}, written;
    const auto has = [](const std::vector<Table>& tables, Table table) {
        return std::find(tables.begin(), tables.end(), table) != tables.end();
    };
    for (const Stage& stage : stages) {
        for (const Access& access : stage.reads) {
            // A stage that accumulates over several passes initialises the table itself.
            const Access* own = written_by(stage, access.table);
            if (own && own->manner == Manner::unfinished) continue;
            if (!has(written, access.table) && !has(lasting, access.table)) lasting.push_back(access.table);
        }
        for (const Access& access : stage.writes)
            if (access.manner != Manner::some_only) written.push_back(access.table);
    }
    return lasting;
}

}  // namespace

std::vector<Stage> plan(int substeps, const SceneFeatures& features) {
    const bool convex = features.convex || features.triangles;
    Order s{{}, feature_bits(features)};
    // forces and actions, world bounds
    s.add("begin_step");
    if (features.periodic) s.add("enter_cell");
    s.add("apply_actions");
    if (features.fields) s.add("apply_fields");  // after impulses: a repeated step sees the same velocities
    if (features.vehicles) s.add("drive_vehicles");
    if (features.moving_parts) s.add("pose_parts");
    s.add("compute_bounds");
    // broadphase: pairs
    s.add_scan("cells");
    s.add("fill_cells");
    s.add("sort_cells");
    s.add(features.periodic ? "count_pairs_periodic" : "count_pairs");
    s.add_scan("pairs");
    s.add(features.periodic ? "fill_pairs_periodic" : "fill_pairs");
    s.add("match_pairs");
    // narrowphase: manifolds
    s.add("count_pair_types");
    s.add_scan("pair_types");
    s.add("fill_pair_types");
    for (std::uint32_t pair_type = 0; pair_type < physics::PAIR_TYPES; ++pair_type)
        if (has_pair_type(features, pair_type)) s.add(name_of_pair_type(pair_type), pair_type);
    if (features.blocks) s.add("drop_hidden");
    s.add(convex ? "predict_impacts_convex" : "predict_impacts");
    s.add("cull_speculative");
    // contacts
    s.add_scan("contacts");
    s.add("make_contacts");
    // waking
    s.add("wake_touched");
    s.add("wake_unsupported");
    for (std::uint32_t wakes = 0; features.joints && wakes < 2; ++wakes) s.add("wake_joined", wakes);
    for (std::uint32_t depth = physics::DEEPEST; depth > 1; --depth) s.add("propagate_wake", depth);
    // slots, warm starting
    s.add("count_slots");
    if (features.joints) s.add("count_joint_slots");
    s.add_scan("slots");
    s.add("fill_slots");
    if (features.joints) s.add("fill_joint_slots");
    s.add("sort_slots");
    s.add("warm_start_contacts");
    s.add("prepare_contacts");
    if (features.joints) s.add("prepare_joints");
    if (features.cohesion) s.add("prepare_cohesion");
    // solver
    for (int substep = 1; substep <= substeps; ++substep) {
        const std::uint32_t first = substep == 1 ? physics::PASS_FIRST : 0, last = substep == substeps ? physics::PASS_LAST : 0;
        if (features.cohesion) s.add("apply_cohesion");
        s.add("begin_substep", first | static_cast<std::uint32_t>(substeps - substep) << physics::PASS_FOLLOWING);
        for (const char* stage : {"pull_bonds", "take_bonds"})
            if (features.bonds) s.add(stage);
        s.add("solve_contacts");
        if (features.joints) s.add("solve_joints");
        s.add("move_bodies");
        s.add("relax_contacts", last | first | (features.sums ? physics::PASS_SUMS : 0));
        if (features.joints) s.add("relax_joints", last);
    }
    s.add("show_quiet_steps");
    s.add("end_step");
    // continuous collision
    for (std::uint32_t round = 0; round < physics::CCD_ROUNDS; ++round) {
        s.add(convex ? "find_impacts_convex" : "find_impacts", round);
        for (std::uint32_t half = 0; features.joints && half < 2; ++half) s.add("share_stops", 2 * round + half);
    }
    s.add("clamp_to_impact");
    if (features.moving_parts) s.add("pose_parts");
    // fracture
    for (const char* stage : {"find_broken", "return_excess_impulse", "break_bodies"})
        if (features.breaking) s.add(stage);
    set_barriers(s.stages);
    set_compared(s.stages);
    return std::move(s.stages);
}

void set_barriers(std::vector<Stage>& stages) {
    std::size_t first = 0;  // first stage since the last barrier
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const auto begin = stages.begin() + static_cast<std::ptrdiff_t>(first),
                   here = stages.begin() + static_cast<std::ptrdiff_t>(i);
        stages[i].barrier_after = i + 1 == stages.size();
        if (std::none_of(begin, here, [&](const Stage& before) { return conflict(before, *here); })) continue;
        stages[i - 1].barrier_after = true;
        first = i;
    }
}

const std::vector<Table>& lasting_tables() {
    static const std::vector<Table> all = tables_read_before_written(plan(1, SceneFeatures::everything()));
    return all;
}

}  // namespace scree
