// Blocks of joints, their elimination order (minimum degree), and their records.
#include "compute/compile/joint_blocks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "compute/scene/portable_math.h"
#include "compute/tables/state.h"
#include "shaders/physics/joint/joint_coupling.h"

namespace scree {

namespace {

static_assert(most_joints_of_coupled_block == physics::MAX_COUPLED_BLOCK && most_coupled_axes == 8);

using Indices = std::vector<std::uint32_t>;

const Coupling* coupling_of(const Joint& joint) {
    return std::get_if<Coupling>(&joint.kind);
}

// Graph of joints that share dynamic bodies, and of couplings with the joints that they couple.
class Graph {
public:
    template <class IsDynamic>
    Graph(const Scene& scene, const IsDynamic& is_dynamic) : scene_(scene), of_body_(scene.bodies.size()) {
        for (std::size_t j = 0; j < scene.joints.size(); ++j) {
            for (const std::size_t body : {scene.joints[j].a, scene.joints[j].b})
                if (body != the_world && is_dynamic(body)) of_body_[body].push_back(static_cast<std::uint32_t>(j));
            const Coupling* const coupling = coupling_of(scene.joints[j]);
            if (!coupling) continue;
            for (const CoupledAxis& term : coupling->joints) couplings_of_[term.joint].push_back(static_cast<std::uint32_t>(j));
        }
    }
    Graph(const Scene& scene, const std::vector<physics::BodyProperties>& properties)
        : Graph(scene, [&](std::size_t body) { return properties[body].motion == physics::MOTION_DYNAMIC; }) {}

    bool moves(std::size_t body) const { return body != the_world && !of_body_[body].empty(); }

    std::set<std::uint32_t> neighbours(std::uint32_t joint) const {
        std::set<std::uint32_t> found;
        for (const std::size_t body : {scene_.joints[joint].a, scene_.joints[joint].b})
            if (body != the_world) found.insert(of_body_[body].begin(), of_body_[body].end());
        found.erase(joint);
        return found;
    }

