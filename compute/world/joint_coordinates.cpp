// World: bodies placed so that joints have given coordinates and rates.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compute/compile/joint_blocks.h"
#include "compute/scene/double_quaternion.h"
#include "compute/scene/portable_math.h"
#include "compute/schema/range_text.h"
#include "compute/world/world_impl.h"

namespace scree {

namespace {

using glm::dquat;
using glm::dvec3;

struct Moving {  // a frame and its velocities, world axes
    dvec3 position{0};
    dquat turn{1, 0, 0, 0};
    dvec3 velocity{0}, spin{0};
};

// What a joint's record is to have, by its own axes.
struct Wanted {
    std::size_t joint = 0;
    std::optional<double> coordinate[6], rate[6];
};

// B's frame seen from A's, in A's axes: where it is, and how it moves.
struct Relative {
    dvec3 gap{0};
    dquat turn{1, 0, 0, 0};
    dvec3 rate{0}, spin{0};
};

dvec3 point_of(const Moving& body, const vec3& anchor) {
    return body.position + body.turn * dvec3(anchor);
}

Relative relative_of(const physics::Joint& record, const Moving& a, const Moving& b) {
    const dvec3 at_b = point_of(b, record.anchor_b), gap = at_b - point_of(a, record.anchor_a);
    const dquat axes = a.turn * glm::normalize(double_quaternion(record.frame_a)), back = glm::conjugate(axes);
    Relative found;
    found.gap = back * gap;
    found.turn = back * b.turn * glm::normalize(double_quaternion(record.frame_b));
    found.rate = back * (b.velocity + glm::cross(b.spin, at_b - b.position) - a.velocity - glm::cross(a.spin, at_b - a.position));
    found.spin = back * (b.spin - a.spin);
    return found;
}

// Places b by a, or a by b.
Moving placed(const physics::Joint& record, const Relative& joint, const Moving& from, bool from_a) {
    const dquat in_a = glm::normalize(double_quaternion(record.frame_a)),
                in_b = glm::normalize(double_quaternion(record.frame_b));
    Moving made;
    if (from_a) {
        const dquat axes = from.turn * in_a;
        const dvec3 at_b = point_of(from, record.anchor_a) + axes * joint.gap;
        made.turn = glm::normalize(axes * joint.turn * glm::conjugate(in_b));
        made.position = at_b - made.turn * dvec3(record.anchor_b);
        made.spin = from.spin + axes * joint.spin;
        made.velocity = from.velocity + glm::cross(from.spin, at_b - from.position) + axes * joint.rate -
                        glm::cross(made.spin, at_b - made.position);
        return made;
    }
    const dquat axes = from.turn * in_b * glm::conjugate(joint.turn);
    const dvec3 at_b = point_of(from, record.anchor_b);
    made.turn = glm::normalize(axes * glm::conjugate(in_a));
    made.position = at_b - axes * joint.gap - made.turn * dvec3(record.anchor_a);
    made.spin = from.spin - axes * joint.spin;
    made.velocity = from.velocity + glm::cross(from.spin, at_b - from.position) - axes * joint.rate -
                    glm::cross(made.spin, at_b - made.position);
    return made;
}

// The twist about x, then the swing about an axis across it (shaders/physics/joint/joint.h).
dquat turn_of(double twist, double swing_y, double swing_z) {
    const double swing = portable::hypot(swing_y, swing_z), part = swing > 1e-12 ? portable::sin(0.5 * swing) / swing : 0.5;
    const dquat swung(portable::cos(0.5 * swing), 0, part * swing_y, part * swing_z);
    return swung * dquat(portable::cos(0.5 * twist), portable::sin(0.5 * twist), 0, 0);
}

// The spin, in A's axes, at which the twist and swings have these rates.
dvec3 spin_of(const dquat& turn, physics::uint flags, const dvec3& rates) {
    physics::Joint joint{};
    joint.frame_a = joint.frame_b = vec4(0, 0, 0, 1);
    const physics::Pose a{vec3(0), 0, vec4(0, 0, 0, 1)}, b{vec3(0), 0, single_quaternion(turn)};
    const physics::JointConfiguration at =
        physics::joint_configuration(joint.anchor_a, joint.frame_a, a, joint.anchor_b, joint.frame_b, b);
    glm::dmat3 directions;  // as columns
    for (int k = 0; k < 3; ++k)
        directions[k] = dvec3(physics::angular_row({}, at, k, flags & ~physics::JOINT_CONE, {}, 1).direction);
    if (std::abs(glm::determinant(directions)) < 1e-3) return directions * rates;  // swung so far that they do not span space
    return glm::transpose(glm::inverse(directions)) * rates;
}

// Bodies and the joints between them, as trees. All that stands still is one root.
class Trees {
public:
    Trees(const Scene& scene, const std::vector<bool>& is_off) : scene_(scene), of_body_(scene.bodies.size()) {
        for (std::size_t j = 0; j < scene.joints.size(); ++j) {
            if (is_off[j]) continue;
            for (const std::size_t body : {scene.joints[j].a, scene.joints[j].b})
                if (moves(body)) of_body_[body].push_back(j);
        }
    }

