// Joints of UsdPhysics: limits and drives of each axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/double_quaternion.h"
#include "compute/scene_file/import/joint_axes.h"
#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr auto no_bound = static_cast<double>(unlimited);

float bounded(double value) {
    return static_cast<float>(std::clamp(value, -no_bound, no_bound));
}

struct End {
    std::size_t body = the_world;  // of the scene
    Placed pivot;                  // in the scene
    std::string path;              // empty: the world
};

class Joints {
public:
    Joints(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, const UsdIndex& index, const Model& model,
           const Placed& root, Scene& scene, Notes& notes)
        : stage_(stage),
          units_(units),
          found_(found),
          index_(index),
          root_(root),
          scene_(scene),
          notes_(notes),
          fixed_(model.bodies[world_body].geometries.size()) {}
    void add(const UsdPrim& prim);

private:
    End end(const UsdPrim& prim, const char* number) const;
    void limit(const UsdPrim& prim, const std::string& axis, double unit, Axis& into) const;
    void drive(const UsdPrim& prim, const std::string& axis, bool turns, double moved, Axis& into) const;
    double moved_by(const End& a, const End& b, int axis, bool turns) const;
    JointKind kind(const UsdPrim& prim, const End& a, const End& b, dquat& turn) const;
    JointKind single(const UsdPrim& prim, const End& a, const End& b, dquat& turn) const;
    JointKind generic(const UsdPrim& prim, const End& a, const End& b, dquat& turn) const;
    JointKind distance(const UsdPrim& prim) const;
    int axis_of(const UsdPrim& prim) const;
    void place(const End& end, const dquat& turn, vec3& anchor, vec4& frame) const;
    void separate(const End& a, const End& b);

    const UsdStage& stage_;
    const UsdUnits& units_;
    const UsdFound& found_;
    const UsdIndex& index_;
    const Placed& root_;
    Scene& scene_;
    Notes& notes_;
    std::size_t fixed_;
};

// From a frame in the prim that a joint names, or in the world, to the scene.
End Joints::end(const UsdPrim& prim, const char* number) const {
    const std::vector<std::string> targets = stage_.targets(prim, std::string("physics:body") + number);
    const dvec3 position = stage_.vector(prim, std::string("physics:localPos") + number).value_or(dvec3(0));
    const dquat turn = stage_.turn(prim, std::string("physics:localRot") + number).value_or(dquat(1, 0, 0, 0));
    End made;
    glm::dmat4 world(1);
    if (!targets.empty()) {
        made.path = targets[0];
        const UsdPrim* body = stage_.find(targets[0]);
        if (!body)
            refuse(stage_.at(prim), std::string("physics:body") + number + ": " + targets[0].substr(0, 200) + " is not there");
        world = stage_.world(*body);
        for (const UsdPrim* one = body; one && made.body == the_world; one = one->parent)
            if (const auto known = found_.body_at.find(one->path); known != found_.body_at.end())
                made.body = fixed_ + known->second - 1;
    }
    const Placed frame = placed_of(world);
    const dvec3 at = dvec3(world * glm::dvec4(position, 1)) * units_.meters;
    made.pivot = root_ * Placed{at, glm::normalize(frame.turn * turn)};
    return made;
}

void Joints::limit(const UsdPrim& prim, const std::string& axis, double unit, Axis& into) const {
    double low = -HUGE_VAL, high = HUGE_VAL;
    if (axis.empty()) {
        low = stage_.number(prim, "physics:lowerLimit", low), high = stage_.number(prim, "physics:upperLimit", high);
    } else {
        if (!prim.applies("PhysicsLimitAPI:" + axis)) return;
        const std::string prefix = "limit:" + axis + ":physics:";
        low = stage_.number(prim, prefix + "low", low), high = stage_.number(prim, prefix + "high", high);
    }
    if (low > high) {
        into = {.locked = true};
    } else if (low > -no_bound || high < no_bound) {
        into.limits = Limits{bounded(low * unit), bounded(high * unit)};
    }
}

