// MJCF: the tree of bodies, their joints and masses.
#include <algorithm>
#include <cmath>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/portable_math.h"
#include "compute/scene_file/import/mjcf/mjcf.h"

namespace scree::imports {

namespace {

constexpr std::size_t no_joint = static_cast<std::size_t>(-1);
constexpr std::size_t most_model_bodies = 1'000'000;
constexpr std::size_t most_elements_read = 4'000'000;

dvec3 vector_of(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

dquat unit_turn(Element& element, const char* attribute, const std::vector<double>& wxyz) {
    const dquat q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    if (!(glm::length(q) > 1e-12)) element.refuse(attribute, "is a quaternion of length 0; no turn is 1 0 0 0");
    return glm::normalize(q);
}

dvec3 unit_vector(Element& element, const char* attribute, const dvec3& v) {
    if (!(glm::length(v) > 1e-12)) element.refuse(attribute, "has a vector of length 0");
    return glm::normalize(v);
}

}  // namespace

dquat turn_between(const dvec3& from, const dvec3& to) {
    const double along = glm::dot(from, to);
    if (along < -1 + 1e-12) {
        const dvec3 side = std::abs(from.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        return portable::turn_about(glm::normalize(glm::cross(from, side)), 3.141592653589793);
    }
    const dvec3 c = glm::cross(from, to);
    return glm::normalize(dquat(1 + along, c.x, c.y, c.z));
}

dquat Mjcf::turn(Element& element) {
    const char* given = nullptr;
    for (const char* one : {"quat", "axisangle", "euler", "xyaxes", "zaxis"}) {
        if (!element.has(one)) continue;
        if (given) element.refuse(one, std::string("stands beside \"") + given + "\"; one of them says how it is turned");
        given = one;
    }
    if (const auto q = element.numbers("quat", 4, 4); !q.empty()) return unit_turn(element, "quat", q);
    if (const auto a = element.numbers("axisangle", 4, 4); !a.empty())
        return portable::turn_about(unit_vector(element, "axisangle", {a[0], a[1], a[2]}), angle(a[3]));
    if (const auto e = element.numbers("euler", 3, 3); !e.empty()) {
        dquat q(1, 0, 0, 0);
        for (std::size_t k = 0; k < 3; ++k) {
            const char axis = compiler_.euler[k];
            dvec3 about(0);
            about[(axis | 32) - 'x'] = 1;
            const dquat one = portable::turn_about(about, angle(e[k]));
            q = axis >= 'x' ? q * one : one * q;  // lower case: turning with the body
        }
        return glm::normalize(q);
    }
    if (const auto v = element.numbers("xyaxes", 6, 6); !v.empty()) {
        const dvec3 x = unit_vector(element, "xyaxes", {v[0], v[1], v[2]});
        const dvec3 y0(v[3], v[4], v[5]), y = unit_vector(element, "xyaxes", y0 - x * glm::dot(x, y0));
        return glm::normalize(glm::quat_cast(dmat3(x, y, glm::cross(x, y))));
    }
    if (const auto z = element.numbers("zaxis", 3, 3); !z.empty())
        return turn_between({0, 0, 1}, unit_vector(element, "zaxis", {z[0], z[1], z[2]}));
    return {1, 0, 0, 0};
}

bool Mjcf::limited(Element& element, const char* key, const char* range) {
    const std::size_t said = element.word(key, {"false", "true", "auto"}, 2);
    if (said != 2) return said == 1;
    if (element.has(range) && !compiler_.autolimits)
        element.refuse(range, std::string("needs \"") + key + "\" where autolimits is false");
    return element.has(range);
}

void Mjcf::read_children(const host::XmlElement& tree, const Where& where) {
    for (const host::XmlElement& child : tree.children) {
        const std::string& tag = child.name;
        if (++elements_ > most_elements_read)
            Element(child, notes_).refuse("with replicas the model has more than 4000000 elements");
        if (tag == "body") {
            read_body(child, where);
        } else if (tag == "geom") {
            read_geom(child, where);
        } else if (tag == "joint" || tag == "freejoint") {
            read_joint(child, where);
        } else if (tag == "inertial") {
            if (where.body == world_body) Element(child, notes_).refuse("the world has no mass");
            read_inertial(child, where.body);
        } else if (tag == "frame") {
            read_frame(child, where);
        } else if (tag == "replicate") {
            read_replicas(child, where);
        } else if (tag == "site" || tag == "camera" || tag == "light") {
            Element(child, notes_).note("", "is left out; no motion depends on it");
        } else if (tag == "composite" || tag == "flexcomp" || tag == "plugin" || tag == "attach") {
            Element(child, notes_).refuse("is not read; remove it");
        } else {
            Element(child, notes_).note("", "is unknown here and left out");
        }
    }
}

void Mjcf::read_body(const host::XmlElement& tree, const Where& where) {
    Element element(tree, notes_);
    if (model_.bodies.size() >= std::min(most_bodies_, most_model_bodies))
        element.refuse("there are more bodies than fit into memory");
    const std::size_t index = model_.bodies.size();
    ModelBody body;
    body.origin = element.origin();
    body.name = element.text("name") + where.suffix;
    if (element.has("name") && !bodies_named_.try_emplace(body.name, index).second)
        element.refuse("there are two bodies of this name");
    body.parent = where.body;
    body.placed = where.frame * Placed{vector_of(element.numbers<3>("pos", {0, 0, 0})), turn(element)};
    body.kinematic = element.flag("mocap", false);
    if (body.kinematic && where.body != world_body) element.refuse("mocap", "is for bodies of the world alone");
    body.gravity_scale = static_cast<float>(1 - element.number("gravcomp", 0));
    Where inside{index, {}, element.text("childclass", where.childclass), where.suffix};
    element.ignore({"user"}, "is left out; no motion depends on it");
    element.ignore({"sleep"}, "is of MuJoCo's solver; scree has its own");
    element.finish();
    model_.bodies.push_back(std::move(body));
    has_inertial_.push_back(false);
    for (const host::XmlElement& child : tree.children) {
        if (child.name != "inertial") continue;
        if (has_inertial_[index]) Element(child, notes_).refuse("the body has two");
        has_inertial_[index] = true;
    }
    read_children(tree, inside);
    finish_mass(index);
}

void Mjcf::read_frame(const host::XmlElement& tree, const Where& where) {
    Element element(tree, notes_);
    Where inside = where;
    inside.frame = where.frame * Placed{vector_of(element.numbers<3>("pos", {0, 0, 0})), turn(element)};
    inside.childclass = element.text("childclass", where.childclass);
    element.finish();
    read_children(tree, inside);
}

void Mjcf::read_replicas(const host::XmlElement& tree, const Where& where) {
    Element element(tree, notes_);
    const long count = element.whole("count", 0);
    if (count < 1 || count > 1'000'000) element.refuse("count", "must be 1 to 1000000");
    const dvec3 offset = vector_of(element.numbers<3>("offset", {0, 0, 0}));
    const std::string separator = element.text("sep", "");
    const dquat step = turn(element);
    element.finish();
    Where inside = where;
    const int digits = static_cast<int>(std::to_string(count - 1).size());
    for (long i = 0; i < count; ++i) {
        if (++elements_ > most_elements_read) element.refuse("with replicas the model has more than 4000000 elements");
        std::string number = std::to_string(i);
        number.insert(0, static_cast<std::size_t>(digits) - number.size(), '0');
        inside.suffix = where.suffix + separator + number;
        read_children(tree, inside);
        inside.frame = inside.frame * Placed{offset, step};
    }
}

void Mjcf::read_inertial(const host::XmlElement& tree, std::size_t body) {
    Element element(tree, notes_);
    const double mass = element.number("mass", -1);
    if (!(mass >= 0)) element.refuse("mass", "is missing or below 0 kg");
    const Placed placed{vector_of(element.numbers<3>("pos", {0, 0, 0})), turn(element)};
    SolidMass own{mass, dvec3(0), dmat3(0)};
    const auto full = element.numbers("fullinertia", 6, 6);
    const auto diagonal = element.numbers("diaginertia", 3, 3);
    if (!full.empty()) {
        own.inertia = {full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5], full[2]};
    } else {
        if (diagonal.empty()) element.refuse("needs \"diaginertia\" or \"fullinertia\"");
        for (int k = 0; k < 3; ++k) own.inertia[k][k] = diagonal[static_cast<std::size_t>(k)];
    }
    element.finish();
    if (compiler_.from_geoms != 1) model_.bodies[body].mass = placed_mass(own, placed);
}

// After its geoms and inertial are read.
void Mjcf::finish_mass(std::size_t index) {
    ModelBody& body = model_.bodies[index];
    if (compiler_.from_geoms == 0 && !has_inertial_[index]) body.mass = {};
    SolidMass& mass = body.mass;
    if (mass.mass < compiler_.least_mass) mass.mass = compiler_.least_mass;
    if (!(compiler_.least_inertia > 0) && !compiler_.balance) return;
    const dmat3 axes = principal_axes(mass.inertia), along = glm::transpose(axes) * mass.inertia * axes;
    dvec3 moments;
    for (int k = 0; k < 3; ++k) moments[k] = std::max(along[k][k], compiler_.least_inertia);
    const double sum = moments.x + moments.y + moments.z;
    if (compiler_.balance && 2 * std::max({moments.x, moments.y, moments.z}) > sum * (1 + 1e-9)) moments = dvec3(sum / 3);
    mass.inertia = axes * diagonal(moments) * glm::transpose(axes);
}

void Mjcf::scale_masses() {
    if (!(compiler_.total_mass > 0)) return;
    double total = 0;
    model_.bodies[world_body].mass = {};
    for (const ModelBody& body : model_.bodies) total += body.mass.mass;
    if (total > 0)
        for (ModelBody& body : model_.bodies) body.mass = scaled_mass(body.mass, compiler_.total_mass / total);
}

void Mjcf::read_joint(const host::XmlElement& tree, const Where& where) {
    const bool free_joint = tree.name == "freejoint";
    Element element = free_joint ? Element(tree, notes_) : this->element(tree, where);
    if (where.body == world_body) element.refuse("the world has no joints");
    ModelBody& body = model_.bodies[where.body];
    const std::size_t kind = free_joint ? 3 : element.word("type", {"hinge", "slide", "ball", "free"}, 0);
    const std::string name = element.text("name") + where.suffix;
    if (element.has("name") &&
        !joints_named_.try_emplace(name, JointPlace{where.body, kind == 3 ? no_joint : body.joints.size()}).second)
        element.refuse("there are two joints of this name");
    element.ignore({"user", "group"}, "is left out; no motion depends on it");
    if (kind == 3) {
        if (body.parent != world_body) element.refuse("only a body of the world can be free");
        if (body.free || !body.joints.empty()) element.refuse("a free body has no other joint");
        body.free = true;
        element.ignore({"damping", "stiffness", "frictionloss", "armature"}, "of a free joint is left out");
        element.pass({"limited", "range", "pos", "axis", "ref", "springref", "type", "align", "margin", "actuatorfrclimited",
                      "actuatorfrcrange", "solreflimit", "solimplimit", "solreffriction", "solimpfriction", "springdamper"});
        return element.finish();
    }
    if (body.kinematic || body.free) element.refuse("a mocap or free body has no other joint");
    if (body.joints.size() == 6) element.refuse("the body has more than six joints");
    ModelJoint joint;
    joint.origin = element.origin();
    joint.name = name;
    joint.kind = kind == 0 ? ModelJoint::Kind::hinge : kind == 1 ? ModelJoint::Kind::slide : ModelJoint::Kind::ball;
    joint.anchor = where.frame * vector_of(element.numbers<3>("pos", {0, 0, 0}));
    joint.axis = where.frame.turn * unit_vector(element, "axis", vector_of(element.numbers<3>("axis", {0, 0, 1})));
    const auto coordinate = [&](double given) { return kind == 1 ? given : angle(given); };
    const double ref = coordinate(element.number("ref", 0));
    const bool has_range = limited(element, "limited", "range");
    const auto range = element.numbers<2>("range", {0, 0});
    if (has_range && limits_) joint.limits = {coordinate(range[0]) - ref, coordinate(range[1]) - ref};
    joint.reference = ref;
    joint.rest = coordinate(element.number("springref", 0)) - ref;
    joint.stiffness = springs_ ? element.number("stiffness", 0) : element.number("stiffness", 0) * 0;
    joint.damping = element.number("damping", 0) * (dampers_ ? 1 : 0);
    joint.friction = element.number("frictionloss", 0) * (frictions_ ? 1 : 0);
    joint.armature = element.number("armature", 0);
    for (const auto& [key, value] : {std::pair{"stiffness", joint.stiffness}, std::pair{"damping", joint.damping},
                                     std::pair{"frictionloss", joint.friction}, std::pair{"armature", joint.armature}})
        if (value < 0) element.refuse(key, "must not be below 0");
    element.ignore({"springdamper"}, "is left out; say stiffness and damping");
    element.ignore({"solreflimit", "solimplimit", "solreffriction", "solimpfriction", "margin"},
                   "is of MuJoCo's solver; scree has its own");
    element.ignore({"actuatorfrcrange", "actuatorfrclimited", "actuatorgravcomp"},
                   "is left out; forcerange of an actuator holds");
    element.finish();
    body.joints.push_back(std::move(joint));
}

}  // namespace scree::imports
