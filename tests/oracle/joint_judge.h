// The dense oracle as the judge of a step's joint passes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/tables/state.h"
#include "tests/oracle/dense_joints.h"

namespace scree::oracle {

// Tables that a joint pass reads and writes.
struct JointTablesNow {
    std::vector<physics::Pose> poses;
    std::vector<physics::Velocity> velocities;
    std::vector<physics::Joint> joints;
    std::vector<physics::VelocityDelta> slots;
    std::vector<physics::uint> slot_ends;
};

enum class JointPass { warm_start, biased, unbiased, last_unbiased };

// The joint pass of a stage, if it is one.
std::optional<JointPass> joint_pass_of(const std::string& stage, std::uint32_t pass);

constexpr int judged_steps = 2;
Settings joint_settings();  // two substeps: one relax pass precedes a warm start, the other does not

// Relative errors of the bodies' velocity changes against the oracle's largest change; angular velocities count at
// half the bodies' size.
struct JointVerdict {
    double on_branches = 0;  // against the dense equations with the block solver's active set
    double of_law = 0;       // against the solution of the complementarity problem; NaN where the oracle found none
};
// Statistics of all judged passes, with tolerances for single precision. Rigid rows have a compliance of a thousandth
// of their inverse effective mass, so with redundant rows (rings, ladders) the condition number is about 3e4, and
// 6e-8 in a float becomes 2e-3 in the solution: the limit for every pass. Most blocks are better conditioned, so half
// of all passes must be within 1e-4 (measured: 9e-4 and 2e-5). The block solver chooses its active set in a limited
// number of rounds (JOINT_ROUNDS, SETTLING_ROUND); after the second it only releases bounds, which leaves some laws
// unmet: nine of ten passes must satisfy all (measured: 92 of 100).
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

// `before`, `after`: tables before and after the stage; `records`: record of each joint of the scene (State); the
// scene's bodies begin at row `first_body`.
JointVerdict judge_joints(const Scene& scene, std::span<const std::uint32_t> records, const physics::Parameters& parameters,
                          const JointTablesNow& before, const JointTablesNow& after, JointPass pass, std::size_t first_body = 0);

}  // namespace scree::oracle
