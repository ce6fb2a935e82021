// Joints of a scene as UsdPhysics: angles in joint_degrees.
#include "demos/film/export/usd_joints.h"

#include <fmt/format.h>

#include <iterator>
#include <numbers>
#include <type_traits>
#include <variant>

namespace scree::demos {

namespace {

using Out = std::back_insert_iterator<std::string>;
constexpr float joint_degrees = static_cast<float>(180 / std::numbers::pi);

class UsdJoint {
public:
    explicit UsdJoint(const std::function<void(const std::string&)>& note) : note_(note) {}
    std::string type, schemas, says;

    void say(const Ball& ball) {
        type = "PhysicsSphericalJoint";
        if (ball.friction > 0) note_("friction of joints is left out");
    }
    void say(const Fixed&) { type = "PhysicsFixedJoint"; }
    void say(const Coupling&) {}  // usd_joint()
    void say(const Hinge& hinge) {
        type = "PhysicsRevoluteJoint";
        single(hinge.turn, "angular", joint_degrees);
    }
    void say(const Slider& slider) {
        type = "PhysicsPrismaticJoint";
        single(slider.slide, "linear", 1);
    }
    void say(const Distance& distance) {
        type = "PhysicsDistanceJoint";
        fmt::format_to(Out(says), "        float physics:minDistance = {}\n", distance.least > 0 ? distance.least : -1);
        fmt::format_to(Out(says), "        float physics:maxDistance = {}\n",
                       distance.greatest < unlimited ? distance.greatest : -1);
        if (distance.spring) note_("springs of distance joints are left out");
    }
    void say(const ConeTwist& cone) {
        type = "PhysicsSphericalJoint";
        fmt::format_to(Out(says), "        float physics:coneAngle0Limit = {0}\n        float physics:coneAngle1Limit = {0}\n",
                       cone.swing * joint_degrees);
        if (cone.twist.lower > -3.14f || cone.twist.upper < 3.14f || cone.friction > 0)
            note_("twist and friction of cones are left out");
    }
    void say(const SixDof& six) {
        type = "PhysicsJoint";
        const Axis* const axes[] = {&six.x, &six.y, &six.z, &six.twist, &six.swing_y, &six.swing_z};
        static const char* const names[] = {"transX", "transY", "transZ", "rotX", "rotY", "rotZ"};
        for (int i = 0; i < 6; ++i) {
            const float unit = i < 3 ? 1 : joint_degrees;
            const Axis& axis = *axes[i];
            if (axis.locked || axis.limits) {
                const float low = axis.locked ? 1 : axis.limits->lower * unit,
                            high = axis.locked ? -1 : axis.limits->upper * unit;
                add_schema(std::string("PhysicsLimitAPI:") + names[i]);
                fmt::format_to(Out(says),
                               "        float limit:{0}:physics:low = {1}\n        float limit:{0}:physics:high = {2}\n",
                               names[i], low, high);
            }
            drive(axis, names[i], unit);
        }
    }

private:
    void add_schema(const std::string& name) { schemas += (schemas.empty() ? "\"" : ", \"") + name + "\""; }
    void single(const Axis& axis, const char* name, float unit) {
        says += "        uniform token physics:axis = \"X\"\n";
        if (axis.locked)
            fmt::format_to(Out(says), "        float physics:lowerLimit = 1\n        float physics:upperLimit = -1\n");
        if (axis.limits) {
            if (axis.limits->lower > -unlimited)
                fmt::format_to(Out(says), "        float physics:lowerLimit = {}\n", axis.limits->lower * unit);
            if (axis.limits->upper < unlimited)
                fmt::format_to(Out(says), "        float physics:upperLimit = {}\n", axis.limits->upper * unit);
        }
        drive(axis, name, unit);
        if (axis.armature > 0) {
            add_schema("PhysxJointAPI");
            fmt::format_to(Out(says), "        float physxJoint:armature = {}\n", axis.armature);
        }
    }
    // A motor is a damper that is so strong that its greatest force counts.
    void drive(const Axis& axis, const char* name, float unit) {
        if (axis.friction > 0) note_("friction of joints is left out");
        if (!axis.spring && !axis.motor) return;
        if (axis.spring && axis.motor) note_("springs beside motors are left out");
        add_schema(std::string("PhysicsDriveAPI:") + name);
        const std::string prefix = std::string("        float drive:") + name + ":physics:";
        fmt::format_to(Out(says), "        uniform token drive:{}:physics:type = \"force\"\n", name);
        const auto put = [&](const char* what, float value) { fmt::format_to(Out(says), "{}{} = {}\n", prefix, what, value); };
        if (axis.motor) {
            put("maxForce", axis.motor->max_force);
            put("damping", 1e6f / unit);
            put("targetVelocity", axis.motor->speed * unit);
            return;
        }
        put("stiffness", axis.spring->stiffness / unit);
        put("damping", axis.spring->damping / unit);
        put("targetPosition", axis.spring->rest * unit);
        put("targetVelocity", axis.spring->speed * unit);
        if (axis.spring->max_force < unlimited) put("maxForce", axis.spring->max_force);
    }

    const std::function<void(const std::string&)>& note_;
};

}  // namespace

std::string usd_joint(const Scene& scene, std::size_t index, const std::vector<std::string>& paths,
                      const std::function<void(const std::string&)>& note) {
    const Joint& joint = scene.joints[index];
    if (std::holds_alternative<Coupling>(joint.kind)) {
        note("couplings of joints are left out");
        return "";
    }
    UsdJoint made(note);
    std::visit([&](const auto& kind) { made.say(kind); }, joint.kind);
    std::string text = fmt::format("    def {} \"joint_{}\"", made.type, index);
    if (!made.schemas.empty()) fmt::format_to(Out(text), " (\n        prepend apiSchemas = [{}]\n    )", made.schemas);
    text += "\n    {\n";
    const auto end = [&](int number, std::size_t body, vec3 anchor, vec4 frame) {
        if (body != the_world) fmt::format_to(Out(text), "        rel physics:body{} = <{}>\n", number, paths[body]);
        fmt::format_to(
            Out(text),
            "        point3f physics:localPos{0} = ({1}, {2}, {3})\n        quatf physics:localRot{0} = ({4}, {5}, {6}, {7})\n",
            number, anchor.x, anchor.y, anchor.z, frame.w, frame.x, frame.y, frame.z);
    };
    end(0, joint.a, joint.anchor_a, joint.frame_a);
    end(1, joint.b, joint.anchor_b, joint.frame_b);
    if (joint.collide) text += "        bool physics:collisionEnabled = 1\n";
    if (joint.break_force < unlimited) fmt::format_to(Out(text), "        float physics:breakForce = {}\n", joint.break_force);
    if (joint.break_torque < unlimited) fmt::format_to(Out(text), "        float physics:breakTorque = {}\n", joint.break_torque);
    return text + made.says + "    }\n";
}

}  // namespace scree::demos
