// Initial tables: parameters from settings, properties from shapes and materials, capacities from a first guess.
#include "compute/compile/scene_compiler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "compute/compile/grid_layout.h"
#include "compute/compile/joint_blocks.h"
#include "compute/scene/vehicle_records.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

// The grid and its list of large bodies, from the first copy of the scene: rows in the order of bodies, then parts.
void lay_out_grid(std::vector<physics::BodyProperties>& properties, physics::Parameters& p, std::uint32_t bodies) {
    const std::size_t rows = properties.size(), n = bodies / p.copies, parts = (rows - bodies) / p.copies;
    const auto in_first_copy = [&](std::size_t row) { return row < bodies ? row % n : bodies + (row - bodies) % parts; };
    const auto for_first_copy = [&](const auto& visit) {
        for (std::size_t row = 0; row < n; ++row) visit(properties[row]);
        for (std::size_t row = bodies; row < bodies + parts; ++row) visit(properties[row]);
    };
    GridLayout layout;
    for_first_copy([&](const physics::BodyProperties& row) { layout.note_width(row, p); });
    layout.choose_cell(p);
    for_first_copy([&](const physics::BodyProperties& row) { layout.note_level(row); });
    layout.choose_levels();
    for_first_copy([&](physics::BodyProperties& row) {
        if (layout.is_large(row)) row.flags |= physics::ROW_LARGE;
    });
    for (std::size_t row = 0; row < rows; ++row)
        properties[row].flags |= properties[in_first_copy(row)].flags & physics::ROW_LARGE;
}

}  // namespace

bool is_stretching(const physics::Parameters& p) {
    return p.cell_rate != vec3(0);
}

void set_period(physics::Parameters& p, const PeriodicCell& cell) {
    p.period = cell.size;
    p.cell_centre = cell.centre;
    for (int k = 0; k < 3; ++k) {
        p.half_period[k] = cell.size[k] > 0 ? 0.5f * cell.size[k] : 1e30f;
        p.inverse_period[k] = cell.size[k] > 0 ? 1 / cell.size[k] : 0.0f;
    }
    p.cell_rate = physics::flush_tiny(cell.rate);
}

PeriodicCell periodic_cell(const physics::Parameters& p) {
    return {p.period, p.cell_centre, p.cell_rate};
}

physics::Parameters tuned(physics::Parameters p, vec3 gravity, const Settings& settings) {
    p.gravity = physics::flush_tiny(gravity);
    p.dt = 1 / settings.rate;
    p.h = p.dt / static_cast<float>(settings.substeps);
    p.inverse_h = 1 / p.h;
    // Soft constraint coefficients (Catto, Soft Constraints, GDC 2011).
    const float omega = 2 * std::numbers::pi_v<float> * settings.contact_hertz * p.inverse_h;
    const float a1 = 2 * settings.contact_damping_ratio + p.h * omega;
    const float a2 = p.h * omega * a1;
    p.bias_rate = omega / a1;
    p.mass_scale = a2 / (1 + a2);
    p.impulse_scale = 1 / (1 + a2);
    p.push_speed = settings.push_speed;
    p.inverse_relaxation = 1 / settings.relaxation;
    p.speculative = settings.speculative_distance;
    p.restitution_threshold = settings.restitution_threshold;
    p.max_speed = settings.max_speed;
    p.max_spin = settings.max_turn * p.inverse_h;
    p.sleep_speed = settings.sleep_speed;
    p.sleep_steps = is_stretching(p) ? physics::NO_SLEEP : sleep_steps_of(settings);
    p.friction_factor = settings.friction_factor;
    p.least_restitution = settings.least_restitution;
    return p;
}

std::vector<physics::uvec4> records_of_gravities(const std::vector<vec3>& gravities) {
    std::vector<physics::uvec4> records;
    for (const vec3& one : gravities) {
        const vec3 gravity = physics::flush_tiny(one);
        records.emplace_back(std::bit_cast<physics::uint>(gravity.x), std::bit_cast<physics::uint>(gravity.y),
                             std::bit_cast<physics::uint>(gravity.z), 0u);
    }
    return records;
}

void set_first_capacities(physics::Parameters& p, const Settings& settings, std::uint32_t bodies, std::uint32_t ranks) {
    p.pair_capacity = settings.pairs_at_first ? settings.pairs_at_first : 64 + 2 * bodies / ranks;
    p.contact_capacity = settings.contacts_at_first ? settings.contacts_at_first : 64 + bodies / 2 / ranks;
}

physics::uint sleep_steps_of(const Settings& settings) {
    return settings.sleeping ? std::max(1u, static_cast<physics::uint>(std::ceil(settings.sleep_time * settings.rate)))
                             : physics::NO_SLEEP;
}

void SceneCompiler::compile(const Scene& scene, const Settings& settings, std::uint32_t group_size, std::uint32_t copies,
                            std::uint32_t ranks) {
    check_couplings(scene);
    shares_meshes_ = copies > 1;
    std::vector<physics::BodyProperties>& properties = state_.properties;
    const auto n = static_cast<std::uint32_t>(scene.bodies.size());
    properties.reserve(n + 1);
    for (std::uint32_t i = 0; i < n; ++i) properties.push_back(properties_of(scene.bodies[i], i));
    for (std::uint32_t i = 0; i < n; ++i) append_parts(scene.bodies[i], i);
    const auto rows = static_cast<std::uint32_t>(properties.size());
    const auto moving = static_cast<std::uint32_t>(
        std::count_if(properties.begin() + n, properties.end(),
                      [](const physics::BodyProperties& part) { return physics::motion_of(part) != physics::MOTION_FIXED; }));

    physics::Parameters first{};
    set_period(first, scene.periodic);
    state_.parameters.assign(1, tuned(first, scene.gravity, settings));
    physics::Parameters& p = state_.fixed();
    p.copies = std::max(1u, copies);
    p.bodies_of_copy = copies ? n / copies : 0;
    lay_out_grid(properties, p, n);
    take_joint_tables(state_, joint_tables(scene, properties));
    state_.vehicles = vehicle_records(scene, state_.joint_records, state_.way_points);
    p.vehicles = static_cast<std::uint32_t>(state_.vehicles.size());
    p.bodies = rows;
    p.first_part = state_.body_count = n;
    p.buckets = State::buckets_for(rows);
    set_first_capacities(p, settings, n + moving, ranks);
    p.group_size = group_size;
    p.group_shift = static_cast<std::uint32_t>(std::countr_zero(group_size));
    p.most_groups = 65535;  // of any device; a runner may have more
    filter(scene);
    set_fields(scene);
    bond(scene);
    state_.allocate();
    for (std::uint32_t i = 0; i < n; ++i) {
        state_.poses[i] = start_of(scene.bodies[i]);
        state_.velocities[i] = start_velocity_of(scene.bodies[i]);
        state_.strains[i] = start_strain_of(scene.bodies[i], properties[i]);
    }
    for (std::uint32_t i = n; i < rows; ++i) place(i);
    start_joints(state_, scene, 0, scene.joints.size());
    state_.note_content(0, rows);
    state_.counted() = physics::emptied(state_.counted(), p);
}

// Here, so that the tables do not know how a scene becomes them.
State::State(const Scene& scene, const Settings& settings, std::uint32_t group_size, bool all, std::uint32_t copies,
             std::uint32_t ranks)
    : substeps(settings.substeps), all_(all) {
    SceneCompiler(*this).compile(scene, settings, group_size, copies, ranks);
}

}  // namespace scree
