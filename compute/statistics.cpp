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
#include <span>

#include "compute/compile/joint_blocks.h"
#include "compute/tables/memory_order.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/contact/contact_constraint.h"
#include "shaders/physics/joint/joint_axis.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

using glm::dvec3;

bool finite(const BodyRecord& now) {
    const physics::Pose& pose = now.pose;
    const physics::Velocity& velocity = now.velocity;
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

constexpr float resting_speed = 0.1f;  // m/s

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

// Whether a row was removed since the last step, in which it may have had contacts.
bool is_gone(const State& state, std::uint32_t row) {
    return state.properties[row].shape == physics::SHAPE_NONE;
}

// Whether a contact ended within the last step by sliding off (contact_solver.h).
bool has_slid_off(const State& state, const physics::Contact& contact, const physics::ContactImpulse& impulse) {
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    return impulse.slide_distance > physics::slide_limit_of(contact, ta, tb, physics::anchor_of(contact, ta, tb));
}

}  // namespace

ContactSums contact_sums(const State& state, std::optional<std::uint32_t> copy) {
    const auto rests = [&](std::uint32_t row) { return glm::length(state.velocities[row].linear) < resting_speed; };
    ContactSums sums;
    for (const std::uint32_t i : contacts_by_id(state)) {
        const physics::Contact& contact = state.contacts[i];
        if (is_gone(state, contact.a) || is_gone(state, contact.b)) continue;
        if (copy && state.copy_of(contact.a) != *copy) continue;
        if (!state.presence.empty() && !state.owns_contact(contact)) continue;
        ++sums.manifolds;
        if (has_slid_off(state, contact, state.impulses[i])) continue;
        const physics::uint count = contact.count;
        sums.points += count;
        const bool at_rest = rests(state.body_of(contact.a)) && rests(state.body_of(contact.b));
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

void add_contacts(const ContactSums& contacts, Statistics& s) {
    s.manifolds = contacts.manifolds;
    s.points = contacts.points;
    s.penetration_max = contacts.greatest;
    s.penetration_resting = contacts.greatest_resting;
    if (contacts.penetrating) s.penetration_mean = contacts.depth / static_cast<double>(contacts.penetrating);
}

BodyRecord BodyRecord::of(const State& state, std::uint32_t row) {
    return {state.properties[row].motion, state.sleep_states[row], state.poses[row], state.velocities[row]};
}

void BodySums::add(const Body& body, const BodyRecord& now, vec3 gravity, const std::vector<Plane>& planes,
                   physics::uint sleep_steps) {
    sums_.broken += now.motion == physics::MOTION_BROKEN;
    if (physics::is_absent(now.motion)) return;
    ++sums_.bodies;
    sums_.pieces += body.piece_of != no_body;
    if (!finite(now) || physics::is_quarantined(now.motion)) {
        ++sums_.not_finite;
        return;
    }
    if (body.motion != Motion::dynamic) return;
    sums_.asleep += physics::is_asleep(now.rest, sleep_steps);
    add_motion(body, now, gravity);
    sums_.below_ground += std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
        return glm::dot(dvec3(plane.normal), dvec3(now.pose.position)) < plane.offset;
    });
}

void BodySums::add_motion(const Body& body, const BodyRecord& now, vec3 gravity) {
    const MassProperties mass = mass_properties(body);
    const dvec3 x(now.pose.position), v(now.velocity.linear), w(now.velocity.angular);
    const dvec3 own_spin = angular_momentum(mass, now.pose.orientation, w);
    const double m = mass.mass;
    momentum_ += m * v;
    spin_ += m * glm::cross(x, v) + own_spin;
    sums_.kinetic_energy += 0.5 * m * glm::dot(v, v) + 0.5 * glm::dot(w, own_spin);
    sums_.potential_energy -= m * body.gravity_scale * glm::dot(dvec3(gravity), x);
    sums_.max_speed = std::max(sums_.max_speed, glm::length(v));
    sums_.max_spin = std::max(sums_.max_spin, glm::length(w));
    sums_.drift_max = std::max(sums_.drift_max, glm::length(x - dvec3(body.position)));
}

