// World: its present scene, of all bodies or of one copy.
#include <algorithm>
#include <utility>

#include "compute/compile/joint_blocks.h"
#include "compute/scene/fracture.h"
#include "compute/world/world_impl.h"

namespace scree {

Scene World::snapshot() const {
    whole().require_one_copy("snapshot: name the copy (snapshot_of)");
    return whole().snapshot(std::nullopt);
}

Scene World::snapshot_of(std::size_t copy) const {
    whole().require_copy(copy);
    return whole().snapshot(copy);
}

Scene World::Impl::snapshot(std::optional<std::size_t> copy) const {
    Scene now = scene;
    if (copy) now.gravity = gravity_of(*copy);
    bring(body_ranges);
    std::vector<Body> there;
    std::vector<std::size_t> place_there(scene.bodies.size(), no_body);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (copy && copy_of(i) != *copy) continue;
        const BodyState at = body_state(i);
        if (!at.exists) continue;
        place_there[i] = there.size();
        Body& body = there.emplace_back(on_its_own(std::move(now.bodies[i])));
        if (body.motion == Motion::fixed) continue;
        body.position = at.position;
        body.orientation = at.orientation;
        body.velocity = at.velocity;
        body.angular_velocity = at.angular_velocity;
    }
    now.bodies = std::move(there);
    // Renumbers the body; true if it does not exist.
    const auto is_missing = [&](std::size_t& body) {
        if (body == the_world) return false;
        body = place_there[body];
        return body == no_body;
    };
    bring(joint_ranges);
    std::vector<Joint> joints;
    const auto is_there = [&](std::size_t i) {
        const Joint& joint = scene.joints[i];
        return !is_joint_gone(i) && (joint.a == the_world || place_there[joint.a] != no_body) &&
               (joint.b == the_world || place_there[joint.b] != no_body);
    };
    std::vector<std::size_t> joint_there(scene.joints.size(), no_body);
    for (std::size_t i = 0, next = 0; i < scene.joints.size(); ++i) {
        const auto* coupling = std::get_if<Coupling>(&scene.joints[i].kind);
        const bool whole = !coupling || std::all_of(coupling->joints.begin(), coupling->joints.end(),
                                                    [&](const CoupledAxis& term) { return is_there(term.joint); });
        if (whole && is_there(i)) joint_there[i] = next++;
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (joint_there[i] == no_body) continue;
        Joint joint = scene.joints[i];
        const physics::Joint& record = state.joints[state.joint_records[i]];
        joint.broken = record.broken != 0;
        joint.angle = angle_to_tell(state, record);
        if (auto* coupling = std::get_if<Coupling>(&joint.kind)) {
            coupling->offset = record.anchor_a.x;
            for (CoupledAxis& term : coupling->joints) term.joint = joint_there[term.joint];
        }
        is_missing(joint.a);
        is_missing(joint.b);
        joints.push_back(std::move(joint));
    }
    now.joints = std::move(joints);
    std::erase_if(now.exclusions, [&](Exclusion& pair) { return is_missing(pair.a) || is_missing(pair.b); });
    bring(bond_ranges);
    for (std::size_t i = 0; i < now.bonds.size(); ++i) now.bonds[i].broken = state.bond_states[i] != 0;
    std::erase_if(now.bonds, [&](Bond& bond) { return is_missing(bond.a) || is_missing(bond.b); });
    keep_vehicles(now, place_there, joint_there);
    return now;
}

}  // namespace scree
