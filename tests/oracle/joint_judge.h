// What the dense oracle says of the passes that a step makes over its joints.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/step/state.h"
#include "tests/oracle/dense_joints.h"

namespace scree::oracle {

// The tables that a pass over the joints reads and writes.
struct JointTablesNow {
    std::vector<physics::Pose> poses;
    std::vector<physics::Velocity> velocities;
    std::vector<physics::Joint> joints;
    std::vector<physics::VelocityDelta> slots;
    std::vector<physics::uint> slot_ends;
};

enum class JointPass { warm_start, biased, unbiased, last_unbiased };

// The pass of a stage, if it is one over the joints.
std::optional<JointPass> joint_pass_of(const std::string& stage, std::uint32_t pass);

constexpr int judged_steps = 2;
Settings joint_settings();  // two substeps, in which a pass without bias hands on a warm start and one does not

// Differences of the bodies' changes from the oracle's, of the greatest change; of spins at half of what the bodies measure.
struct JointVerdict {
    double on_branches = 0;  // from the dense equations, bounds acting as the block solver says
    double of_law = 0;       // from the solution of the complementarity problem; not a number where the oracle found none
};
// All passes judged so far, against what a float can do. A rigid row yields by a thousandth of what its bodies give, so where
// rows repeat each other (rings, ladders) the equations are conditioned by some 3e4, and 6e-8 in a float becomes 2e-3 in the
// solution: no pass may be further off. Most blocks are far better conditioned, so half of all passes must be within 1e-4
// (measured: 9e-4 and 2e-5). Which bounds act is the block solver's own matter, within its rounds (JOINT_ROUNDS, SETTLING_ROUND):
// after the second it lets bounds go and takes up none, which leaves some laws unmet; nine passes in ten must meet them all
// (measured: 92 of 100).
class JointVerdicts {
public:
    static constexpr double worst_allowed = 2e-3, median_allowed = 1e-4, part_meeting_laws = 0.85;
    void add(const JointVerdict& verdict) { all_.push_back(verdict); }
    std::size_t count() const { return all_.size(); }
    double worst() const;
    double median() const;
    double part_that_meets_laws() const;

private:
    std::vector<JointVerdict> all_;
};

// `before`, `after`: the tables as the stage begins and as it has ended; `records`: of each joint of the scene (State), whose
// bodies lie in the tables from `first_body` on.
JointVerdict judge_joints(const Scene& scene, std::span<const std::uint32_t> records, const physics::Parameters& parameters,
                          const JointTablesNow& before, const JointTablesNow& after, JointPass pass, std::size_t first_body = 0);

}  // namespace scree::oracle