    bool moves(std::size_t body) const { return body != the_world && scene_.bodies[body].motion == Motion::dynamic; }

    struct Link {
        std::size_t joint;
        bool from_a;  // whether b is placed by a
    };
    // The joints of the tree that `joint` is in, from the root outwards. Throws std::invalid_argument for a loop.
    std::vector<Link> tree_of(std::size_t joint) const {
        const std::set<std::size_t> bodies = connected(joint);
        std::set<std::size_t> reached, taken;
        std::vector<std::size_t> order;
        std::vector<Link> links;
        for (const std::size_t body : bodies)  // those that hang on what stands still
            for (const std::size_t j : of_body_[body])
                if (!moves(other(j, body))) reach(j, other(j, body), body, reached, taken, order, links);
        if (order.empty()) {
            order.push_back(root_of(bodies));
            reached.insert(order.front());
        }
        for (std::size_t i = 0; i < order.size(); ++i)
            for (const std::size_t j : of_body_[order[i]])
                if (!taken.contains(j)) reach(j, order[i], other(j, order[i]), reached, taken, order, links);
        return links;
    }

private:
    std::size_t other(std::size_t joint, std::size_t body) const {
        const Joint& one = scene_.joints[joint];
        return one.a == body ? one.b : one.a;
    }

    std::set<std::size_t> connected(std::size_t joint) const {
        std::set<std::size_t> found;
        std::vector<std::size_t> left{scene_.joints[joint].a, scene_.joints[joint].b};
        while (!left.empty()) {
            const std::size_t body = left.back();
            left.pop_back();
            if (!moves(body) || !found.insert(body).second) continue;
            for (const std::size_t j : of_body_[body]) left.push_back(other(j, body));
        }
        return found;
    }

    std::size_t root_of(const std::set<std::size_t>& bodies) const {
        std::vector<std::size_t> roots;
        for (const std::size_t body : bodies)
            if (std::ranges::none_of(of_body_[body], [&](std::size_t j) { return scene_.joints[j].b == body; }))
                roots.push_back(body);
        return roots.size() == 1 ? roots.front() : *bodies.begin();
    }

    void reach(std::size_t joint, std::size_t from, std::size_t to, std::set<std::size_t>& reached, std::set<std::size_t>& taken,
               std::vector<std::size_t>& order, std::vector<Link>& links) const {
        taken.insert(joint);
        if (!moves(to) || !reached.insert(to).second)
            throw std::invalid_argument(name_of(scene_.joints[joint], joint) +
                                        " closes a loop: its coordinates follow from those of others; place the bodies by "
                                        "set_bodies, or remove the joint and add it again");
        order.push_back(to);
        links.push_back({joint, scene_.joints[joint].a == from});
    }

