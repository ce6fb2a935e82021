// MJCF: fixed tendons, and equalities of joints and of tendons, as couplings.
#include <algorithm>
#include <cmath>

#include "compute/scene_file/import/mjcf/mjcf.h"

namespace scree::imports {

// The joint that an attribute names, as a term.
ModelCoupling::Term Mjcf::joint_term(Element& element, const char* attribute, double factor) {
    const std::string name = element.text(attribute);
    if (name.empty()) element.refuse(std::string("needs \"") + attribute + "\"");
    const auto found = joints_named_.find(name);
    if (found == joints_named_.end()) element.refuse(attribute, "there is no joint \"" + name + "\"");
    const std::vector<ModelJoint>& joints = model_.bodies[found->second.body].joints;
    if (found->second.joint >= joints.size() || joints[found->second.joint].kind == ModelJoint::Kind::ball)
        element.refuse(attribute, "is a free or ball joint; couplings take hinges and slides");
    return {found->second.body, found->second.joint, factor};
}

void Mjcf::read_tendons(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) {
        if (child.name != "fixed")
            Element(child, notes_).refuse("is not read; scree has fixed tendons, sums of joints' coordinates");
        read_tendon(child);
    }
}

void Mjcf::read_tendon(const host::XmlElement& tree) {
    Element element = this->element(tree, {}, "tendon");
    ModelCoupling tendon;
    tendon.origin = element.origin();
    tendon.name = element.text("name");
    tendon.locked = false;
    ModelJoint& sum = tendon.sum;
    sum.origin = tendon.origin;
    double length = 0;  // where the coordinates are those of the file's description
    for (const host::XmlElement& child : tree.children) {
        Element part(child, notes_);
        if (child.name != "joint") part.refuse("is no part of a fixed tendon");
        const double factor = part.number("coef", 1);
        const ModelCoupling::Term term = joint_term(part, "joint", factor);
        part.finish();
        if (factor == 0) continue;
        length += factor * model_.bodies[term.body].joints[term.joint].reference;
        tendon.terms.push_back(term);
    }
    if (tendon.terms.empty()) element.refuse("has no joint with a coef other than 0");
    if (tendon.terms.size() > most_coupled_axes)
        element.refuse("has " + std::to_string(tendon.terms.size()) + " joints; a coupling takes " +
                       std::to_string(most_coupled_axes));
    tendon.offset = -length;  // so that the coordinate is the tendon's length
    const bool has_range = limited(element, "limited", "range");
    const auto range = element.numbers<2>("range", {0, 0});
    if (has_range && limits_) sum.limits = {range[0], range[1]};
    const auto rest = element.numbers("springlength", 1, 2);
    sum.rest = rest.empty() || rest[0] < 0 ? length : rest.back();
    if (rest.size() == 2 && rest[0] != rest[1] && rest[0] >= 0) {
        sum.rest = 0.5 * (rest[0] + rest[1]);
        element.note("springlength", "is a range, in which no spring acts; here it acts towards the middle");
    }
    sum.stiffness = element.number("stiffness", 0) * (springs_ ? 1 : 0);
    sum.damping = element.number("damping", 0) * (dampers_ ? 1 : 0);
    sum.friction = element.number("frictionloss", 0) * (frictions_ ? 1 : 0);
    for (const auto& [key, value] :
         {std::pair{"stiffness", sum.stiffness}, std::pair{"damping", sum.damping}, std::pair{"frictionloss", sum.friction}})
        if (value < 0) element.refuse(key, "must not be below 0");
    if (element.number("armature", 0) != 0) element.note("armature", "of a tendon is left out; give it to joints");
    element.ignore({"margin", "solreflimit", "solimplimit", "solreffriction", "solimpfriction"},
                   "is of MuJoCo's solver; scree has its own");
    element.ignore({"actuatorfrclimited", "actuatorfrcrange"}, "is left out; forcerange of an actuator holds");
    element.pass({"group", "user", "width", "material", "rgba"});
    element.finish();
    if (!tendon.name.empty() && !tendons_named_.try_emplace(tendon.name, tendons_.size()).second)
        element.refuse("there are two tendons of this name");
    tendons_.push_back(std::move(tendon));
}

std::size_t Mjcf::tendon_named(Element& element, const char* attribute) {
    const auto found = tendons_named_.find(element.text(attribute));
    if (found == tendons_named_.end()) element.refuse(attribute, "there is no tendon \"" + element.text(attribute) + "\"");
    return found->second;
}

// The first coordinate is a polynomial of the second, each measured from where the file describes it.
void Mjcf::read_coupling(const host::XmlElement& tree) {
    Element element = this->element(tree, {});
    const bool of_tendons = tree.name == "tendon";
    const char* const first = of_tendons ? "tendon1" : "joint1";
    const char* const second = of_tendons ? "tendon2" : "joint2";
    std::vector<double> curve = element.numbers("polycoef", 1, 5);
    if (curve.empty()) curve = {0, 1};
    curve.resize(5);
    ModelCoupling coupling;
    coupling.origin = element.origin();
    coupling.name = element.text("name");
    coupling.offset = curve[0];
    const auto terms_of = [&](const char* attribute) {
        return of_tendons ? tendons_[tendon_named(element, attribute)].terms : std::vector{joint_term(element, attribute, 1)};
    };
    coupling.terms = terms_of(first);
    if (element.has(second)) {
        const std::vector<ModelCoupling::Term> other = terms_of(second);
        const bool linear = curve[2] == 0 && curve[3] == 0 && curve[4] == 0;
        if (!linear && (other.size() != 1 || coupling.terms.size() > 3))
            element.refuse("polycoef",
                           "is not linear: that needs one joint in the second tendon, and three at most in the first");
        for (ModelCoupling::Term term : other) {
            double power = 1;
            for (std::size_t k = 1; !linear && k < curve.size(); ++k) {
                power *= term.factor;
                coupling.curve.push_back(-curve[k] * power);
            }
            term.factor *= -curve[1];
            const auto same = std::find_if(coupling.terms.begin(), coupling.terms.end(), [&](const ModelCoupling::Term& one) {
                return one.body == term.body && one.joint == term.joint;
            });
            if (same != coupling.terms.end() && !linear) element.refuse(second, "has a joint of the first one");
            if (same != coupling.terms.end())
                same->factor += term.factor;
            else if (term.factor != 0 || !linear)
                coupling.terms.push_back(term);
        }
        std::erase_if(coupling.terms, [&](const ModelCoupling::Term& one) { return one.factor == 0 && coupling.curve.empty(); });
        if (coupling.terms.empty() || coupling.terms.size() > most_coupled_axes)
            element.refuse("couples " + std::to_string(coupling.terms.size()) + " joints; it must be 1 to " +
                           std::to_string(most_coupled_axes));
    }
    element.ignore({"solref", "solimp"}, "is of MuJoCo's solver; scree has its own");
    element.finish();
    model_.couplings.push_back(std::move(coupling));
}

// Those that something holds or drives.
void Mjcf::finish_tendons() {
    for (ModelCoupling& tendon : tendons_) {
        const ModelJoint& sum = tendon.sum;
        const bool acts = sum.limits || sum.stiffness > 0 || sum.damping > 0 || sum.friction > 0 || sum.motor ||
                          sum.effort < static_cast<double>(unlimited);
        if (acts) model_.couplings.push_back(std::move(tendon));
    }
}

}  // namespace scree::imports
