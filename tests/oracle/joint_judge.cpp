// Conversion of scenes and records for the dense oracle, and its verdict on a pass.
#include "tests/oracle/joint_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

namespace scree::oracle {

namespace {

using glm::dquat;
using glm::dvec3;

DenseBody dense(const Body& body, const physics::Pose& pose, const physics::Velocity& velocity) {
    DenseBody made;
    made.position = dvec3(pose.position);
    made.orientation = glm::normalize(dquat(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z));
    made.velocity = dvec3(velocity.linear);
    made.spin = dvec3(velocity.angular);
    if (body.motion != Motion::dynamic) return made;
    const dvec3 e = dvec3(std::get<Box>(body.shape).half_extents), square = e * e;
    const double mass = 8 * e.x * e.y * e.z * static_cast<double>(body.density);
    made.inverse_mass = 1 / mass;
    made.inverse_inertia = 3.0 / (mass * dvec3(square.y + square.z, square.x + square.z, square.x + square.y));
    return made;
}

DenseAxis locked_axis(double at = 0) {
    DenseAxis axis;
    axis.drive = DenseAxis::Drive::lock;
    axis.rest = at;
    return axis;
}

DenseAxis dense(const Axis& axis) {
    if (axis.locked) return locked_axis();
    if (axis.limits && axis.limits->lower == axis.limits->upper) return locked_axis(static_cast<double>(axis.limits->lower));
    DenseAxis made;
    made.limited = axis.limits.has_value();
    if (axis.limits) {
        made.lower = static_cast<double>(axis.limits->lower);
        made.upper = static_cast<double>(axis.limits->upper);
    }
    if (axis.spring) {
        made.drive = DenseAxis::Drive::spring;
        made.stiffness = static_cast<double>(axis.spring->stiffness);
        made.damping = static_cast<double>(axis.spring->damping);
        made.rest = static_cast<double>(axis.spring->rest);
        made.max_force = static_cast<double>(axis.spring->max_force);
    } else if (axis.motor || axis.friction > 0) {
        made.drive = DenseAxis::Drive::motor;
        made.speed = axis.motor ? static_cast<double>(axis.motor->speed) : 0;
        made.max_force = static_cast<double>(axis.motor ? axis.motor->max_force : axis.friction);
    }
    return made;
}

DenseAxis limited_axis(double lower, double upper, float friction) {
    Axis axis;
    axis.friction = friction;
    DenseAxis made = dense(axis);
    made.limited = true;
    made.lower = lower;
    made.upper = upper;
    return made;
}

struct AxesOf {
    DenseJoint& to;
    void lock(std::size_t first, std::size_t end) const {
        for (std::size_t k = first; k < end; ++k) to.axes[k] = locked_axis();
    }
    void operator()(const Ball& ball) const {
        lock(0, 3);
        Axis axis;
        axis.friction = ball.friction;
        for (std::size_t k = 3; k < 6; ++k) to.axes[k] = dense(axis);
    }
    void operator()(const Hinge& hinge) const {
        lock(0, 6);
        to.axes[3] = dense(hinge.turn);
    }
    void operator()(const Slider& slider) const {
        lock(0, 6);
        to.axes[0] = dense(slider.slide);
    }
    void operator()(const Fixed&) const { lock(0, 6); }
    void operator()(const Distance& distance) const {
        to.radial = true;
        Axis axis;
        axis.limits = Limits{distance.least, distance.greatest};
        axis.spring = distance.spring;
        to.axes[0] = dense(axis);
    }
    void operator()(const ConeTwist& cone) const {
        lock(0, 3);
        to.cone = true;
        to.axes[3] = limited_axis(static_cast<double>(cone.twist.lower), static_cast<double>(cone.twist.upper), cone.friction);
        to.axes[4] = limited_axis(-1e30, static_cast<double>(cone.swing), 0);
    }
    void operator()(const SixDof& six) const {
        const Axis axes[] = {six.x, six.y, six.z, six.twist, six.swing_y, six.swing_z};
        for (std::size_t k = 0; k < 6; ++k) to.axes[k] = dense(axes[k]);
        to.spins = !six.twist.locked;
    }
    void operator()(const Coupling&) const { throw std::logic_error("the judge knows no couplings"); }
};

dquat quaternion(const vec4& q) {
    return glm::normalize(
        dquat(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)));
}

// Where b turns about y or z alone, that is the record's x: what a twist is has no seam where the swing is half a turn.
void begin_with_lone_axis(DenseJoint& joint) {
    const auto turns = [&](std::size_t k) { return joint.axes[k].drive != DenseAxis::Drive::lock; };
    if (turns(3) || turns(4) == turns(5)) return;
    const std::size_t first = turns(4) ? 1 : 2;
    const auto axes = joint.axes;
    for (std::size_t k = 0; k < 6; ++k) joint.axes[k] = axes[k / 3 * 3 + (k + first) % 3];
    const dquat cycle(first == 1 ? 0.5 : -0.5, 0.5, 0.5, 0.5);
    joint.frame_a = joint.frame_a * cycle;
    joint.frame_b = joint.frame_b * cycle;
}

DenseJoint dense(const Joint& joint, const physics::Joint& record) {
    DenseJoint made;
    made.a = joint.a == the_world ? no_dense_body : joint.a;
    made.b = joint.b == the_world ? no_dense_body : joint.b;
    made.anchor_a = dvec3(joint.anchor_a);
    made.anchor_b = dvec3(joint.anchor_b);
    made.frame_a = quaternion(joint.frame_a);
    made.frame_b = quaternion(joint.frame_b);
    std::visit(AxesOf{made}, joint.kind);
    begin_with_lone_axis(made);
    for (std::size_t k = 0; k < 6; ++k) {
        made.axes[k].drive_impulse = static_cast<double>(record.rows[k].motor_impulse);
        made.axes[k].stop_impulse = static_cast<double>(record.rows[k].limit_impulse);
    }
    return made;
}

std::vector<DenseImpulses> impulses_of(const std::vector<DenseJoint>& joints) {
    std::vector<DenseImpulses> impulses(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j)
        for (std::size_t k = 0; k < 6; ++k) {
            impulses[j].drive[k] = joints[j].axes[k].drive_impulse;
            impulses[j].stop[k] = joints[j].axes[k].stop_impulse;
        }
    return impulses;
}

DenseBranches branches_of(std::span<const std::uint32_t> records, const JointTablesNow& tables) {
    DenseBranches branches(records.size());
    for (std::size_t j = 0; j < records.size(); ++j) {
        for (std::size_t k = 0; k < 6; ++k) {
            switch (tables.joints[records[j]].active_set >> (4 * k) & 15) {
                case physics::MOTOR_AT_MIN:
                    branches[j][k] = DenseBranch::drive_low;
                    break;
                case physics::MOTOR_AT_MAX:
                    branches[j][k] = DenseBranch::drive_high;
                    break;
                case physics::LIMIT_LOWER:
                    branches[j][k] = DenseBranch::stop_low;
                    break;
                case physics::LIMIT_UPPER:
                    branches[j][k] = DenseBranch::stop_high;
                    break;
                default:
                    branches[j][k] = DenseBranch::drive;
            }
        }
    }
    return branches;
}

struct Change {
    dvec3 velocity{0}, spin{0};
};

// The velocity change of a body by a pass, from its slots.
Change change_of(std::size_t body, const JointTablesNow& tables) {
    Change change;
    for (std::size_t k = body == 0 ? 0 : tables.slot_ends[body - 1]; k < tables.slot_ends[body]; ++k) {
        change.velocity += dvec3(tables.slots[k].linear);
        change.spin += dvec3(tables.slots[k].angular);
    }
    return change;
}

double difference(const std::vector<DenseBody>& bodies, const DenseSolution& told, const JointTablesNow& after,
                  std::size_t first_body) {
    const double half_width = 0.15;  // m
    double greatest = 0, scale = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].inverse_mass == 0) continue;
        const Change change = change_of(first_body + i, after);
        scale = std::max({scale, glm::length(change.velocity), half_width * glm::length(change.spin)});
        greatest = std::max(
            {greatest, glm::length(change.velocity - told.velocity[i]), half_width * glm::length(change.spin - told.spin[i])});
    }
    return scale > 0 ? greatest / scale : greatest;
}

}  // namespace

