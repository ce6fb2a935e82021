// Joint blocks: a scene's joints partitioned into blocks, each in elimination order.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/joint/joint_turns.h"

namespace scree {

struct State;

// All joints connected through dynamic bodies form one block, which the step solves directly. A block of more joints
// than this, or one whose elimination of a joint would fill in more than MAX_FILL_IN others, is cut in two; the parts
// share bodies like contacts (mass splitting). The joints of a block are eliminated one after the other, so larger ones
// would keep the others waiting.
constexpr std::size_t most_joints_of_block = physics::MAX_BLOCK_JOINTS;
// Of a graph whose blocks share more bodies than this, joints are softer (JOINT_CUT): stiff ones add energy to nets and to long
// chains. Machines that are cut at one or two bodies are stable, and stay stiff.
constexpr std::size_t most_shared_bodies = 2;

struct JointTables {
    std::vector<physics::Joint> joints;
    std::vector<physics::JointBlock> blocks;
    std::vector<physics::BlockBody> bodies;
    std::vector<std::uint32_t> record_of;  // index in `joints` by joint of the scene
};
// The tables of a checked scene; sets the head of each body's joint list in `properties`.
JointTables joint_tables(const Scene& scene, std::vector<physics::BodyProperties>& properties);
void take_joint_tables(State& state, JointTables tables);

// The six axes of a joint kind: x, y, z, twist, swing_y, swing_z. Where B turns about y or z alone, the record's x is that axis,
// its y and z are the next ones.
struct JointAxes {
    Axis axes[6];
    physics::uint flags = 0;  // JOINT_RADIAL, JOINT_CONE, JOINT_SPINS, JOINT_SWINGS
    std::size_t first = 0;    // axis of the kind that is the record's x
    std::size_t of_record(std::size_t k) const { return k / 3 * 3 + (k + first) % 3; }
    std::size_t in_record(std::size_t k) const { return k / 3 * 3 + (k + 3 - first) % 3; }
};
JointAxes axes_of_kind(const JointKind& kind);  // in the order of the record
physics::JointAxis axis_record(const Axis& axis);
physics::JointAxis axis_record(const JointAxes& axes, std::size_t k);
void set_axis_record(physics::Joint& joint, const JointAxes& axes, std::size_t k);  // of a joint whose flags are set
physics::JointRotor rotor_record(const Axis& axis);
// The coordinates of a joint whose bodies are at these poses.
physics::JointConfiguration configuration_of(const physics::Joint& joint, const physics::Pose& a, const physics::Pose& b,
                                             const physics::Parameters& p);
physics::JointConfiguration configuration_of(const State& state, const physics::Joint& joint);
// The rate of a coordinate of the record in that configuration; `flags`: those of the joint that count.
float speed_of_axis(const State& state, const physics::Joint& joint, physics::uint k, const physics::JointConfiguration& at,
                    physics::uint flags);
// Whole turns of a joint at its present poses as a world begins: those nearest to `angle`, or else the fewest that its limits
// allow, which a start may violate by a little.
float first_turns(const State& state, const physics::Joint& joint, std::optional<float> angle);
// The angle that a scene must tell, so that a joint begins with its present turns.
std::optional<float> angle_to_tell(const State& state, const physics::Joint& joint);
// J v of axis k at the present poses and velocities.
float speed_of_axis(const State& state, const physics::Joint& joint, physics::uint k);
// Lets a joint begin at the present poses and velocities: its turns, and its rotors with their axes. A coupling begins after the
// joints that it couples: its offset, if the scene gives none.
void start_joint(const State& state, physics::Joint& joint, std::optional<float> angle);
void start_joint(const State& state, physics::Joint& joint, const Joint& of);
void start_coupling(const State& state, physics::Joint& record, const Joint& joint);
void start_joints(State& state, const Scene& scene, std::size_t first, std::size_t last);  // of the scene, from `first`

// The coordinate of a coupling and its rate at the present poses and velocities.
struct CouplingState {
    float coordinate = 0, rate = 0;
};
CouplingState coupling_state(const State& state, const physics::Joint& record);
// Of a scene whose joints are checked. Throws SceneError for a coupling whose joints no block has together.
void check_couplings(const Scene& scene);

}  // namespace scree