// The inertia that an axis moves: what the two bodies have about or along it, one beside the other.
double Joints::moved_by(const End& a, const End& b, int axis, bool turns) const {
    double mobility = 0;
    for (const End* one : {&a, &b}) {
        if (one->body == the_world || scene_.bodies[one->body].motion != Motion::dynamic) continue;
        const Body& body = scene_.bodies[one->body];
        const Inertial& inertial = *body.inertial;
        dvec3 along(0);
        along[axis] = 1;
        const dquat frame =
            glm::normalize(double_quaternion(body.orientation)) * glm::normalize(double_quaternion(inertial.frame));
        const dvec3 own = glm::conjugate(frame) * (a.pivot.turn * along);
        const dvec3 moments(inertial.inertia);
        mobility += turns ? glm::dot(own * own, 1.0 / moments) : 1 / static_cast<double>(inertial.mass);
    }
    return mobility > 0 ? 1 / mobility : 0;
}

void Joints::drive(const UsdPrim& prim, const std::string& axis, bool turns, double moved, Axis& into) const {
    if (!prim.applies("PhysicsDriveAPI:" + axis)) return;
    const Origin at = stage_.at(prim);
    const std::string prefix = "drive:" + axis + ":physics:";
    // Angles are in degrees, also below a unit of stiffness.
    const double unit = turns ? degree : units_.meters;
    double force = turns ? units_.kilograms * units_.meters * units_.meters : units_.kilograms * units_.meters;
    const std::string type = stage_.text(prim, prefix + "type", "force");
    const double most = stage_.number(prim, prefix + "maxForce", HUGE_VAL) * force;
    if (type == "acceleration") {
        force = moved * (turns ? 1 : units_.meters);
        notes_.add(at, "drive", "by acceleration becomes one by force, for the inertia of its bodies at the start");
    }
    const double stiffness = stage_.number(prim, prefix + "stiffness", 0) * force / unit;
    const double damping = stage_.number(prim, prefix + "damping", 0) * force / unit;
    const double rest = stage_.number(prim, prefix + "targetPosition", 0) * unit;
    const double speed = stage_.number(prim, prefix + "targetVelocity", 0) * unit;
    if (stiffness < 0 || damping < 0 || most < 0)
        refuse(at, "drive:" + axis + ": stiffness, damping and maxForce must not be below 0");
    if (into.locked) return notes_.add(at, "drive", "of a locked axis does nothing");
    if (!(stiffness > 0) && !(damping > 0) && !(most < no_bound)) return;
    into.spring = Spring{bounded(stiffness), bounded(damping), bounded(rest), bounded(most), bounded(speed)};
}

int Joints::axis_of(const UsdPrim& prim) const {
    const std::string axis = stage_.text(prim, "physics:axis", "X");
    if (axis != "X" && axis != "Y" && axis != "Z") refuse(stage_.at(prim), "physics:axis: must be X, Y or Z");
    return axis[0] - 'X';
}

// Revolute and prismatic.
JointKind Joints::single(const UsdPrim& prim, const End& a, const End& b, dquat& turn) const {
    const bool turns = prim.type == "PhysicsRevoluteJoint";
    const int k = axis_of(prim);
    JointAxes axes;
    for (int i = 0; i < 3; ++i) axes.linear[i].locked = axes.angular[i].locked = true;
    Axis& axis = turns ? axes.angular[k] : axes.linear[k];
    axis.locked = false;
    limit(prim, "", turns ? degree : units_.meters, axis);
    drive(prim, turns ? "angular" : "linear", turns, moved_by(a, b, k, turns), axis);
    if (prim.applies("PhysxJointAPI"))
        axis.armature = bounded(stage_.number(prim, "physxJoint:armature", 0) * units_.kilograms *
                                (turns ? units_.meters * units_.meters : 1));
    return joint_of(axes, turn);
}

JointKind Joints::generic(const UsdPrim& prim, const End& a, const End& b, dquat& turn) const {
    static const char* const names[] = {"transX", "transY", "transZ", "rotX", "rotY", "rotZ"};
    JointAxes axes;
    for (int i = 0; i < 6; ++i) {
        const bool turns = i >= 3;
        Axis& axis = turns ? axes.angular[i - 3] : axes.linear[i];
        limit(prim, names[i], turns ? degree : units_.meters, axis);
        drive(prim, names[i], turns, moved_by(a, b, i % 3, turns), axis);
    }
    if (prim.applies("PhysicsLimitAPI:distance")) notes_.add(stage_.at(prim), "PhysicsLimitAPI:distance", "is left out");
    return joint_of(axes, turn);
}

