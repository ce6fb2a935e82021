// Poses and velocities of a model's bodies from the coordinates of their joints.
#include "compute/scene/portable_math.h"
#include "compute/scene_file/import/model.h"

namespace scree::imports {

ModelMotion moved(const ModelMotion& parent, const ModelBody& body, bool at_start, std::size_t joints) {
    ModelMotion at{parent.placed * (at_start ? body.start.value_or(body.placed) : body.placed), parent.spin, parent.sweep};
    if ((body.free || body.kinematic) && at_start) {
        at.spin = at.placed.turn * body.spin;
        at.sweep = body.velocity - glm::cross(at.spin, at.placed.position);
    }
    if (!at_start) return at;
    for (std::size_t i = 0; i < joints; ++i) {
        const ModelJoint& joint = body.joints[i];
        const dvec3 axis = at.placed.turn * glm::normalize(joint.axis), anchor = at.placed * joint.anchor;
        if (joint.kind == ModelJoint::Kind::slide) {
            at.placed.position += axis * joint.start;
            at.sweep += axis * joint.start_speed;
            continue;
        }
        if (joint.kind == ModelJoint::Kind::hinge) {
            at.placed.turn = glm::normalize(portable::turn_about(axis, joint.start) * at.placed.turn);
            at.spin += axis * joint.start_speed;
            at.sweep += glm::cross(anchor, axis * joint.start_speed);
        } else {
            at.placed.turn = glm::normalize(at.placed.turn * joint.start_turn);
        }
        at.placed.position = anchor - at.placed.turn * joint.anchor;
    }
    return at;
}

std::vector<ModelMotion> motions_of(const Model& model, bool at_start) {
    std::vector<ModelMotion> all{{}};
    for (std::size_t b = 1; b < model.bodies.size(); ++b)
        all.push_back(moved(all[model.bodies[b].parent], model.bodies[b], at_start, model.bodies[b].joints.size()));
    return all;
}

}  // namespace scree::imports
