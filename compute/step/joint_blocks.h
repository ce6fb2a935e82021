// Joint blocks: a scene's joints partitioned into blocks, each in elimination order.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"

namespace scree {

struct State;

// All joints connected through dynamic bodies form one block, which the step solves directly. A block of more joints
// than this, or one whose elimination of a joint would fill in more than MAX_FILL_IN others, is cut in two; the parts
// share bodies like contacts (mass splitting). The joints of a block are eliminated one after the other, so larger ones
// would keep the others waiting.
constexpr std::size_t most_joints_of_block = physics::MAX_BLOCK_JOINTS;

struct JointTables {
    std::vector<physics::Joint> joints;
    std::vector<physics::JointBlock> blocks;
    std::vector<physics::BlockBody> bodies;
    std::vector<std::uint32_t> record_of;  // index in `joints` by joint of the scene
};
// The tables of a checked scene; sets the head of each body's joint list in `properties`.
JointTables joint_tables(const Scene& scene, std::vector<physics::BodyProperties>& properties);
void take_joint_tables(State& state, JointTables tables);

// The six axes of a joint kind: x, y, z, twist, swing_y, swing_z.
struct JointAxes {
    Axis axes[6];
    physics::uint flags = 0;  // JOINT_RADIAL, JOINT_CONE
};
JointAxes axes_of_kind(const JointKind& kind);
physics::JointAxis axis_record(const Axis& axis);
physics::JointRotor rotor_record(const Axis& axis);
// J v of axis k at the present poses and velocities.
float speed_of_axis(const State& state, const physics::Joint& joint, physics::uint k);
// Lets a joint's rotors turn with their axes.
void start_rotors(const State& state, physics::Joint& joint);

}  // namespace scree