JointKind Joints::distance(const UsdPrim& prim) const {
    const double least = stage_.number(prim, "physics:minDistance", -1), most = stage_.number(prim, "physics:maxDistance", -1);
    Distance kind;
    kind.least = least < 0 ? 0 : bounded(least * units_.meters);
    kind.greatest = most < 0 ? unlimited : bounded(most * units_.meters);
    if (kind.least > kind.greatest) refuse(stage_.at(prim), "physics:minDistance: is above maxDistance");
    return kind;
}

JointKind Joints::kind(const UsdPrim& prim, const End& a, const End& b, dquat& turn) const {
    if (prim.type == "PhysicsFixedJoint") return Fixed{};
    if (prim.type == "PhysicsRevoluteJoint" || prim.type == "PhysicsPrismaticJoint") return single(prim, a, b, turn);
    if (prim.type == "PhysicsDistanceJoint") return distance(prim);
    if (prim.type == "PhysicsJoint") return generic(prim, a, b, turn);
    const double first = stage_.number(prim, "physics:coneAngle0Limit", -1),
                 second = stage_.number(prim, "physics:coneAngle1Limit", -1);
    if (first < 0 && second < 0) return Ball{};
    const int k = axis_of(prim);
    dmat3 cycled(0);  // the cone's axis first, the others in order
    for (int i = 0; i < 3; ++i) cycled[i][(k + i) % 3] = 1;
    turn = glm::normalize(glm::quat_cast(cycled));
    if (first >= 0 && second >= 0 && first != second) notes_.add(stage_.at(prim), "cone", "of two angles has the larger one");
    const float half = bounded(std::numbers::pi);
    return ConeTwist{std::min(bounded(std::max(first, second) * degree), half), {-half, half}, 0};
}

void Joints::place(const End& end, const dquat& turn, vec3& anchor, vec4& frame) const {
    Placed carrier;
    if (end.body != the_world) {
        const Body& body = scene_.bodies.at(end.body);
        carrier = {dvec3(body.position), glm::normalize(double_quaternion(body.orientation))};
    }
    const Placed pivot = inverse(carrier) * end.pivot;
    anchor = vec3(pivot.position);
    frame = single_quaternion(glm::normalize(pivot.turn * turn));
}

// A joint to what stands still: the body does not meet that.
void Joints::separate(const End& a, const End& b) {
    for (const auto& [standing, moving] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
        if (standing->body != the_world || moving->body == the_world || standing->path.empty()) continue;
        for (const std::size_t one : index_.below(standing->path))
            if (one < fixed_) scene_.exclusions.push_back({one, moving->body});
    }
}

void Joints::add(const UsdPrim& prim) {
    for (const char* number : {"0", "1"})
        for (const std::string& target : stage_.targets(prim, std::string("physics:body") + number))
            if (const UsdPrim* body = stage_.find(target); body && !body->defined)
                return notes_.add(stage_.at(prim), "joint", "names a prim that is inactive or an over alone, and is left out");
    const End a = end(prim, "0"), b = end(prim, "1");
    const auto moves = [&](const End& one) { return one.body != the_world && scene_.bodies[one.body].motion == Motion::dynamic; };
    if (a.body == b.body || (!moves(a) && !moves(b)))
        return notes_.add(stage_.at(prim), "joint", "connects no two bodies of which one moves, and is left out");
    Joint joint;
    joint.name = prim.path;
    dquat turn(1, 0, 0, 0);
    joint.kind = kind(prim, a, b, turn);
    joint.a = a.body, joint.b = b.body;
    joint.collide = stage_.flag(prim, "physics:collisionEnabled", false);
    place(a, turn, joint.anchor_a, joint.frame_a);
    place(b, turn, joint.anchor_b, joint.frame_b);
    const double force = units_.kilograms * units_.meters;
    const double most = stage_.number(prim, "physics:breakForce", HUGE_VAL) * force;
    const double torque = stage_.number(prim, "physics:breakTorque", HUGE_VAL) * force * units_.meters;
    if (most < no_bound) joint.break_force = bounded(most);
    if (torque < no_bound) joint.break_torque = bounded(torque);
    if (!joint.collide) separate(a, b);
    scene_.joints.push_back(std::move(joint));
}

}  // namespace

void add_usd_joints(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, const UsdIndex& index,
                    const Model& model, const Placed& root, Scene& scene, Notes& notes) {
    Joints joints(stage, units, found, index, model, root, scene, notes);
    for (const UsdPrim* prim : found.joints) joints.add(*prim);
}

}  // namespace scree::imports
