// Statistics in double precision over the bodies and contacts of a state.
#include "compute/statistics.h"

#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/quaternion.hpp>

#include "compute/step/joint_blocks.h"
#include "compute/step/memory_order.h"
#include "shaders/physics/extra/quarantine.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/joint_axis.h"

namespace scree {

namespace {

using glm::dvec3;

bool finite(const State& state, std::size_t row) {
    const physics::Pose& pose = state.poses[row];
    const physics::Velocity& velocity = state.velocities[row];
    float sum = 0;  // NaN and infinity survive being multiplied by zero
    for (const float x : {pose.position.x, pose.position.y, pose.position.z, pose.orientation.x, pose.orientation.y,
                          pose.orientation.z, pose.orientation.w, velocity.linear.x, velocity.linear.y, velocity.linear.z,
                          velocity.angular.x, velocity.angular.y, velocity.angular.z})
        sum += x * 0.0f;
    return sum == 0.0f;
}

dvec3 angular_momentum(const MassProperties& mass, vec4 q, dvec3 angular) {
    const glm::dquat turn(q.w, q.x, q.y, q.z);
    return turn * (dvec3(mass.inertia) * (glm::conjugate(turn) * angular));
}

vec3 gravity_on(const Scene& scene, const State& state, std::uint32_t row) {
    if (state.gravities.empty()) return scene.gravity;
    const physics::uvec4 words = state.gravities[state.copy_of(row)];
    return {std::bit_cast<float>(words.x), std::bit_cast<float>(words.y), std::bit_cast<float>(words.z)};
}

void add_motion(const Scene& scene, const State& state, std::size_t i, Statistics& s, dvec3& momentum, dvec3& spin) {
    const MassProperties mass = mass_properties(scene.bodies[i]);
    const std::uint32_t row = state.row_of(i);
    const dvec3 x(state.poses[row].position), v(state.velocities[row].linear), w(state.velocities[row].angular);
    const dvec3 own_spin = angular_momentum(mass, state.poses[row].orientation, w);
    const double m = mass.mass;
    momentum += m * v;
    spin += m * glm::cross(x, v) + own_spin;
    s.kinetic_energy += 0.5 * m * glm::dot(v, v) + 0.5 * glm::dot(w, own_spin);
    s.potential_energy -= m * scene.bodies[i].gravity_scale * glm::dot(dvec3(gravity_on(scene, state, row)), x);
    s.max_speed = std::max(s.max_speed, glm::length(v));
    s.max_spin = std::max(s.max_spin, glm::length(w));
    s.drift_max = std::max(s.drift_max, glm::length(x - dvec3(scene.bodies[i].position)));
}

constexpr float resting_speed = 0.1f;  // m/s

void add_contacts(const ContactSums& contacts, Statistics& s) {
    s.manifolds = contacts.manifolds;
    s.points = contacts.points;
    s.penetration_max = contacts.greatest;
    s.penetration_resting = contacts.greatest_resting;
    if (contacts.penetrating) s.penetration_mean = contacts.depth / static_cast<double>(contacts.penetrating);
}

// Kinetic energy of the rotors of a joint's motors.
double rotor_energy(const State& state, const physics::Joint& joint) {
    using namespace physics;
    if (joint.broken || std::none_of(joint.axes, joint.axes + 6, [](const auto& axis) { return has_rotor(axis); })) return 0;
    const auto set = [&](uint body) { return body != NONE && was_set(state.sleep_states[body]); };
    const auto at_rest = [&](uint body) {
        return body == NONE || state.properties[body].motion != MOTION_DYNAMIC ||
               was_at_rest(state.sleep_states[body], state.fixed().sleep_steps);
    };
    double energy = 0;
    for (uint k = 0; k < 6; ++k) {
        if (!has_rotor(joint.axes[k])) continue;
        const JointRotor rotor = rotor_as_step_begins(joint.rotors[k], set(joint.a) || set(joint.b),
                                                      at_rest(joint.a) && at_rest(joint.b), speed_of_axis(state, joint, k));
        const double speed = rotor.speed;
        energy += 0.5 * static_cast<double>(rotor.inertia) * speed * speed;
    }
    return energy;
}

void add_joints(const State& state, std::size_t first, std::size_t count, Statistics& s) {
    s.joints = count;
    for (std::size_t i = first; i < first + count; ++i) {
        const physics::Joint& joint = state.joints[state.joint_records[i]];
        s.joints_broken += joint.broken != 0;
        s.kinetic_energy += rotor_energy(state, joint);
        s.joint_force_max = std::max(s.joint_force_max, static_cast<double>(joint.max_force));
        s.joint_torque_max = std::max(s.joint_torque_max, static_cast<double>(joint.max_torque));
    }
}

}  // namespace

ContactSums contact_sums(const State& state, std::optional<std::uint32_t> copy) {
    const auto rests = [&](std::uint32_t row) { return glm::length(state.velocities[row].linear) < resting_speed; };
    ContactSums sums;
    for (const std::uint32_t i : contacts_by_id(state)) {
        if (copy && state.copy_of(state.contacts[i].a) != *copy) continue;
        if (!state.presence.empty() && !state.tells_of(state.contacts[i])) continue;
        ++sums.manifolds;
        // Contacts that ended within the last step by sliding off (contact_solver.h).
        if (state.impulses[i].slide_distance > state.constraints[i].slide_limit) continue;
        const physics::uint count = state.contacts[i].count;
        sums.points += count;
        const bool at_rest = rests(state.constraints[i].a) && rests(state.constraints[i].b);
        for (physics::uint k = 0; k < count; ++k) {
            const double separation = state.impulses[i].separation[static_cast<int>(k)];
            if (separation >= 0) continue;
            ++sums.penetrating;
            sums.depth -= separation;
            sums.greatest = std::max(sums.greatest, -separation);
            if (at_rest) sums.greatest_resting = std::max(sums.greatest_resting, -separation);
        }
    }
    return sums;
}

ContactSums operator+(const ContactSums& a, const ContactSums& b) {
    return {a.manifolds + b.manifolds,        a.points + b.points,
            a.penetrating + b.penetrating,    a.depth + b.depth,
            std::max(a.greatest, b.greatest), std::max(a.greatest_resting, b.greatest_resting)};
}

Statistics statistics_of(const Scene& scene, const State& state, const ContactSums& contacts, std::optional<std::uint32_t> copy) {
    Statistics s;
    dvec3 momentum(0), spin(0);
    std::vector<std::vector<const Plane*>> planes(state.fixed().copies);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (const auto* plane = std::get_if<Plane>(&scene.bodies[i].shape); plane && scene.bodies[i].role == Role::solid)
            planes[state.copy_of(state.row_of(i))].push_back(plane);
    const std::size_t copies = state.fixed().copies, joints = state.joint_records.size() / (copy ? copies : 1);
    const std::size_t bodies = copy ? state.fixed().bodies_of_copy : scene.bodies.size(), first = copy.value_or(0) * bodies;
    for (std::size_t i = first; i < first + bodies; ++i) {
        const std::uint32_t row = state.row_of(i);
        s.broken += state.properties[row].motion == physics::MOTION_BROKEN;
        if (physics::is_absent(state.properties[row].motion)) continue;
        ++s.bodies;
        s.pieces += scene.bodies[i].piece_of != no_body;
        if (!finite(state, row) || physics::is_quarantined(state.properties[row].motion)) {
            ++s.not_finite;
            continue;
        }
        if (scene.bodies[i].motion != Motion::dynamic) continue;
        s.asleep += physics::is_asleep(state.sleep_states[row], state.fixed().sleep_steps);
        add_motion(scene, state, i, s, momentum, spin);
        const vec3 centre = state.poses[row].position;
        const std::vector<const Plane*>& own = planes[state.copy_of(row)];
        s.below_ground += std::any_of(own.begin(), own.end(), [&](const Plane* plane) {
            return glm::dot(dvec3(plane->normal), dvec3(centre)) < plane->offset;
        });
    }
    s.spin_limited = state.counted().spin_limited;
    add_contacts(contacts, s);
    add_joints(state, copy.value_or(0) * joints, joints, s);
    for (int axis = 0; axis < 3; ++axis) {
        s.momentum[axis] = momentum[axis];
        s.angular_momentum[axis] = spin[axis];
    }
    return s;
}

std::uint64_t hash_of(const State& state, std::optional<std::uint32_t> copy) {
    constexpr std::size_t floats = 13;
    // Parts follow from their bodies.
    const std::size_t bodies = copy ? state.fixed().bodies_of_copy : state.body_count, first = copy.value_or(0) * bodies;
    std::vector<float> values(floats * bodies);
    for (std::size_t i = 0; i < bodies; ++i) {
        float* body = values.data() + floats * i;
        const std::uint32_t row = state.row_of(first + i);
        std::memcpy(body, &state.poses[row].position, 12);
        std::memcpy(body + 3, &state.poses[row].orientation, 16);
        std::memcpy(body + 7, &state.velocities[row].linear, 12);
        std::memcpy(body + 10, &state.velocities[row].angular, 12);
    }
    const std::uint64_t hash = XXH64(values.data(), values.size() * sizeof(float), 0);
    if (!state.has_fractures()) return hash;
    std::vector<physics::uint> there;  // and which bodies exist
    for (std::size_t i = 0; i < bodies; ++i) there.push_back(state.properties[state.row_of(first + i)].motion);
    for (std::uint32_t row = state.fixed().first_part; row < state.fixed().bodies; ++row)
        if (!copy || state.copy_of(row) == *copy) there.push_back(state.properties[row].motion);
    return XXH64(there.data(), there.size() * sizeof(physics::uint), hash);
}

std::string hash_text(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

}  // namespace scree
