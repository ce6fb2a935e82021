// MJCF: actuators become springs, dampers and motors of their joints' axes.
#include <algorithm>
#include <cmath>

#include "compute/scene_file/import/mjcf/mjcf.h"

namespace scree::imports {

namespace {

// force = gain control + offset + by_length length + by_speed speed, where length = gear position.
struct Law {
    double gain = 1, offset = 0, by_length = 0, by_speed = 0;
};

Law general_law(Element& actuator) {
    const std::size_t dynamics = actuator.word("dyntype", {"none", "integrator", "filter", "filterexact", "muscle", "user"}, 0);
    const std::size_t gain = actuator.word("gaintype", {"fixed", "affine", "muscle", "user"}, 0);
    const std::size_t bias = actuator.word("biastype", {"none", "affine", "muscle", "user"}, 0);
    if (dynamics >= 4 || gain >= 2 || bias >= 2) actuator.refuse("muscles and actuators of the user's own are not read");
    if (dynamics > 0) actuator.note("dyntype", "is left out: the control acts at once");
    if (gain == 1) actuator.note("gaintype", "is left out but for its constant");
    const auto gains = actuator.numbers("gainprm", 1, 10), biases = actuator.numbers("biasprm", 1, 10);
    actuator.pass({"dynprm", "actdim", "actearly", "actlimited", "actrange"});
    Law law;
    if (!gains.empty()) law.gain = gains[0];
    if (bias == 1) {
        const auto at = [&](std::size_t k) { return k < biases.size() ? biases[k] : 0.0; };
        law.offset = at(0), law.by_length = at(1), law.by_speed = at(2);
    }
    return law;
}

}  // namespace

// Of a joint with all coordinates 0: the moment of inertia, or mass, of what hangs on it.
double Mjcf::reflected_inertia(const JointPlace& place) const {
    const std::vector<ModelMotion> zero = motions_of(model_, false);
    const ModelJoint& joint = model_.bodies[place.body].joints[place.joint];
    const Placed& at = zero[place.body].placed;
    const dvec3 axis = at.turn * glm::normalize(joint.axis), anchor = at * joint.anchor;
    std::vector<bool> hangs(model_.bodies.size());
    double sum = joint.armature;
    for (std::size_t b = place.body; b < model_.bodies.size(); ++b) {
        hangs[b] = b == place.body || hangs[model_.bodies[b].parent];
        if (!hangs[b]) continue;
        const SolidMass mass = placed_mass(model_.bodies[b].mass, zero[b].placed);
        const dvec3 arm = glm::cross(axis, mass.centre - anchor);
        sum += joint.kind == ModelJoint::Kind::slide ? mass.mass
                                                     : glm::dot(axis, mass.inertia * axis) + mass.mass * glm::dot(arm, arm);
    }
    return sum;
}

// Of a tendon whose joints move each by itself.
double Mjcf::reflected_inertia(const ModelCoupling& tendon) const {
    double inverse = 0;
    for (const ModelCoupling::Term& term : tendon.terms)
        inverse += term.factor * term.factor / std::max(1e-12, reflected_inertia(JointPlace{term.body, term.joint}));
    return 1 / inverse;
}

ModelJoint& Mjcf::driven_joint(Element& actuator, const std::string& name) {
    if (name.empty()) actuator.refuse("acts on no joint and no tendon, which it must here");
    const auto found = joints_named_.find(name);
    if (found == joints_named_.end()) actuator.refuse("there is no joint \"" + name + "\"");
    ModelBody& body = model_.bodies[found->second.body];
    if (found->second.joint >= body.joints.size()) actuator.refuse("acts on a free joint, which it cannot here");
    ModelJoint& joint = body.joints[found->second.joint];
    if (joint.kind == ModelJoint::Kind::ball) actuator.refuse("acts on a ball joint, which it cannot here");
    return joint;
}

void Mjcf::read_actuator(const host::XmlElement& tree) {
    Element actuator = element(tree, {});
    const std::string& kind = tree.name;
    const std::size_t number = actuators_++;
    if (kind == "muscle" || kind == "adhesion" || kind == "plugin") actuator.refuse("is not read; remove it");
    static const std::vector<std::string> known = {"general",     "motor",  "position", "velocity",
                                                   "intvelocity", "damper", "cylinder"};
    if (std::find(known.begin(), known.end(), kind) == known.end()) actuator.refuse("is no actuator that is known here");
    actuator.ignore({"group", "user", "lengthrange", "cranklength", "refsite", "delay", "nsample", "interp"},
                    "is left out; no motion depends on it");
    actuator.ignore({"armature", "damping"}, "of an actuator is left out");
    const bool on_tendon = actuator.has("tendon");
    const std::string name = actuator.has("joint") ? actuator.text("joint") : actuator.text("jointinparent");
    ModelJoint& joint = on_tendon ? tendons_[tendon_named(actuator, "tendon")].sum : driven_joint(actuator, name);

    const auto gears = actuator.numbers("gear", 1, 6);
    const double gear = gears.empty() ? 1 : gears[0];
    const auto inertia = [&] {
        return on_tendon ? reflected_inertia(tendons_[tendon_named(actuator, "tendon")])
                         : reflected_inertia(joints_named_.at(name));
    };
    Law law;
    if (kind == "general") law = general_law(actuator);
    if (kind == "position" || kind == "intvelocity") {
        const double kp = actuator.number("kp", 1), ratio = actuator.number("dampratio", 0);
        double kv = actuator.number("kv", 0);
        if (ratio != 0) kv = ratio * 2 * std::sqrt(std::max(0.0, kp * inertia())) / std::max(1e-9, std::abs(gear));
        law = {kp, 0, -kp, -kv};
        actuator.ignore({"timeconst", "inheritrange"}, "is left out: the control acts at once");
        actuator.pass({"actrange", "actlimited", "actearly"});
        if (kind == "intvelocity") actuator.note("", "holds its position; what integrates its control is left out");
    } else if (kind == "velocity") {
        const double kv = actuator.number("kv", 1);
        law = {kv, 0, 0, -kv};
    } else if (kind == "damper") {
        actuator.number("kv", 1);
        law = {0, 0, 0, 0};
        actuator.note("", "exerts nothing at its control of 0");
    } else if (kind == "cylinder") {
        actuator.refuse("is not read; write it as a motor");
    }
    const bool clamps = limited(actuator, "ctrllimited", "ctrlrange"), bounds = limited(actuator, "forcelimited", "forcerange");
    const auto range = actuator.numbers<2>("ctrlrange", {0, 0}), forces = actuator.numbers<2>("forcerange", {0, 0});
    actuator.finish();
    double control = number < controls_.size() ? controls_[number] : 0;
    if (clamps) control = std::clamp(control, std::min(range[0], range[1]), std::max(range[0], range[1]));
    if (!actuation_) return;
    if (law.by_length > 0 || law.by_speed > 0) actuator.refuse("drives away from its target; scree's springs pull");
    const double stiffness = -law.by_length * gear * gear, damping = -law.by_speed * gear * gear;
    const double constant = (law.gain * control + law.offset) * gear;  // of the joint's force, at position and speed 0
    const double greatest =
        bounds ? std::min(std::abs(forces[0]), std::abs(forces[1])) * std::abs(gear) : static_cast<double>(unlimited);
    if (bounds && std::abs(forces[0]) != std::abs(forces[1]))
        actuator.note("forcerange", "is not symmetric; the smaller bound holds both ways");
    if (stiffness > 0) {
        const double rest = constant / stiffness - joint.reference, sum = joint.stiffness + stiffness;
        joint.rest = (joint.stiffness * joint.rest + stiffness * rest) / sum;
        joint.stiffness = sum;
        joint.damping += damping;
        joint.greatest_force = std::min(joint.greatest_force, greatest);
    } else if (damping > 0 && constant != 0) {
        if (joint.motor) actuator.refuse("the joint has two actuators of speed");
        joint.motor = Motor{static_cast<float>(constant / damping), static_cast<float>(std::min(greatest, 1e29))};
        if (!bounds) actuator.note("kv", "is left out: the motor has any force that its speed needs");
    } else if (damping > 0) {
        joint.damping += damping;
    } else if (constant != 0 || kind == "motor" || kind == "general") {
        if (constant != 0)
            actuator.note("ctrl", "of a motor is left out; World::apply_joint_forces gives forces each step");
        else
            actuator.note("", "has no control and exerts nothing; World::apply_joint_forces gives forces each step");
        if (greatest > 0) joint.effort = std::min(joint.effort, greatest);
    }
}

void Mjcf::read_actuators(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) read_actuator(child);
}

}  // namespace scree::imports
