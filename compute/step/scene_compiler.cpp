// Initial tables: parameters from settings, properties from shapes and materials, capacities from a first guess.
#include "compute/step/scene_compiler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "compute/step/joint_blocks.h"
#include "compute/step/vehicle_records.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/compound.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/extra/sleep.h"

namespace scree {

namespace {

// Grid levels with fewer bodies than this are cheaper to scan as a list than to look up.
constexpr std::size_t few_bodies = 24;
constexpr std::size_t most_large = 64;

float width_of(const physics::BodyProperties& properties) {
    return physics::widest(properties.shape, properties.size);
}

// The finest cells fit the body at the tenth percentile of size: most bodies are then on the first levels, few per
// cell.
float cell_width(const std::vector<physics::BodyProperties>& properties, const physics::Parameters& p) {
    std::vector<float> widths;
    for (const physics::BodyProperties& body : properties)
        if (!physics::is_large(body) &&
            (body.motion == physics::MOTION_PENDING || physics::motion_of(body) == physics::MOTION_DYNAMIC) &&
            body.shape != physics::SHAPE_NONE && !physics::is_apart(body))
            widths.push_back(width_of(body) + physics::speculative_of(body, p));
    if (widths.empty()) return 1;
    const auto tenth = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 10);
    std::nth_element(widths.begin(), tenth, widths.end());
    return 1.25f * (*tenth + glm::length(p.gravity) * p.dt * p.dt);
}

// Bodies on grid levels with too few bodies join the planes in the list of large bodies.
void mark_large(std::vector<physics::BodyProperties>& properties, float cell) {
    std::array<std::size_t, physics::LEVELS> population{};
    const auto level = [&](const physics::BodyProperties& body) { return physics::level_of(width_of(body), 1 / cell); };
    const auto listed = [](const physics::BodyProperties& body) {
        return !physics::is_large(body) && body.shape != physics::SHAPE_NONE && !physics::is_apart(body);
    };
    for (const physics::BodyProperties& body : properties)
        if (listed(body)) ++population[level(body)];
    std::size_t room = most_large;
    for (std::size_t l = population.size(); l-- > 0;) {
        if (population[l] == 0 || population[l] > few_bodies || population[l] > room) continue;
        room -= population[l];
        for (physics::BodyProperties& body : properties)
            if (listed(body) && level(body) == l) body.flags |= physics::ROW_LARGE;
    }
}

// The grid and its list of large bodies, from the first copy of the scene: rows in the order of bodies, then parts.
void lay_out_grid(std::vector<physics::BodyProperties>& properties, physics::Parameters& p, std::uint32_t bodies) {
    const auto of_one = [&](std::size_t all) { return static_cast<std::ptrdiff_t>(all / p.copies); };
    const auto n = of_one(bodies), parts = of_one(properties.size() - bodies);
    std::vector<physics::BodyProperties> one(properties.begin(), properties.begin() + n);
    one.insert(one.end(), properties.begin() + bodies, properties.begin() + bodies + parts);
    p.cell = cell_width(one, p);
    p.inverse_cell = 1 / p.cell;
    mark_large(one, p.cell);
    for (std::size_t row = 0; row < properties.size(); ++row) {
        const std::size_t same = row < bodies ? row % static_cast<std::size_t>(n)
                                              : static_cast<std::size_t>(n) + (row - bodies) % static_cast<std::size_t>(parts);
        properties[row].flags |= one[same].flags & physics::ROW_LARGE;
    }
}

}  // namespace

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
    p.sleep_steps = sleep_steps_of(settings);
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

physics::uint sleep_steps_of(const Settings& settings) {
    return settings.sleeping ? std::max(1u, static_cast<physics::uint>(std::ceil(settings.sleep_time * settings.rate)))
                             : physics::NO_SLEEP;
}

void SceneCompiler::compile(const Scene& scene, const Settings& settings, std::uint32_t group_size, std::uint32_t copies,
                            std::uint32_t ranks) {
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

    state_.parameters.assign(1, tuned({}, scene.gravity, settings));
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
    p.pair_capacity = settings.pairs_at_first ? settings.pairs_at_first : 64 + 2 * (n + moving) / ranks;
    p.contact_capacity = settings.contacts_at_first ? settings.contacts_at_first : 64 + (n + moving) / 2 / ranks;
    p.group_size = group_size;
    p.group_shift = static_cast<std::uint32_t>(std::countr_zero(group_size));
    p.most_groups = 65535;  // of any device; a runner may have more
    filter(scene);
    set_fields(scene);
    state_.allocate();
    for (std::uint32_t i = 0; i < n; ++i) {
        state_.poses[i] = start_of(scene.bodies[i]);
        state_.velocities[i] = start_velocity_of(scene.bodies[i]);
        state_.strains[i] = start_strain_of(scene.bodies[i], properties[i]);
    }
    for (std::uint32_t i = n; i < rows; ++i) place(i);
    for (physics::Joint& joint : state_.joints) start_rotors(state_, joint);
    state_.note_content(0, rows);
    state_.counted() = physics::emptied(state_.counted(), p);
}

}  // namespace scree