    // All joints connected with one, by breadth-first search.
    Indices reached_from(std::uint32_t start) const {
        Indices order{start};
        std::set<std::uint32_t> seen{start};
        std::set<std::size_t> bodies;
        for (std::size_t at = 0; at < order.size(); ++at) {
            const Joint& joint = scene_.joints[order[at]];
            for (const std::size_t body : {joint.a, joint.b}) {
                if (body == the_world || !bodies.insert(body).second) continue;
                for (const std::uint32_t next : of_body_[body])
                    if (seen.insert(next).second) order.push_back(next);
            }
            if (couplings_of_.empty()) continue;
            if (const auto found = couplings_of_.find(order[at]); found != couplings_of_.end())
                for (const std::uint32_t next : found->second)
                    if (seen.insert(next).second) order.push_back(next);
            if (const Coupling* const coupling = coupling_of(joint))
                for (const CoupledAxis& term : coupling->joints)
                    if (seen.insert(static_cast<std::uint32_t>(term.joint)).second)
                        order.push_back(static_cast<std::uint32_t>(term.joint));
        }
        return order;
    }

private:
    const Scene& scene_;
    std::vector<Indices> of_body_;
    std::map<std::size_t, Indices> couplings_of_;  // by joint
};

struct Eliminated {
    std::uint32_t joint;
    std::set<std::uint32_t> fill_in;
};

// Minimum degree order; empty if a joint has too many neighbours or the block is too large.
std::vector<Eliminated> elimination_of(const Graph& graph, const Indices& joints, std::size_t most) {
    if (joints.size() > most) return {};
    const std::set<std::uint32_t> inside(joints.begin(), joints.end());
    std::map<std::uint32_t, std::set<std::uint32_t>> left;
    for (const std::uint32_t joint : joints)
        for (const std::uint32_t other : graph.neighbours(joint))
            if (inside.contains(other)) left[joint].insert(other);
    for (const std::uint32_t joint : joints) left[joint];
    std::vector<Eliminated> order;
    while (!left.empty()) {
        const auto least = std::min_element(left.begin(), left.end(),
                                            [](const auto& x, const auto& y) { return x.second.size() < y.second.size(); });
        if (least->second.size() > physics::MAX_FILL_IN) return {};
        const Eliminated next{least->first, least->second};
        left.erase(least);
        for (const std::uint32_t other : next.fill_in) {
            left[other].insert(next.fill_in.begin(), next.fill_in.end());
            left[other].erase(other);
            left[other].erase(next.joint);
        }
        order.push_back(next);
    }
    return order;
}

// Cuts joints, given in breadth-first order, in halves until each fits a block.
void cut(const Graph& graph, const Indices& joints, std::vector<std::vector<Eliminated>>& blocks,
         std::size_t most = most_joints_of_block) {
    std::vector<Eliminated> order = elimination_of(graph, joints, most);
    if (!order.empty()) {
        blocks.push_back(std::move(order));
        return;
    }
    const auto middle = joints.begin() + static_cast<std::ptrdiff_t>(joints.size() / 2);
    cut(graph, {joints.begin(), middle}, blocks, most);
    cut(graph, {middle, joints.end()}, blocks, most);
}

// The blocks of joints and of the couplings among them, which come behind the joints of the block of their first one.
std::vector<std::vector<Eliminated>> cut_with_couplings(const Scene& scene, const Graph& graph, const Indices& whole) {
    Indices joints, couplings;
    for (const std::uint32_t j : whole) (coupling_of(scene.joints[j]) ? couplings : joints).push_back(j);
    std::vector<std::vector<Eliminated>> made;
    if (couplings.empty()) {
        cut(graph, joints, made);
        return made;
    }
    std::sort(couplings.begin(), couplings.end());
    cut(graph, joints, made, most_joints_of_coupled_block - std::min(couplings.size(), most_joints_of_coupled_block - 1));
    for (const std::uint32_t coupling : couplings) {
        const std::size_t first = coupling_of(scene.joints[coupling])->joints.front().joint;
        for (std::vector<Eliminated>& order : made)
            if (std::any_of(order.begin(), order.end(), [&](const Eliminated& each) { return each.joint == first; }))
                order.push_back({coupling, {}});
    }
    return made;
}

struct Block {
    std::vector<Eliminated> order;
    bool is_cut;  // its graph is cut at more than most_shared_bodies (JOINT_CUT)
};
// Bodies that several blocks share.
std::size_t shared_bodies(const Scene& scene, const Graph& graph, const std::vector<std::vector<Eliminated>>& blocks) {
    std::map<std::size_t, std::set<std::size_t>> blocks_at;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        for (const Eliminated& each : blocks[i])
            for (const std::size_t body : {scene.joints[each.joint].a, scene.joints[each.joint].b})
                if (graph.moves(body)) blocks_at[body].insert(i);
    return static_cast<std::size_t>(
        std::count_if(blocks_at.begin(), blocks_at.end(), [](const auto& at) { return at.second.size() > 1; }));
}
std::vector<Block> blocks_of(const Scene& scene, const Graph& graph) {
    std::vector<Block> blocks;
    std::vector<bool> done(scene.joints.size());
    for (std::uint32_t j = 0; j < scene.joints.size(); ++j) {
        if (done[j]) continue;
        // From an end, so that a chain is cut into halves.
        const Indices whole = graph.reached_from(graph.reached_from(j).back());
        for (const std::uint32_t joint : whole) done[joint] = true;
        std::vector<std::vector<Eliminated>> made = cut_with_couplings(scene, graph, whole);
        const bool is_cut = shared_bodies(scene, graph, made) > most_shared_bodies;
        for (std::vector<Eliminated>& order : made) blocks.push_back({std::move(order), is_cut});
    }
    return blocks;
}

physics::uint index_of(std::size_t body) {
    return body == the_world ? physics::NONE : static_cast<physics::uint>(body);
}

// A joint's frame whose x is another of its axes.
vec4 frame_from(const vec4& frame, std::size_t first) {
    if (first == 0) return frame;
    return physics::compose(frame, vec4(0.5f, 0.5f, 0.5f, first == 1 ? 0.5f : -0.5f));
}

physics::Joint record_of(const Joint& joint, physics::uint flags) {
    physics::Joint record{};
    record.a = index_of(joint.a);
    record.b = index_of(joint.b);
    record.anchor_a = joint.anchor_a;
    record.anchor_b = joint.anchor_b;
    const JointAxes axes = axes_of_kind(joint.kind);
    record.frame_a = frame_from(joint.frame_a, axes.first);
    record.frame_b = frame_from(joint.frame_b, axes.first);
    record.flags = axes.flags | (joint.collide ? physics::JOINT_COLLIDES : 0u) | flags;
    for (std::size_t k = 0; k < 6; ++k) {
        set_axis_record(record, axes, k);
        record.rotors[k] = rotor_record(axes.axes[k]);
    }
    record.break_force = joint.break_force;
    record.break_torque = joint.break_torque;
    record.broken = joint.broken;
    return record;
}

// The axis of a joint's record that a term of a coupling names.
physics::uint axis_of_term(const Joint& joint, const CoupledAxis& term) {
    const std::size_t axis = static_cast<std::size_t>(term.axis.value_or(main_axis(joint.kind)));
    return static_cast<physics::uint>(axes_of_kind(joint.kind).in_record(axis));
}

// The power of two above its largest factor (AXIS_REACH): a lock that is wrong by a little of that joint is wrong by far more in
// its own unit, and is corrected as fast as the joint could be.
physics::uint reach_of(const Coupling& coupling) {
    float largest = 1;
    for (const CoupledAxis& term : coupling.joints) largest = std::max(largest, std::abs(term.factor));
    for (const float part : coupling.curve) largest = std::max(largest, std::abs(part));
    largest = std::min(largest, physics::STEEPEST);
    physics::uint reach = 0;
    while (static_cast<float>(1u << reach) < largest) ++reach;
    return reach;
}

// A coupling with a joint of another block has no terms, and does nothing (check_couplings).
void take_terms(const Scene& scene, const Coupling& coupling, const physics::JointBlock& block, JointTables& tables,
                physics::Joint& record) {
    const bool curved = !coupling.curve.empty();
    const std::size_t count = std::min(coupling.joints.size(), curved ? std::size_t{4} : most_coupled_axes);
    record.frame_a = record.frame_b = vec4(0);
    for (std::size_t t = 0; t < count; ++t) {
        const CoupledAxis& term = coupling.joints[t];
        const std::uint32_t of = tables.record_of[term.joint];
        if (of < block.first_joint || of - block.first_joint >= block.joints) return;
        const physics::uint axis = axis_of_term(scene.joints[term.joint], term);
        tables.joints[of].axes[axis].mode |= physics::AXIS_COUPLED;
        record.fill_in_of[t] = 8 * of + axis;
    }
    if (curved)
        for (std::size_t k = 0; k < std::min<std::size_t>(coupling.curve.size(), 4); ++k)
            record.frame_b[static_cast<int>(k)] = coupling.curve[k];
    for (std::size_t t = 0; t < count; ++t)
        (t < 4 ? record.frame_a : record.frame_b)[static_cast<int>(t % 4)] =
            curved && t + 1 == count ? 0 : coupling.joints[t].factor;
    record.flags |= static_cast<physics::uint>(count) << physics::COUPLING_TERMS_SHIFT;
    record.flags |= reach_of(coupling) << physics::COUPLING_REACH_SHIFT;
}

// Whether B can swing by half a turn in any direction.
bool swings_over(const physics::JointAxis& y, const physics::JointAxis& z, physics::uint flags) {
    const auto is = [](const physics::JointAxis& axis, physics::uint mode) { return (axis.mode & mode) != 0; };
    if (is(y, physics::AXIS_LOCKED) || is(z, physics::AXIS_LOCKED)) return false;
    if (flags & physics::JOINT_CONE) return !is(y, physics::AXIS_LIMITED);
    const auto farthest = [](const physics::JointAxis& axis) { return std::max(std::abs(axis.lower), std::abs(axis.upper)); };
    return portable::hypot(static_cast<double>(farthest(y)), static_cast<double>(farthest(z))) > std::numbers::pi - 1e-6;
}

// Appends one block: its bodies, then its joints.
void append(const Scene& scene, const Graph& graph, const Block& made, JointTables& tables) {
    physics::JointBlock block{};
    block.first_joint = static_cast<physics::uint>(tables.joints.size());
    block.first_body = static_cast<physics::uint>(tables.bodies.size());
    std::map<std::size_t, physics::uint> member_of;
    for (const Eliminated& eliminated : made.order) {
        const Joint& joint = scene.joints[eliminated.joint];
        tables.record_of[eliminated.joint] = block.first_joint + block.joints++;
        if (coupling_of(joint)) ++block.couplings;
        for (const std::size_t body : {joint.a, joint.b}) {
            if (!graph.moves(body) || !member_of.try_emplace(body, block.first_body + block.bodies).second) continue;
            physics::BlockBody member{};
            member.body = static_cast<physics::uint>(body);
            member.slot = physics::NONE;
            tables.bodies.push_back(member);
            ++block.bodies;
        }
    }
    const auto block_body = [&](std::size_t body) { return graph.moves(body) ? member_of.at(body) : physics::NONE; };
    for (const Eliminated& eliminated : made.order) {
        const Joint& joint = scene.joints[eliminated.joint];
        physics::Joint record = record_of(joint, made.is_cut ? physics::JOINT_CUT : 0u);
        record.block_body_a = block_body(joint.a);
        record.block_body_b = block_body(joint.b);
        for (const std::uint32_t other : eliminated.fill_in) record.fill_in_of[record.fill_in++] = tables.record_of[other];
        std::sort(record.fill_in_of, record.fill_in_of + record.fill_in);
        if (const Coupling* const coupling = coupling_of(joint)) take_terms(scene, *coupling, block, tables, record);
        tables.joints.push_back(record);
    }
    tables.blocks.push_back(block);
}

}  // namespace

JointAxes axes_of_kind(const JointKind& kind) {
    JointAxes made;
    const Axis locked{.locked = true};
    for (std::size_t k = 0; k < 3; ++k) made.axes[k] = locked;
    const auto lock_turns = [&] {
        for (std::size_t k = 3; k < 6; ++k) made.axes[k] = locked;
    };
    if (const auto* ball = std::get_if<Ball>(&kind)) {
        for (std::size_t k = 3; k < 6; ++k) made.axes[k].friction = ball->friction;
    } else if (const auto* hinge = std::get_if<Hinge>(&kind)) {
        lock_turns();
        made.axes[3] = hinge->turn;
    } else if (const auto* slider = std::get_if<Slider>(&kind)) {
        lock_turns();
        made.axes[0] = slider->slide;
    } else if (std::holds_alternative<Fixed>(kind)) {
        lock_turns();
    } else if (const auto* distance = std::get_if<Distance>(&kind)) {
        made.flags = physics::JOINT_RADIAL;
        for (std::size_t k = 0; k < 3; ++k) made.axes[k] = {};
        made.axes[0].limits = Limits{distance->least, distance->greatest};
        made.axes[0].spring = distance->spring;
    } else if (const auto* cone = std::get_if<ConeTwist>(&kind)) {
        made.flags = physics::JOINT_CONE;
        made.axes[3].limits = cone->twist;
        // A cone of half a turn holds nothing back.
        if (static_cast<double>(cone->swing) < std::numbers::pi - 1e-6) made.axes[4].limits = Limits{-unlimited, cone->swing};
        made.axes[3].friction = cone->friction;
    } else if (const auto* coupling = std::get_if<Coupling>(&kind)) {
        made.flags = physics::JOINT_COUPLES | (coupling->curve.empty() ? 0u : physics::JOINT_CURVED);
        for (std::size_t k = 0; k < 3; ++k) made.axes[k] = {};
        made.axes[0] = coupling->sum;
        const Axis& sum = coupling->sum;
        if (!sum.limits && !sum.spring && !sum.motor && sum.friction == 0) made.axes[0] = locked;
        return made;
    } else if (const auto* six = std::get_if<SixDof>(&kind)) {
        const Axis all[] = {six->x, six->y, six->z, six->twist, six->swing_y, six->swing_z};
        const auto turns = [&](std::size_t k) { return (axis_record(all[k]).mode & physics::AXIS_LOCKED) == 0; };
        if (turns(4) != turns(5) && !turns(3)) made.first = turns(4) ? 1 : 2;
        if (!six->twist.locked) made.flags |= physics::JOINT_SPINS;
        for (std::size_t k = 0; k < 6; ++k) made.axes[k] = all[made.of_record(k)];
    }
    if (swings_over(axis_record(made.axes[4]), axis_record(made.axes[5]), made.flags)) made.flags |= physics::JOINT_SWINGS;
    return made;
}

physics::JointAxis axis_record(const Axis& axis) {
    constexpr float least_armature = 1e-9f;  // kg or kg m^2: below, there is no rotor
    physics::JointAxis record{};
    record.lower = -unlimited;
    record.upper = unlimited;
    if (axis.locked || (axis.limits && axis.limits->lower == axis.limits->upper)) {
        record.mode = physics::AXIS_LOCKED;
        record.rest = axis.locked ? 0 : axis.limits->lower;
        return record;
    }
    if (axis.limits) {
        record.mode |= physics::AXIS_LIMITED;
        record.lower = axis.limits->lower;
        record.upper = axis.limits->upper;
    }
    if (axis.spring && (axis.spring->stiffness > 0 || axis.spring->damping > 0)) {
        record.mode |= physics::AXIS_SPRING;
        record.stiffness = axis.spring->stiffness;
        record.damping = axis.spring->damping;
        record.rest = axis.spring->rest;
        record.speed = axis.spring->speed;
        record.most = axis.spring->max_force;
    }
    if (axis.motor) {
        record.mode |= physics::AXIS_MOTOR;
        record.speed = axis.motor->speed;
        record.most = axis.motor->max_force;
    } else if (axis.friction > 0) {
        record.mode |= physics::AXIS_MOTOR;
        record.speed = 0;
        record.most = axis.friction;
    }
    if (axis.armature >= least_armature) record.mode |= physics::AXIS_ROTOR;
    return record;
}
// A swing counts no turns: its limits and its rest are those within reach, and a whole turn's limits hold nothing back.
physics::JointAxis axis_record(const JointAxes& axes, std::size_t k) {
    physics::JointAxis record = axis_record(axes.axes[k]);
    if (k < 4 || (axes.flags & physics::JOINT_CONE) != 0) return record;
    if ((record.mode & physics::AXIS_LIMITED) != 0 && record.upper - record.lower >= physics::TURN) {
        record.mode &= ~physics::AXIS_LIMITED;
        record.lower = -unlimited;
        record.upper = unlimited;
    }
    const bool limited = (record.mode & physics::AXIS_LIMITED) != 0;
    const float turns = physics::turns_between(0, limited ? 0.5f * (record.lower + record.upper) : record.rest);
    record.rest = physics::less_turns(record.rest, turns);
    if (limited) {
        record.lower = physics::less_turns(record.lower, turns);
        record.upper = physics::less_turns(record.upper, turns);
    }
    return record;
}
void set_axis_record(physics::Joint& joint, const JointAxes& axes, std::size_t k) {
    const physics::uint coupled = joint.axes[k].mode & physics::AXIS_COUPLED;
    joint.axes[k] = axis_record(axes, k);
    joint.axes[k].mode |= coupled;
    if (joint.axes[k].mode != 0 && (joint.flags & physics::JOINT_CUT) != 0) joint.axes[k].mode |= physics::AXIS_CUT;
    if ((joint.flags & physics::JOINT_COUPLES) == 0 || k != 0) return;
    constexpr physics::uint whole = 255u << physics::COUPLING_MODE_SHIFT;
    joint.flags = (joint.flags & ~whole) | joint.axes[0].mode << physics::COUPLING_MODE_SHIFT;
    joint.axes[0].mode = 0;
}
physics::JointRotor rotor_record(const Axis& axis) {
    return {(axis_record(axis).mode & physics::AXIS_ROTOR) != 0 ? axis.armature : 0, 0, 0, 0};
}

JointTables joint_tables(const Scene& scene, std::vector<physics::BodyProperties>& properties) {
    JointTables tables;
    if (scene.joints.empty()) return tables;
    tables.record_of.resize(scene.joints.size());
    const Graph graph(scene, properties);
    for (const Block& block : blocks_of(scene, graph)) append(scene, graph, block, tables);
    std::vector<physics::uint> blocks(scene.bodies.size());
    for (const physics::BlockBody& member : tables.bodies) ++blocks[member.body];
    for (physics::BlockBody& member : tables.bodies) member.blocks = blocks[member.body];
    // Each body's joint list, in the order of the scene.
    for (std::size_t j = scene.joints.size(); j-- > 0;) {
        physics::Joint& record = tables.joints[tables.record_of[j]];
        const auto list = [&](physics::uint body, physics::uint& next) {
            next = physics::NONE;
            if (body == physics::NONE || properties[body].motion != physics::MOTION_DYNAMIC) return;
            next = properties[body].joints;
            properties[body].joints = tables.record_of[j];
        };
        list(record.a, record.next_a);
        list(record.b, record.next_b);
    }
    return tables;
}

void take_joint_tables(State& state, JointTables tables) {
    state.fixed().joint_blocks = static_cast<physics::uint>(tables.blocks.size());
    state.joints = std::move(tables.joints);
    state.joint_blocks = std::move(tables.blocks);
    state.block_bodies = std::move(tables.bodies);
    state.joint_records = std::move(tables.record_of);
    state.joint_groups = joint_groups(state.joints, state.joint_blocks, state.fixed().joint_blocks);
}

physics::JointConfiguration configuration_of(const physics::Joint& joint, const physics::Pose& a, const physics::Pose& b,
                                             const physics::Parameters& p) {
    physics::JointConfiguration at =
        physics::joint_configuration(joint.anchor_a, joint.frame_a, a, joint.anchor_b, joint.frame_b, b);
    if (physics::is_periodic(p)) at = physics::at_nearest_image(at, p);
    return physics::turned_configuration(at, joint.flags, joint.twist, joint.axes[3], joint.axes[4], joint.axes[5]);
}
physics::JointConfiguration configuration_of(const State& state, const physics::Joint& joint) {
    const auto pose = [&](physics::uint body) {
        return body == physics::NONE ? physics::Pose{vec3(0), 0, vec4(0, 0, 0, 1)} : state.poses[body];
    };
    return configuration_of(joint, pose(joint.a), pose(joint.b), state.fixed());
}

float first_turns(const State& state, const physics::Joint& joint, std::optional<float> angle) {
    const float twist = configuration_of(state, joint).twist;
    if (angle) return physics::turns_between(twist, *angle);
    constexpr double slack = 0.1, turn = 2 * std::numbers::pi;  // rad
    const double lower = static_cast<double>(joint.axes[3].lower) - slack,
                 upper = static_cast<double>(joint.axes[3].upper) + slack;
    const auto at = [&](double turns) { return static_cast<double>(twist) + turns * turn; };
    const auto outside = [&](double turns) { return std::max(lower - at(turns), at(turns) - upper); };
    const double below = std::floor((upper - at(0)) / turn), above = std::ceil((lower - at(0)) / turn);
    // The nearest to 0 that is not outside, or of both beside the limits the less violated.
    const double most = at(0) > upper ? below : at(0) < lower ? above : 0, fewer = most + (most > 0 ? -1 : most < 0 ? 1 : 0);
    return static_cast<float>(outside(most) <= std::max(outside(fewer), 0.0) ? most : fewer);
}

std::optional<float> angle_to_tell(const State& state, const physics::Joint& joint) {
    if ((joint.flags & physics::JOINT_COUPLES) != 0) return std::nullopt;
    const physics::JointConfiguration at = configuration_of(state, joint);
    if (!physics::counts_turns(joint.flags, joint.axes[3])) return std::nullopt;
    if (physics::turns_between(at.twist, at.turned) == first_turns(state, joint, std::nullopt)) return std::nullopt;
    return at.turned;
}

float speed_of_axis(const State& state, const physics::Joint& joint, physics::uint k) {
    return speed_of_axis(state, joint, k, configuration_of(state, joint), joint.flags);
}
float speed_of_axis(const State& state, const physics::Joint& joint, physics::uint k, const physics::JointConfiguration& at,
                    physics::uint flags) {
    using namespace physics;
    const auto velocity = [&](uint body) { return body == NONE ? Velocity{} : state.velocities[body]; };
    const VelocityPair v{velocity(joint.a), velocity(joint.b)};
    const int axis = static_cast<int>(k);
    const float h = state.fixed().h;
    const JointRow row = is_linear(k) ? linear_row({}, at, axis, flags, v, h) : angular_row({}, at, axis - 3, flags, v, h);
    return row_speed(row, is_linear(k), v);
}

CouplingState coupling_state(const State& state, const physics::Joint& record) {
    using namespace physics;
    CoupledSum sum{};
    CouplingState found;
    const uint count = terms_of_coupling(record.flags);
    for (uint t = 0; t < count; ++t) {
        const physics::Joint& joint = state.joints[joint_of_term(record.fill_in_of[t])];
        const uint k = axis_of_term(record.fill_in_of[t]);
        const JointConfiguration at = configuration_of(state, joint);
        JointRow row = is_linear(k) ? linear_row({}, at, static_cast<int>(k), joint.flags, {}, 0)
                                    : angular_row({}, at, static_cast<int>(k) - 3, joint.flags, {}, 0);
        const float turns = turns_of_term(k, row.coordinate, at.turned), speed = speed_of_axis(state, joint, k);
        float factor = (t < 4 ? record.frame_a : record.frame_b)[static_cast<int>(t % 4)];
        if ((record.flags & JOINT_CURVED) != 0 && t + 1 == count) {
            const CurvePoint point = point_of_curve(record.frame_b, with_turns(row.coordinate, turns));
            sum = with_curve(sum, point, row, speed, 0);
            factor = point.slope;
        } else {
            sum = with_term(sum, factor, row, turns);
        }
        found.rate = with_part(found.rate, factor, speed);
    }
    found.coordinate = row_of_coupling({}, sum, record.anchor_a.x).coordinate;
    return found;
}

void start_joints(State& state, const Scene& scene, std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) start_joint(state, state.joints[state.joint_records[j]], scene.joints[j]);
    for (std::size_t j = first; j < last; ++j) start_coupling(state, state.joints[state.joint_records[j]], scene.joints[j]);
}
void start_coupling(const State& state, physics::Joint& record, const Joint& joint) {
    const Coupling* const coupling = coupling_of(joint);
    if (!coupling) return;
    record.anchor_a.x = 0;
    record.anchor_a.x = coupling->offset ? *coupling->offset : coupling_state(state, record).coordinate;
}