std::optional<JointPass> joint_pass_of(const std::string& stage, std::uint32_t pass) {
    if (stage == "prepare_joints") return JointPass::warm_start;
    if (stage == "solve_joints") return JointPass::biased;
    if (stage == "relax_joints") return pass != 0 ? JointPass::last_unbiased : JointPass::unbiased;
    return std::nullopt;
}

Settings joint_settings() {
    Settings settings;
    settings.substeps = 2;
    settings.sleeping = false;
    return settings;
}

JointVerdict judge_joints(const Scene& scene, std::span<const std::uint32_t> records, const physics::Parameters& parameters,
                          const JointTablesNow& before, const JointTablesNow& after, JointPass pass, std::size_t first_body) {
    std::vector<DenseBody> bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        bodies.push_back(dense(scene.bodies[i], before.poses[first_body + i], before.velocities[first_body + i]));
    std::vector<DenseJoint> joints;
    for (std::size_t j = 0; j < scene.joints.size(); ++j) joints.push_back(dense(scene.joints[j], before.joints[records[j]]));
    if (pass == JointPass::warm_start) {
        const double error = difference(bodies, push_densely(bodies, joints, impulses_of(joints)), after, first_body);
        return {error, error};
    }
    const DensePass dense_pass{pass == JointPass::biased, static_cast<double>(parameters.h),
                               static_cast<double>(parameters.push_speed)};
    const auto error = [&](DenseSolution solution) {
        if (pass == JointPass::unbiased) {
            // Includes the warm start of the next substep: all impulses once more.
            const DenseSolution warm = push_densely(bodies, joints, solution.joints);
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                solution.velocity[i] += warm.velocity[i];
                solution.spin[i] += warm.spin[i];
            }
        }
        return difference(bodies, solution, after, first_body);
    };
    const DenseSolution solution = solve_densely(bodies, joints, dense_pass);
    return {error(solve_densely_on(branches_of(records, after), bodies, joints, dense_pass)),
            solution.solved ? error(solution) : std::numeric_limits<double>::quiet_NaN()};
}

double JointVerdicts::worst() const {
    double worst = 0;
    for (const JointVerdict& verdict : all_)
        worst = verdict.on_branches <= worst ? worst : verdict.on_branches;  // NaN counts as the worst
    return worst;
}

double JointVerdicts::median() const {
    std::vector<double> errors;
    for (const JointVerdict& verdict : all_) errors.push_back(verdict.on_branches);
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return *middle;
}

double JointVerdicts::part_that_meets_laws() const {
    const auto met =
        std::count_if(all_.begin(), all_.end(), [](const JointVerdict& verdict) { return verdict.of_law < worst_allowed; });
    return static_cast<double>(met) / static_cast<double>(all_.size());
}

}  // namespace scree::oracle
