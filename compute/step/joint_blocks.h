// The joints of a scene as the step needs them: cut into blocks, and each block in an order of elimination.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"

namespace scree {

// All joints that hang together through bodies that move are one block, which the step solves exactly; a block of more than
// this many, or one so entangled that eliminating a joint would change more than MOST_LINKS others, is cut in two, and the parts
// share their bodies as contacts do. One thread works on a block, so more would keep the others waiting.
constexpr std::size_t most_joints_of_block = 128;

struct JointTables {
    std::vector<physics::Joint> records;
    std::vector<std::uint32_t> record_of;  // of each joint of the scene
    physics::uint blocks = 0;
};
// Of a checked scene; says in the properties where each body's list of joints begins.
JointTables joint_tables(const Scene& scene, std::vector<physics::BodyProperties>& properties);

// The axes of a record, for a kind of joint: along x, y, z, twist, swing about y, about z.
struct JointAxes {
    Axis axes[6];
    physics::uint flags = 0;  // JOINT_RADIAL, JOINT_CONE
};
JointAxes axes_of_kind(const JointKind& kind);
physics::JointAxis axis_record(const Axis& axis);

}  // namespace scree
