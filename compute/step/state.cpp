// How the tables begin: parameters from settings, traits from shapes and materials, room for a first guess of contacts.
#include "compute/step/state.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "compute/scene/fracture.h"
#include "compute/scene/hull.h"
#include "compute/scene/mesh.h"
#include "compute/step/joint_blocks.h"
#include "compute/step/vehicle_records.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/compound.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/triangle.h"
#include "shaders/physics/extra/sleep.h"

namespace scree {

namespace {

// Levels of the grid with fewer bodies than this are cheaper to look through than to look up.
constexpr std::size_t few_bodies = 24;
constexpr std::size_t most_large = 64;

float width_of(const physics::Traits& traits) {
    return physics::widest(traits.shape, traits.size);
}

// The finest cells hold the body at the tenth percentile of size: most bodies then lie on the first levels, few of them per cell.
float cell_width(const std::vector<physics::Traits>& traits, float speculative) {
    std::vector<float> widths;
    for (const physics::Traits& body : traits)
        if (!physics::is_large(body) &&
            (body.motion == physics::MOTION_UNBORN || physics::motion_of(body) == physics::MOTION_DYNAMIC) &&
            body.shape != physics::SHAPE_NONE)
            widths.push_back(width_of(body));
    if (widths.empty()) return 1;
    const auto tenth = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 10);
    std::nth_element(widths.begin(), tenth, widths.end());
    return 1.25f * (*tenth + 2 * speculative);
}

// Bodies of sizes so rare that a level of the grid is not worth it join the planes in the list of large ones.
void mark_large(std::vector<physics::Traits>& traits, float cell) {
    std::array<std::size_t, physics::LEVELS> population{};
    const auto level = [&](const physics::Traits& body) { return physics::level_of(width_of(body), 1 / cell); };
    const auto listed = [](const physics::Traits& body) { return !physics::is_large(body) && body.shape != physics::SHAPE_NONE; };
    for (const physics::Traits& body : traits)
        if (listed(body)) ++population[level(body)];
    std::size_t room = most_large;
    for (std::size_t l = population.size(); l-- > 0;) {
        if (population[l] == 0 || population[l] > few_bodies || population[l] > room) continue;
        room -= population[l];
        for (physics::Traits& body : traits)
            if (listed(body) && level(body) == l) body.large |= 1;
    }
}

physics::Parameters tuned(physics::Parameters p, vec3 gravity, const Settings& settings) {
    p.gravity = gravity;
    p.dt = 1 / settings.rate;
    p.h = p.dt / static_cast<float>(settings.substeps);
    p.inverse_h = 1 / p.h;
    // Soft constraint coefficients, Catto, Soft Constraints, GDC 2011.
    const float omega = 2 * std::numbers::pi_v<float> * settings.contact_hertz * p.inverse_h;
    const float a1 = 2 * settings.contact_damping_ratio + p.h * omega;
    const float a2 = p.h * omega * a1;
    p.bias_rate = omega / a1;
    p.mass_scale = a2 / (1 + a2);
    p.impulse_scale = 1 / (1 + a2);
    p.push_speed = settings.push_speed;
    p.inverse_relaxation = 1 / settings.split_relaxation;
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

physics::Impulse scaled(physics::Impulse impulse, float factor) {
    impulse.normal *= factor;
    impulse.friction *= factor;
    impulse.twist *= factor;
    impulse.rolling *= factor;
    impulse.pressed *= factor;
    return impulse;
}

}  // namespace

std::uint32_t State::buckets_for(std::uint32_t bodies) {
    return std::bit_ceil(std::max(64u, 2 * bodies));
}

physics::uint sleep_steps_of(const Settings& settings) {
    return settings.sleeping ? std::max(1u, static_cast<physics::uint>(std::ceil(settings.sleep_time * settings.rate)))
                             : physics::NO_SLEEP;
}

const std::array<TableInfo, table_count>& table_infos() {
    static const std::array<TableInfo, table_count> infos{{
#define SCREE_INFO(binding, name, block, record, length) {#name, sizeof(physics::record), Length::length},
        SCREE_TABLES(SCREE_INFO)
#undef SCREE_INFO
    }};
    return infos;
}

State::State(const Scene& scene, const Settings& settings, std::uint32_t group_size, bool all)
    : substeps(settings.substeps), all_(all) {
    const auto n = static_cast<std::uint32_t>(scene.bodies.size());
    traits.reserve(n + 1);
    for (std::uint32_t i = 0; i < n; ++i) traits.push_back(traits_of(scene.bodies[i], i));
    for (std::uint32_t i = 0; i < n; ++i) append_parts(scene.bodies[i], i);
    const auto rows = static_cast<std::uint32_t>(traits.size());
    const auto moving =
        static_cast<std::uint32_t>(std::count_if(traits.begin() + n, traits.end(), [](const physics::Traits& part) {
            return physics::motion_of(part) != physics::MOTION_FIXED;
        }));

    parameters.assign(1, tuned({}, scene.gravity, settings));
    physics::Parameters& p = fixed();
    p.cell = cell_width(traits, p.speculative);
    p.inverse_cell = 1 / p.cell;
    mark_large(traits, p.cell);
    JointTables joined = joint_tables(scene, traits);
    joints = std::move(joined.records);
    joint_records = std::move(joined.record_of);
    p.joint_blocks = joined.blocks;
    vehicles = vehicle_records(scene, joint_records, hulls);
    p.vehicles = static_cast<std::uint32_t>(vehicles.size());
    p.bodies = rows;
    p.first_part = n;
    p.buckets = buckets_for(rows);
    p.pair_capacity = settings.pairs_at_first ? settings.pairs_at_first : 64 + 2 * (n + moving);
    p.contact_capacity = settings.contacts_at_first ? settings.contacts_at_first : 64 + (n + moving) / 2;
    p.group_size = group_size;
    p.group_shift = static_cast<std::uint32_t>(std::countr_zero(group_size));
    allocate();
    for (std::uint32_t i = 0; i < n; ++i) {
        poses[i] = start_of(scene.bodies[i]);
        velocities[i] = start_velocity_of(scene.bodies[i]);
    }
    for (std::uint32_t i = n; i < rows; ++i) place(i);
    counted() = physics::emptied(counted(), p);
}

void State::tune(vec3 gravity, const Settings& settings) {
    const float h_before = fixed().h;
    fixed() = tuned(fixed(), gravity, settings);
    if (settings.substeps == substeps) return;
    substeps = settings.substeps;
    const float factor = fixed().h / h_before;
    const std::size_t lasting = std::min<std::size_t>(counted().contacts, std::min(contacts.size(), impulses.size()));
    for (std::size_t i = 0; i < lasting; ++i) {
        impulses[i] = scaled(impulses[i], factor);
        contacts[i].load *= factor;
    }
    for (physics::Joint& joint : joints)
        for (physics::JointRow& row : joint.rows) {
            row.drive *= factor;
            row.stop *= factor;
        }
}

std::size_t State::allocated(Length length) const {
    const physics::Parameters& p = parameters[0];
    const std::size_t spans = physics::spans_of(p.pair_capacity);
    const std::size_t kinds = physics::KINDS * spans + 1;
    const std::size_t block = std::size_t{p.group_size} << physics::SCAN_SHIFT;
    switch (length) {
        case Length::one:
            return 1;
        case Length::bodies:
        case Length::entries:  // of bodies that are there
            return std::max(1u, p.bodies);
        case Length::bodies_and_end:
            return p.bodies + 1;
        case Length::buckets:
            return p.buckets + 2;
        case Length::pairs:
            return p.pair_capacity;
        case Length::pairs_and_end:  // or, before there are contacts, the kinds
            return std::max(kinds, std::size_t{p.pair_capacity} + 1);
        case Length::kinds:
            return kinds;
        case Length::candidates:  // or blocks of a scan
            return std::max(std::size_t{p.pair_capacity},
                            std::max({kinds, std::size_t{p.pair_capacity}, std::size_t{p.buckets} + 1}) / block + 2);
        case Length::contacts:
            return p.contact_capacity;
        case Length::slots:
            return 2 * std::size_t{p.contact_capacity} + joints.size();
        case Length::joints:
            return std::max<std::size_t>(1, joints.size());
        case Length::vehicles:
            return std::max<std::size_t>(1, vehicles.size());
        case Length::hulls:
            return std::max<std::size_t>(1, hulls.size());
        case Length::actions:
            return action_room;
    }
    return 0;
}

std::size_t State::live(Length length) const {
    const physics::Counts& c = counts[0];
    switch (length) {
        case Length::bodies:
            return fixed().bodies;
        case Length::entries:
            return cells[fixed().buckets];
        case Length::pairs:
            return c.pairs;
        case Length::pairs_and_end:
            return c.pairs + 1;
        case Length::kinds:
            return physics::KINDS * physics::spans_of(c.pairs);
        case Length::contacts:
            return c.contacts;
        case Length::slots:
            return fixed().bodies ? slot_ends[fixed().bodies - 1] : 0;
        case Length::candidates:
            return 0;  // dead when the pairs are in order
        default:
            return allocated(length);
    }
}

void State::make(Table table) {
    switch (table) {
#define SCREE_RESIZE(binding, name, block, record, length) \
    case Table::name:                                      \
        name.resize(allocated(Length::length));            \
        break;
        SCREE_TABLES(SCREE_RESIZE)
#undef SCREE_RESIZE
    }
}

void State::allocate() {
    using enum Table;
    for (const Table table : {parameters, counts, traits, poses, velocities, rests, actions, hulls, joints, vehicles, ids})
        make(table);
    number_rows();
    for (std::size_t i = 0; i < table_count; ++i)
        if (all_ || !raw(static_cast<Table>(i)).empty()) make(static_cast<Table>(i));
}

void State::turn_over() {
    contacts.swap(contacts_before);
    impulses.swap(impulses_before);
    first_contacts.swap(first_contacts_before);
}

void State::grow() {
    const physics::Counts c = counted();
    const auto with_room = [](std::uint64_t need) {
        constexpr std::uint64_t most = 1u << 31;
        if (need > most)
            throw std::length_error("more than 2,147,483,648 pairs of bodies overlap: they must not all lie in one place");
        return static_cast<std::uint32_t>(std::min(need + need / 4, most));
    };
    if (c.overflow & physics::OVERFLOW_PAIRS) fixed().pair_capacity = with_room(c.required_pairs);
    if (c.overflow & physics::OVERFLOW_CONTACTS) fixed().contact_capacity = with_room(c.required_contacts);
    counted().overflow = 0;
    allocate();
}

bool State::has_joints() const {
    return parameters[0].joint_blocks != 0;
}

bool State::has_fractures() const {
    return std::any_of(traits.begin(), traits.end(), [](const physics::Traits& t) { return t.fracture != physics::NONE; });
}

std::size_t State::bytes() const {
    std::size_t sum = 0;
    for (const TableInfo& info : table_infos()) sum += allocated(info.length) * info.record_bytes;
    return sum;
}

std::span<std::byte> State::raw(Table table) {
    switch (table) {
#define SCREE_RAW(binding, name, block, record, length) \
    case Table::name:                                   \
        return std::as_writable_bytes(std::span(name));
        SCREE_TABLES(SCREE_RAW)
#undef SCREE_RAW
    }
    return {};
}

std::span<const std::byte> State::raw(Table table) const {
    switch (table) {
#define SCREE_RAW(binding, name, block, record, length) \
    case Table::name:                                   \
        return std::as_bytes(std::span(name));
        SCREE_TABLES(SCREE_RAW)
#undef SCREE_RAW
    }
    return {};
}

}  // namespace scree