void BodySums::add(const BodySums& others) {
    const Statistics& more = others.sums_;
    for (std::size_t Statistics::*const count : {&Statistics::bodies, &Statistics::broken, &Statistics::pieces,
                                                 &Statistics::asleep, &Statistics::not_finite, &Statistics::below_ground})
        sums_.*count += more.*count;
    for (double Statistics::*const sum : {&Statistics::kinetic_energy, &Statistics::potential_energy}) sums_.*sum += more.*sum;
    for (double Statistics::*const most : {&Statistics::max_speed, &Statistics::max_spin, &Statistics::drift_max})
        sums_.*most = std::max(sums_.*most, more.*most);
    momentum_ += others.momentum_;
    spin_ += others.spin_;
}

Statistics BodySums::statistics() const {
    Statistics s = sums_;
    for (int axis = 0; axis < 3; ++axis) {
        s.momentum[axis] = momentum_[axis];
        s.angular_momentum[axis] = spin_[axis];
    }
    return s;
}

std::vector<Plane> solid_planes(const Scene& scene, std::size_t first, std::size_t last) {
    std::vector<Plane> planes;
    for (std::size_t i = first; i < last; ++i)
        if (const auto* plane = std::get_if<Plane>(&scene.bodies[i].shape); plane && scene.bodies[i].role == Role::solid)
            planes.push_back(*plane);
    return planes;
}

Statistics statistics_of(const Scene& scene, const State& state, const ContactSums& contacts, std::optional<std::uint32_t> copy) {
    BodySums sums;
    const std::size_t copies = state.fixed().copies, bodies = scene.bodies.size() / copies;
    const std::size_t joints = state.joint_records.size() / (copy ? copies : 1);
    const std::size_t begin = copy.value_or(0), end = copy ? begin + 1 : copies;
    for (std::size_t one = begin; one < end; ++one) {
        const std::vector<Plane> planes = solid_planes(scene, one * bodies, (one + 1) * bodies);
        for (std::size_t i = one * bodies; i < (one + 1) * bodies; ++i) {
            const std::uint32_t row = state.row_of(i);
            sums.add(scene.bodies[i], BodyRecord::of(state, row), gravity_on(scene, state, row), planes,
                     state.fixed().sleep_steps);
        }
    }
    Statistics s = sums.statistics();
    s.spin_limited = state.counted().spin_limited;
    add_contacts(contacts, s);
    add_joints(state, begin * joints, joints, s);
    s.bonds = state.bond_states.size() / (copy ? copies : 1);
    const std::span broken = std::span(state.bond_states).subspan(begin * s.bonds, s.bonds);
    s.bonds_broken = static_cast<std::size_t>(std::count(broken.begin(), broken.end(), 1u));
    return s;
}

void append_hashed(std::vector<float>& values, const physics::Pose& pose, const physics::Velocity& velocity) {
    const auto append = [&](const auto& of) { values.insert(values.end(), &of.x, &of.x + of.length()); };
    append(pose.position);
    append(pose.orientation);
    append(velocity.linear);
    append(velocity.angular);
}

std::uint64_t hash_of(const State& state, std::optional<std::uint32_t> copy) {
    constexpr std::size_t floats = 13;
    // Parts follow from their bodies.
    const std::size_t bodies = copy ? state.fixed().bodies_of_copy : state.body_count, first = copy.value_or(0) * bodies;
    std::vector<float> values;
    values.reserve(floats * bodies);
    for (std::size_t i = 0; i < bodies; ++i) {
        const std::uint32_t row = state.row_of(first + i);
        append_hashed(values, state.poses[row], state.velocities[row]);
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
