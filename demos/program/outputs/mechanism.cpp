// What a scene is as a mechanism.
#include "demos/program/outputs/mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "demos/program/outputs/table.h"

namespace scree::demos {

namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, 6> axis_words = {"x", "y", "z", "twist", "swing_y", "swing_z"};
bool is_angle(JointAxis axis) {
    return axis >= JointAxis::twist;
}

const char* kind_word(const JointKind& kind) {
    constexpr std::array<const char*, 8> words = {"ball",     "hinge",      "slider",      "fixed",
                                                  "distance", "cone_twist", "six_degrees", "coupling"};
    return words[kind.index()];
}

bool is_free(const Axis& axis) {
    return !axis.locked && !(axis.limits && axis.limits->lower == axis.limits->upper);
}

// The axes of a joint that may move, with what is known of them.
struct FreeAxis {
    JointAxis axis;
    Axis behaviour;
};
std::vector<FreeAxis> free_axes(const JointKind& kind) {
    std::vector<FreeAxis> free;
    const auto add = [&](JointAxis axis, const Axis& behaviour) {
        if (is_free(behaviour)) free.push_back({axis, behaviour});
    };
    if (const auto* hinge = std::get_if<Hinge>(&kind)) add(JointAxis::twist, hinge->turn);
    if (const auto* slider = std::get_if<Slider>(&kind)) add(JointAxis::x, slider->slide);
    if (const auto* six = std::get_if<SixDof>(&kind)) {
        add(JointAxis::x, six->x);
        add(JointAxis::y, six->y);
        add(JointAxis::z, six->z);
        add(JointAxis::twist, six->twist);
        add(JointAxis::swing_y, six->swing_y);
        add(JointAxis::swing_z, six->swing_z);
    }
    if (const auto* ball = std::get_if<Ball>(&kind))
        for (const JointAxis axis : {JointAxis::twist, JointAxis::swing_y, JointAxis::swing_z})
            add(axis, {.limits = {}, .spring = {}, .motor = {}, .friction = ball->friction});
    if (const auto* cone = std::get_if<ConeTwist>(&kind)) {
        add(JointAxis::twist, {.limits = cone->twist, .spring = {}, .motor = {}, .friction = cone->friction});
        for (const JointAxis axis : {JointAxis::swing_y, JointAxis::swing_z})
            add(axis, {.limits = Limits{-cone->swing, cone->swing}, .spring = {}, .motor = {}});
    }
    if (const auto* rope = std::get_if<Distance>(&kind))
        add(JointAxis::x, {.limits = Limits{rope->least, rope->greatest}, .spring = rope->spring, .motor = {}});
    return free;
}

std::size_t degrees_of(const JointKind& kind) {
    const std::size_t free = free_axes(kind).size();
    return std::holds_alternative<Distance>(kind) ? 5 + free : free;  // a rod's ends turn
}

// Without limits, spring, motor and friction the sum is kept.
bool is_rigid(const Coupling& coupling) {
    const Axis& sum = coupling.sum;
    return !is_free(sum) || (!sum.limits && !sum.spring && !sum.motor && sum.friction == 0);
}

// Groups of bodies.
class Groups {
public:
    explicit Groups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), std::size_t{0}); }
    std::size_t of(std::size_t one) {
        while (parents_[one] != one) one = parents_[one] = parents_[parents_[one]];
        return one;
    }
    bool join(std::size_t a, std::size_t b) {  // whether they were apart
        const std::size_t of_a = of(a), of_b = of(b);
        parents_[std::max(of_a, of_b)] = std::min(of_a, of_b);
        return of_a != of_b;
    }

private:
    std::vector<std::size_t> parents_;
};

std::string body_word(const Scene& scene, std::size_t body) {
    if (body == the_world) return "world";
    return scene.bodies[body].name.empty() ? fmt::format("body {}", body) : scene.bodies[body].name;
}
std::string joint_word(const Scene& scene, std::size_t joint) {
    return scene.joints[joint].name.empty() ? fmt::format("joint {}", joint) : scene.joints[joint].name;
}

std::string bound(float value) {
    return value >= unlimited ? "inf" : value <= -unlimited ? "-inf" : fmt::format("{:.4g}", value);
}
bool is_bounded(const Axis& axis) {
    return axis.limits && (axis.limits->lower > -unlimited || axis.limits->upper < unlimited);
}
std::string limits_text(const FreeAxis& one) {
    if (!is_bounded(one.behaviour)) return "";
    return fmt::format("{} to {} {}", bound(one.behaviour.limits->lower), bound(one.behaviour.limits->upper),
                       is_angle(one.axis) ? "rad" : "m");
}