    const Scene& scene_;
    std::vector<std::vector<std::size_t>> of_body_;
};

}  // namespace

void World::Impl::set_joint_coordinates(std::span<const JointCoordinate> coordinates) {
    if (coordinates.empty()) return;
    for (const JointCoordinate& one : coordinates) require_joint(one.joint);
    bring(body_ranges);
    bring(joint_ranges);
    std::vector<bool> is_off(scene.joints.size());
    for (std::size_t j = 0; j < is_off.size(); ++j)
        is_off[j] = is_joint_gone(j) || state.joints[state.joint_records[j]].broken != 0;

    std::map<std::size_t, Wanted> wanted;
    for (const JointCoordinate& one : coordinates) {
        const Joint& joint = scene.joints[one.joint];
        const auto demand = [&](bool condition, const std::string& what) {
            if (!condition) throw std::invalid_argument(name_of(joint, one.joint) + what);
        };
        demand(!is_off[one.joint], " is broken");
        demand(!std::holds_alternative<Coupling>(joint.kind), ": a coupling's coordinate follows from those of its joints");
        demand(!std::holds_alternative<Distance>(joint.kind),
               ": a distance says not where the bodies are; place them by set_bodies");
        const JointAxes axes = axes_of_kind(joint.kind);
        const std::size_t k = axes.in_record(static_cast<std::size_t>(one.axis));
        const physics::JointAxis axis = axis_record(axes.axes[k]);
        demand((axis.mode & physics::AXIS_LOCKED) == 0,
               " does not move on that axis; a hinge turns about twist, and a slider moves along x");
        demand(std::isfinite(one.coordinate.value_or(0)) && std::abs(one.coordinate.value_or(0)) <= 1e6f,
               ": the coordinate must be within 1000000 of 0");
        demand(std::isfinite(one.rate.value_or(0)) && std::abs(one.rate.value_or(0)) <= 1e4f,
               ": the rate must be within 10000 of 0");
        constexpr float slack = 1e-4f;  // rounding
        if (one.coordinate && (*one.coordinate < axis.lower - slack || *one.coordinate > axis.upper + slack))
            demand(false, ": " + text_of(*one.coordinate) + " is outside of its limits, " + text_of(axis.lower) + " to " +
                              text_of(axis.upper));
        Wanted& all = wanted[one.joint];
        if (one.coordinate) all.coordinate[k] = static_cast<double>(*one.coordinate);
        if (one.rate) all.rate[k] = static_cast<double>(*one.rate);
    }

    const Trees trees(scene, is_off);
    std::map<std::size_t, Moving> before, after;  // by body
    const auto now = [&](std::size_t body) {
        if (body == the_world) return Moving{};
        const BodyState is = body_state(body);
        return Moving{dvec3(is.position), glm::normalize(double_quaternion(is.orientation)), dvec3(is.velocity),
                      dvec3(is.angular_velocity)};
    };
    std::set<std::size_t> done;
    for (const auto& [index, one] : wanted) {
        if (done.contains(index)) continue;
        for (const Trees::Link& link : trees.tree_of(index)) {
            done.insert(link.joint);
            const Joint& joint = scene.joints[link.joint];
            const physics::Joint& record = state.joints[state.joint_records[link.joint]];
            const std::size_t from = link.from_a ? joint.a : joint.b, to = link.from_a ? joint.b : joint.a;
            const auto moved = after.find(from);
            const auto named = wanted.find(link.joint);
            if (moved == after.end() && named == wanted.end()) continue;
            Relative relative = relative_of(record, now(joint.a), now(joint.b));
            if (named != wanted.end()) {
                const physics::JointConfiguration at = configuration_of(state, record);
                const double is[] = {relative.gap.x,
                                     relative.gap.y,
                                     relative.gap.z,
                                     static_cast<double>(at.turned),
                                     static_cast<double>(at.swing_y),
                                     static_cast<double>(at.swing_z)};
                const JointAxes axes = axes_of_kind(joint.kind);
                double c[6];
                bool turns = false, spins = false;
                for (std::size_t k = 0; k < 6; ++k) {
                    const physics::JointAxis axis = axis_record(axes.axes[k]);
                    const bool locked = (axis.mode & physics::AXIS_LOCKED) != 0;
                    c[k] = named->second.coordinate[k].value_or(locked ? static_cast<double>(axis.rest) : is[k]);
                    turns |= k >= 3 && named->second.coordinate[k].has_value();
                    spins |= k >= 3 && named->second.rate[k].has_value();
                }
                dvec3 rates;  // of the angles, as they are
                for (int k = 0; k < 3; ++k)
                    rates[k] = static_cast<double>(
                        speed_of_axis(state, record, static_cast<physics::uint>(3 + k), at, record.flags & ~physics::JOINT_CONE));
                relative.gap = {c[0], c[1], c[2]};
                if (turns) relative.turn = turn_of(c[3], c[4], c[5]);
                for (int k = 0; k < 3; ++k) {
                    relative.rate[k] = named->second.rate[k].value_or(relative.rate[k]);
                    rates[k] = named->second.rate[3 + k].value_or(rates[k]);
                }
                if (turns || spins) relative.spin = spin_of(relative.turn, record.flags, rates);
            }
            after[to] = placed(record, relative, moved != after.end() ? moved->second : now(from), link.from_a);
        }
    }

    std::vector<BodyChange> changes;
    for (const auto& [body, at] : after)
        changes.push_back({body, vec3(at.position), single_quaternion(at.turn), vec3(at.velocity), vec3(at.spin)});
    set(changes);
    TableRanges turned;
    for (const auto& [index, one] : wanted) {
        if (!one.coordinate[3]) continue;
        const std::uint32_t place = state.joint_records[index];
        physics::Joint& record = state.joints[place];
        const float twist = configuration_of(state, record).twist;
        record.twist = physics::with_turns(twist, physics::turns_between(twist, static_cast<float>(*one.coordinate[3])));
        turned.push_back({Table::joints, place, 1});
    }
    runner->upload(turned);
}

}  // namespace scree
