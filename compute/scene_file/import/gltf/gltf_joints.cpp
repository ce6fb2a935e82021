// Joints of glTF physics: six degrees of freedom with limits and drives.
#include "compute/scene_file/import/gltf/gltf_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compute/scene/double_quaternion.h"
#include "compute/scene_file/import/joint_axes.h"

namespace scree::imports {

namespace {

void read_limit(GltfValue limit, JointAxes& axes) {
    constexpr double bound = static_cast<double>(unlimited);
    const double least = limit.number("min", -bound), most = limit.number("max", bound);
    if (least > most) limit.refuse("\"min\" is above \"max\"");
    const bool soft = limit.has("stiffness");
    limit.number("stiffness", 0), limit.number("damping", 0);
    if (soft) limit.note("stiffness", "of limits is left out: they are stiff");
    for (const auto& [key, list] : {std::pair{"linearAxes", axes.linear}, std::pair{"angularAxes", axes.angular}}) {
        const GltfValue named = limit.at(key);
        if (named.size() > 1 && !(least == 0 && most == 0))
            limit.note(key, "of several axes bound each of them, not their distance");
        for (std::size_t i = 0; i < named.size(); ++i) {
            const nlohmann::json& number = named.at(i).json();
            if (!number.is_number_unsigned() || number.get<std::uint64_t>() > 2) named.refuse("must be axes 0 to 2");
            Axis& axis = list[number.get<std::size_t>()];
            if (least == most && least == 0)
                axis = {.locked = true};
            else if (least > -bound || most < bound)
                axis.limits = Limits{static_cast<float>(std::max(least, -bound)), static_cast<float>(std::min(most, bound))};
        }
    }
    limit.finish();
}

void read_drive(GltfValue drive, JointAxes& axes) {
    const bool angular = drive.word("type", {"linear", "angular"}, 0) == 1;
    if (drive.word("mode", {"force", "acceleration"}, 0) == 1)
        drive.refuse("drives by acceleration, which scree's motors do not");
    const std::size_t number = drive.index("axis", 3, 0);
    const double stiffness = drive.number("stiffness", 0), damping = drive.number("damping", 0),
                 greatest = drive.number("maxForce", static_cast<double>(unlimited)), speed = drive.number("velocityTarget", 0),
                 place = drive.number("positionTarget", 0);
    drive.finish();
    if (stiffness < 0 || damping < 0 || greatest < 0) drive.refuse("stiffness, damping and maxForce must not be below 0");
    Axis& axis = angular ? axes.angular[number] : axes.linear[number];
    if (axis.locked) return drive.note("", "of a locked axis does nothing");
    if (axis.spring || axis.motor) drive.refuse("is the second of its axis");
    if (stiffness > 0) {
        const double rest = place + damping * speed / stiffness;
        axis.spring = Spring{static_cast<float>(stiffness), static_cast<float>(damping), static_cast<float>(rest),
                             static_cast<float>(std::min(greatest, static_cast<double>(unlimited)))};
    } else if (damping > 0 && speed == 0) {
        axis.spring =
            Spring{0, static_cast<float>(damping), 0, static_cast<float>(std::min(greatest, static_cast<double>(unlimited)))};
    } else if (damping > 0) {
        axis.motor = Motor{static_cast<float>(speed), static_cast<float>(std::min(greatest, 1e29))};
        drive.note("damping", "is left out: the motor has any force up to maxForce that its speed needs");
    }
}

}  // namespace

void add_gltf_joints(Scene& scene, const std::vector<std::pair<std::size_t, GltfValue>>& joints, const GltfValue& kinds,
                     const std::vector<GltfNode>& nodes, std::size_t fixed) {
    for (const auto& [node, given] : joints) {
        GltfValue value = given;
        const std::size_t other = value.index("connectedNode", nodes.size(), none_given);
        const std::size_t kind = value.index("joint", kinds.size(), none_given);
        if (kind == none_given || other == none_given) value.refuse("needs \"connectedNode\" and \"joint\"");
        if (!nodes[other].reached) value.refuse("\"connectedNode\" is not part of the scene");
        GltfValue described = kinds.at(kind);
        JointAxes axes;
        const GltfValue limits = described.at("limits"), drives = described.at("drives");
        for (std::size_t i = 0; i < limits.size(); ++i) read_limit(limits.at(i), axes);
        for (std::size_t i = 0; i < drives.size(); ++i) read_drive(drives.at(i), axes);
        described.finish();
        Joint joint;
        joint.collide = value.flag("enableCollision", false);
        value.finish();
        dquat added(1, 0, 0, 0);
        joint.kind = joint_of(axes, added);
        const auto end = [&](std::size_t at, std::size_t& body, vec3& anchor, vec4& frame) {
            if (!keeps_right_angles(nodes[at].world) || !(glm::determinant(dmat3(nodes[at].world)) > 0))
                value.refuse("the frame of node " + std::to_string(at) +
                             " is sheared, mirrored or flat, and its axes are none of a joint; give it no such scale");
            Placed carrier;
            if (nodes[at].body != world_body) {
                body = fixed + nodes[at].body - 1;
                const Body& carried = scene.bodies.at(body);
                carrier = {dvec3(carried.position), glm::normalize(double_quaternion(carried.orientation))};
            }
            const Placed pivot = inverse(carrier) * placed_of(nodes[at].world);
            anchor = vec3(pivot.position);
            frame = single_quaternion(glm::normalize(pivot.turn * added));
        };
        end(node, joint.a, joint.anchor_a, joint.frame_a);
        end(other, joint.b, joint.anchor_b, joint.frame_b);
        scene.joints.push_back(std::move(joint));
    }
}

}  // namespace scree::imports