std::string drive_text(const FreeAxis& one) {
    const char *force = is_angle(one.axis) ? "N m" : "N", *way = is_angle(one.axis) ? "rad" : "m";
    std::vector<std::string> parts;
    const Axis& axis = one.behaviour;
    if (const auto& spring = axis.spring) {
        std::string text = spring->stiffness > 0
                               ? fmt::format("spring {:.4g} {}/{} to {:.4g} {}", spring->stiffness, force, way, spring->rest, way)
                           : spring->damping > 0 ? std::string("damper")
                                                 : std::string("drive");
        if (spring->damping > 0) text += fmt::format(", damping {:.4g} {} s/{}", spring->damping, force, way);
        if (spring->max_force < unlimited) text += fmt::format(", at most {:.4g} {}", spring->max_force, force);
        parts.push_back(text);
    }
    if (axis.motor)
        parts.push_back(
            fmt::format("motor {:.4g} {}/s, at most {:.4g} {}", axis.motor->speed, way, axis.motor->max_force, force));
    if (axis.friction > 0) parts.push_back(fmt::format("friction {:.4g} {}", axis.friction, force));
    if (axis.armature > 0) parts.push_back(fmt::format("armature {:.4g} kg{}", axis.armature, is_angle(one.axis) ? " m^2" : ""));
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
    return text;
}

std::string coupling_text(const Scene& scene, const Coupling& coupling) {
    std::string text;
    for (std::size_t k = 0; k < coupling.joints.size(); ++k) {
        const CoupledAxis& one = coupling.joints[k];
        const bool curved = !coupling.curve.empty() && k + 1 == coupling.joints.size();
        text += text.empty() ? "" : " + ";
        text += curved ? fmt::format("curve of {}", joint_word(scene, one.joint))
                       : fmt::format("{:.6g} {}", one.factor, joint_word(scene, one.joint));
    }
    if (is_rigid(coupling)) text += coupling.offset ? fmt::format(" = {:.6g}", *coupling.offset) : " = its start";
    return text;
}

// As many digits as a float has; null: unlimited.
ordered_json number_of(float value) {
    return std::abs(value) >= unlimited ? ordered_json() : ordered_json(std::stod(fmt::format("{:.7g}", value)));
}
ordered_json json_of(const FreeAxis& one) {
    const Axis& axis = one.behaviour;
    ordered_json made = {{"axis", axis_words[static_cast<std::size_t>(one.axis)]}, {"unit", is_angle(one.axis) ? "rad" : "m"}};
    if (is_bounded(axis)) made["limits"] = {number_of(axis.limits->lower), number_of(axis.limits->upper)};
    if (axis.spring)
        made["spring"] = {{"stiffness", number_of(axis.spring->stiffness)},
                          {"damping", number_of(axis.spring->damping)},
                          {"rest", number_of(axis.spring->rest)},
                          {"max_force", number_of(axis.spring->max_force)}};
    if (axis.motor) made["motor"] = {{"speed", number_of(axis.motor->speed)}, {"max_force", number_of(axis.motor->max_force)}};
    if (axis.friction > 0) made["friction"] = number_of(axis.friction);
    if (axis.armature > 0) made["armature"] = number_of(axis.armature);
    return made;
}

}  // namespace

Mobility mobility_of(const Scene& scene) {
    Mobility made;
    const std::size_t ground = scene.bodies.size();
    Groups groups(ground + 1);
    const auto node_of = [&](std::size_t body) {
        return body == the_world || scene.bodies[body].motion != Motion::dynamic ? ground : body;
    };
    for (const Body& body : scene.bodies) {
        if (body.piece_of != no_body) continue;
        ++(body.motion == Motion::dynamic ? made.moving : body.motion == Motion::fixed ? made.fixed : made.kinematic);
        if (body.motion == Motion::dynamic) made.mass += static_cast<double>(mass_properties(body).mass);
    }
    for (const Joint& joint : scene.joints) {
        if (joint.broken) continue;
        if (const auto* coupling = std::get_if<Coupling>(&joint.kind)) {
            made.couplings += is_rigid(*coupling) ? 1 : 0;
            continue;
        }
        const std::size_t degrees = degrees_of(joint.kind);
        if (degrees >= 6) continue;  // it holds nothing: a spring, a rope
        made.joint_degrees += degrees;
        made.loops += groups.join(node_of(joint.a), node_of(joint.b)) ? 0 : 1;
    }
    for (std::size_t i = 0; i < ground; ++i)
        made.free_bases += scene.bodies[i].motion == Motion::dynamic && scene.bodies[i].piece_of == no_body &&
                                   groups.of(i) == i && groups.of(ground) != i
                               ? 1
                               : 0;
    const std::size_t gives = 6 * made.free_bases + made.joint_degrees, takes = made.couplings + 6 * made.loops;
    made.degrees = gives - std::min(gives, takes);
    return made;
}

