// MJCF: contact pairs and exclusions, equalities, keyframes.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "compute/scene_file/import/mjcf/mjcf.h"

namespace scree::imports {

// Before the geoms are read: those of explicit pairs are classes of their own.
void Mjcf::note_pairs(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) {
        if (child.name != "pair") continue;
        Element pair = element(child, {});
        const std::string a = pair.text("geom1"), b = pair.text("geom2");
        if (a.empty() || b.empty()) pair.refuse("needs \"geom1\" and \"geom2\"");
        paired_.insert(a), paired_.insert(b);
        pairs_.emplace_back(a, b);
        if (pairs_.size() > 1000) pair.refuse("there are more than 1000 pairs");
        pair.ignore({"condim", "friction", "solref", "solimp", "solreffriction", "margin", "gap"},
                    "of a pair is left out; its geoms' own holds");
        pair.finish();
    }
}

std::size_t Mjcf::body_named(Element& element, const char* attribute, bool optional) {
    const std::string name = element.text(attribute);
    if (name.empty() && !optional) element.refuse(std::string("needs \"") + attribute + "\"");
    if (name.empty() || name == "world") return world_body;
    const auto found = bodies_named_.find(name);
    if (found == bodies_named_.end()) element.refuse(attribute, "there is no body \"" + name + "\"");
    return found->second;
}

void Mjcf::read_contact(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) {
        if (child.name == "pair") continue;
        Element element = this->element(child, {});
        if (child.name != "exclude") {
            element.note("", "is unknown here and left out");
            continue;
        }
        const std::size_t a = body_named(element, "body1"), b = body_named(element, "body2");
        if (a == b) element.refuse("a body does not collide with itself");
        model_.exclusions.emplace_back(a, b);
        element.finish();
    }
}

void Mjcf::read_equality(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) {
        Element element = this->element(child, {});
        const bool active = element.flag("active", true) && equalities_;
        if (!active) {
            element.note("active", "is false: it is left out");
            continue;
        }
        if (child.name == "joint" || child.name == "tendon") {
            read_coupling(child);
            continue;
        }
        const bool weld = child.name == "weld";
        if (!weld && child.name != "connect") element.refuse("scree has no such equality; remove it, or set active to false");
        if (element.has("site1")) element.refuse("site1", "is not read; name bodies");
        ModelTie tie;
        tie.origin = element.origin();
        tie.name = element.text("name");
        tie.a = body_named(element, "body1"), tie.b = body_named(element, "body2", true);
        tie.welded = weld;
        const auto anchor = element.numbers<3>("anchor", {0, 0, 0});
        if (!weld && !element.has("anchor")) element.refuse("needs an \"anchor\"");
        tie.anchor = {anchor[0], anchor[1], anchor[2]};
        if (weld) tie.anchor = dvec3(0);  // scree's holds the whole pose, wherever
        if (const auto pose = element.numbers("relpose", 7, 7); !pose.empty()) {
            const dquat q(pose[3], pose[4], pose[5], pose[6]);
            if (glm::length(q) > 1e-12) tie.b_in_a = Placed{{pose[0], pose[1], pose[2]}, glm::normalize(q)};
        }
        element.ignore({"solref", "solimp", "torquescale"}, "is of MuJoCo's solver; scree has its own");
        element.finish();
        model_.ties.push_back(std::move(tie));
    }
}

void Mjcf::read_keyframes(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) {
        if (child.name == "key")
            keyframes_.push_back(&child);
        else
            Element(child, notes_).note("", "is unknown here and left out");
    }
}

void Mjcf::take_keyframe() {
    const std::string& wanted = options_.keyframe;
    if (wanted.empty()) {
        if (!keyframes_.empty())
            Element(*keyframes_[0], notes_).note("", "is left out; --keyframe NAME (in Python keyframe=) starts there");
        return;
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    const bool number = error == std::errc() && end == wanted.data() + wanted.size();
    const host::XmlElement* chosen = number && index < keyframes_.size() ? keyframes_[index] : nullptr;
    for (const host::XmlElement* one : keyframes_)
        for (const host::XmlAttribute& attribute : one->attributes)
            if (attribute.name == "name" && attribute.value == wanted) chosen = one;
    if (!chosen)
        throw ImportError(folder_.shown() + ": there is no keyframe \"" + wanted + "\"; there are " +
                          std::to_string(keyframes_.size()));
    Element key(*chosen, notes_);
    std::size_t positions = 0, speeds = 0, mocaps = 0;
    for (const ModelBody& body : model_.bodies) {
        if (body.kinematic) ++mocaps;
        if (body.free) positions += 7, speeds += 6;
        for (const ModelJoint& joint : body.joints) {
            const bool ball = joint.kind == ModelJoint::Kind::ball;
            positions += ball ? 4 : 1, speeds += ball ? 3 : 1;
        }
    }
    const auto qpos = key.numbers("qpos", positions, positions), qvel = key.numbers("qvel", speeds, speeds);
    const auto mpos = key.numbers("mpos", 3 * mocaps, 3 * mocaps), mquat = key.numbers("mquat", 4 * mocaps, 4 * mocaps);
    controls_ = key.numbers("ctrl", 0, 1'000'000);
    const auto turn_at = [&](const std::vector<double>& from, std::size_t i, const char* name) {
        const dquat q(from[i], from[i + 1], from[i + 2], from[i + 3]);
        if (!(glm::length(q) > 1e-12)) key.refuse(name, "has a quaternion of length 0");
        return glm::normalize(q);
    };
    std::size_t p = 0, v = 0, m = 0;
    for (ModelBody& body : model_.bodies) {
        if (body.kinematic) {
            Placed start = body.placed;
            if (!mpos.empty()) start.position = {mpos[3 * m], mpos[3 * m + 1], mpos[3 * m + 2]};
            if (!mquat.empty()) start.turn = turn_at(mquat, 4 * m, "mquat");
            body.start = start;
            ++m;
        }
        if (body.free) {
            if (!qpos.empty()) body.start = Placed{{qpos[p], qpos[p + 1], qpos[p + 2]}, turn_at(qpos, p + 3, "qpos")};
            if (!qvel.empty())
                body.velocity = {qvel[v], qvel[v + 1], qvel[v + 2]}, body.spin = {qvel[v + 3], qvel[v + 4], qvel[v + 5]};
            p += 7, v += 6;
        }
        for (ModelJoint& joint : body.joints) {
            if (joint.kind == ModelJoint::Kind::ball) {
                if (!qpos.empty()) joint.start_turn = turn_at(qpos, p, "qpos");
                if (!qvel.empty() && (qvel[v] != 0 || qvel[v + 1] != 0 || qvel[v + 2] != 0))
                    key.note("qvel", "of a ball joint is left out");
                p += 4, v += 3;
                continue;
            }
            if (!qpos.empty()) joint.start = qpos[p] - joint.reference;
            if (!qvel.empty()) joint.start_speed = qvel[v];
            ++p, ++v;
        }
    }
    key.ignore({"act", "time"}, "of a keyframe is left out");
    key.finish();
}

}  // namespace scree::imports