void check_couplings(const Scene& scene) {
    const auto couples = [](const Joint& joint) { return coupling_of(joint) != nullptr; };
    if (std::none_of(scene.joints.begin(), scene.joints.end(), couples)) return;
    const Graph graph(scene, [&](std::size_t body) { return scene.bodies[body].motion == Motion::dynamic; });
    std::vector<std::size_t> block_of(scene.joints.size());
    const std::vector<Block> blocks = blocks_of(scene, graph);
    for (std::size_t i = 0; i < blocks.size(); ++i)
        for (const Eliminated& each : blocks[i].order) block_of[each.joint] = i;
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
        const Coupling* const coupling = coupling_of(scene.joints[j]);
        if (!coupling) continue;
        const bool together = std::all_of(coupling->joints.begin(), coupling->joints.end(), [&](const CoupledAxis& term) {
            return block_of[term.joint] == block_of[coupling->joints.front().joint];
        });
        const std::vector<Eliminated>& order = blocks[block_of[j]].order;
        const auto couplings = static_cast<std::size_t>(
            std::count_if(order.begin(), order.end(), [&](const Eliminated& each) { return couples(scene.joints[each.joint]); }));
        if (together && order.size() <= most_joints_of_coupled_block && couplings <= most_couplings_of_block) continue;
        throw SceneError("/joints/" + std::to_string(j) + "/kind/coupling",
                         "its joints cannot be solved together: with all that bodies and couplings connect with them there are "
                         "more than " +
                             std::to_string(most_joints_of_coupled_block) + " joints or " +
                             std::to_string(most_couplings_of_block) +
                             " couplings, or a body has more than nine joints; couple fewer, or make bodies fixed");
    }
}

void start_joint(const State& state, physics::Joint& joint, const Joint& of) {
    if ((joint.flags & physics::JOINT_COUPLES) == 0) start_joint(state, joint, of.angle);
}
void start_joint(const State& state, physics::Joint& joint, std::optional<float> angle) {
    joint.twist = physics::with_turns(configuration_of(state, joint).twist, first_turns(state, joint, angle));
    for (physics::uint k = 0; k < 6; ++k)
        if (physics::has_rotor(joint.axes[k])) joint.rotors[k].speed = speed_of_axis(state, joint, k);
}

}  // namespace scree