std::string mechanism_text(const Scene& scene, const std::string& title) {
    const Mobility all = mobility_of(scene);
    std::string text = fmt::format(
        "{}: bodies: {} moving ({:.6g} kg), {} fixed, {} kinematic\ndegrees of freedom: {}{}: 6 x {} free bases + {} of joints",
        title, all.moving, all.mass, all.fixed, all.kinematic, all.loops > 0 ? "at least " : "", all.degrees, all.free_bases,
        all.joint_degrees);
    if (all.couplings > 0) text += fmt::format(" - {} of couplings", all.couplings);
    if (all.loops > 0) text += fmt::format(" - 6 x {} loops, whose joints may hold the same twice", all.loops);
    text += "\n";
    std::vector<Cells> rows = {{"joint", "kind", "from", "to", "axis", "limits", "drive"}};
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
        const Joint& joint = scene.joints[j];
        if (const auto* coupling = std::get_if<Coupling>(&joint.kind)) {
            const FreeAxis sum{JointAxis::x, coupling->sum};
            rows.push_back({joint_word(scene, j), is_rigid(*coupling) ? "coupling" : "tendon", coupling_text(scene, *coupling),
                            "", "", "", is_rigid(*coupling) ? "" : drive_text(sum)});
            continue;
        }
        Cells row = {joint_word(scene, j), joint.broken ? "broken" : kind_word(joint.kind), body_word(scene, joint.a),
                     body_word(scene, joint.b)};
        const std::vector<FreeAxis> axes = free_axes(joint.kind);
        if (axes.empty()) row.insert(row.end(), 3, "");
        for (std::size_t k = 0; k < axes.size(); ++k) {
            if (k > 0) row = {"", "", "", ""};
            row.insert(row.end(),
                       {axis_words[static_cast<std::size_t>(axes[k].axis)], limits_text(axes[k]), drive_text(axes[k])});
            if (k + 1 < axes.size()) rows.push_back(row);
        }
        rows.push_back(row);
    }
    return scene.joints.empty() ? text : text + "\n" + table(rows);
}

std::string mechanism_json(const Scene& scene, const std::string& title) {
    const Mobility all = mobility_of(scene);
    ordered_json made = {{"scene", title},
                         {"bodies", {{"moving", all.moving}, {"fixed", all.fixed}, {"kinematic", all.kinematic}}},
                         {"mass", all.mass},
                         {"degrees_of_freedom", all.degrees},
                         {"is_exact", all.loops == 0},
                         {"free_bases", all.free_bases},
                         {"joint_degrees", all.joint_degrees},
                         {"coupled_degrees", all.couplings},
                         {"loops", all.loops},
                         {"joints", ordered_json::array()},
                         {"couplings", ordered_json::array()}};
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
        const Joint& joint = scene.joints[j];
        if (const auto* coupling = std::get_if<Coupling>(&joint.kind)) {
            ordered_json one = {{"name", joint.name}, {"index", j}, {"rigid", is_rigid(*coupling)}};
            if (coupling->offset) one["offset"] = number_of(*coupling->offset);
            for (const CoupledAxis& axis : coupling->joints)
                one["joints"].push_back(
                    {{"name", joint_word(scene, axis.joint)}, {"joint", axis.joint}, {"factor", number_of(axis.factor)}});
            if (!coupling->curve.empty()) one["curve"] = coupling->curve;
            if (!is_rigid(*coupling)) one["sum"] = json_of(FreeAxis{JointAxis::x, coupling->sum});
            made["couplings"].push_back(one);
            continue;
        }
        ordered_json one = {{"name", joint.name},
                            {"index", j},
                            {"kind", kind_word(joint.kind)},
                            {"a", body_word(scene, joint.a)},
                            {"b", body_word(scene, joint.b)},
                            {"degrees_of_freedom", degrees_of(joint.kind)},
                            {"axes", ordered_json::array()}};
        if (joint.broken) one["broken"] = true;
        for (const FreeAxis& axis : free_axes(joint.kind)) one["axes"].push_back(json_of(axis));
        made["joints"].push_back(one);
    }
    return made.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace scree::demos
