// The dense oracle of joints against closed forms, and the joint solver on the CPU against the oracle.
#include "tests/oracle/dense_joints.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compute/parallel/threads.h"
#include "compute/plan/plan.h"
#include "tests/oracle/joint_judge.h"
#include "tests/oracle/random_joints.h"

using namespace scree;
using namespace scree::oracle;
using glm::dvec3;

namespace {

DenseAxis lock() {
    DenseAxis axis;
    axis.drive = DenseAxis::Drive::lock;
    return axis;
}

// A body of 2 kg on a single axis, moving along it at `speed` (m/s).
DenseSolution slid(const DenseAxis& axis, double speed, double place = 0) {
    DenseBody body;
    body.inverse_mass = 0.5;
    body.inverse_inertia = dvec3(1);
    body.position.x = place;
    body.velocity.x = speed;
    DenseJoint joint;
    joint.b = 0;
    joint.axes.fill(lock());
    joint.axes[0] = axis;
    return solve_densely({body}, {joint}, {true, 0.01});
}

JointTablesNow tables_of(const State& state) {
    return {state.poses, state.velocities, state.joints, state.slots, state.slot_ends};
}

// Walks the plan on the CPU and judges every joint pass.
void judge_steps(const Scene& scene, JointVerdicts& verdicts) {
    const Settings settings = joint_settings();
    State state(scene, settings, 64, true);
    const Threads threads(1);
    for (int step = 0; step < judged_steps; ++step) {
        state.turn_over();
        for (const Stage& stage : plan(settings.substeps, state.features())) {
            const auto pass = joint_pass_of(stage.name, stage.pass);
            const JointTablesNow before = pass ? tables_of(state) : JointTablesNow{};
            stage.reference(state, threads, stage.pass);
            if (pass) verdicts.add(judge_joints(scene, state.joint_records, state.fixed(), before, tables_of(state), *pass));
        }
        REQUIRE(state.counted().contacts == 0);
    }
}

}  // namespace

TEST_CASE("oracle: a bob on a rigid rod keeps the speed around its pivot and loses that along the rod", "[oracle]") {
    DenseBody bob;
    bob.inverse_mass = 4;
    bob.position = dvec3(0, -2, 0);
    bob.velocity = dvec3(3, 1, 0);
    DenseJoint rod;
    rod.b = 0;
    rod.radial = true;
    rod.axes[0] = lock();
    rod.axes[0].rest = 2;
    const DenseSolution told = solve_densely({bob}, {rod}, {true, 0.001});
    REQUIRE(told.solved);
    CHECK(told.velocity[0].x == Approx(0).margin(1e-9));
    // Half a substep of centripetal acceleration v^2 / r inwards; the compliance of rigid rows is a thousandth.
    CHECK(told.velocity[0].y == Approx((-1 + 0.5 * 0.001 * 9 / 2) / 1.001).epsilon(1e-6));
}

TEST_CASE("oracle: two bodies held together go on with their common momentum", "[oracle]") {
    DenseBody a, b;
    a.inverse_mass = 1;
    b.inverse_mass = 0.25;
    a.inverse_inertia = b.inverse_inertia = dvec3(2, 3, 4);
    b.position = dvec3(1, 0.3, -0.2);
    a.velocity = dvec3(5, -2, 1);
    b.spin = dvec3(1, 2, 3);
    DenseJoint joint;
    joint.a = 0;
    joint.b = 1;
    joint.anchor_a = dvec3(0.5, 0, 0);
    joint.anchor_b = dvec3(-0.5, -0.3, 0.2);
    joint.axes.fill(lock());
    const DenseSolution told = solve_densely({a, b}, {joint}, {false, 0.001});
    REQUIRE(told.solved);
    CHECK(glm::length(told.velocity[0] + 4.0 * told.velocity[1]) < 1e-9);
    const dvec3 inertia = 1.0 / a.inverse_inertia;
    const dvec3 spun = inertia * (told.spin[0] + told.spin[1]);
    CHECK(glm::length(spun + glm::cross(b.position - a.position, 4.0 * told.velocity[1])) < 1e-9);
    const dvec3 at_a = (a.velocity + told.velocity[0]) + glm::cross(told.spin[0], joint.anchor_a);
    const dvec3 at_b = told.velocity[1] + glm::cross(b.spin + told.spin[1], joint.anchor_b);
    CHECK(glm::length(at_a - at_b) < 0.02 * 5);
}

TEST_CASE("oracle: a motor drives with its force and no more, up to its speed", "[oracle]") {
    DenseAxis axis;
    axis.drive = DenseAxis::Drive::motor;
    axis.speed = 3;
    axis.max_force = 40;
    CHECK(slid(axis, 0).velocity[0].x == Approx(40 * 0.01 / 2));
    CHECK(slid(axis, 2.95).velocity[0].x == Approx(0.05 / 1.001));
    CHECK(slid(axis, 9).velocity[0].x == Approx(-40 * 0.01 / 2));
}

TEST_CASE("oracle: a limit stops what would pass it within the substep and leaves the rest alone", "[oracle]") {
    DenseAxis axis;
    axis.limited = true;
    axis.lower = -1;
    axis.upper = 1;
    CHECK(slid(axis, 5, 0.5).velocity[0].x == 0);
    CHECK(slid(axis, 80, 0.5).velocity[0].x == Approx((50.0 - 80) / 1.001));
    CHECK(slid(axis, -80, 0.5).velocity[0].x == 0);
    CHECK(slid(axis, -200, 0.5).velocity[0].x == Approx((200.0 - 150) / 1.001));
    CHECK(slid(axis, 0, 1.01).velocity[0].x == Approx(-0.01 * 0.25 / 0.01 / 1.001));
}

TEST_CASE("oracle: a stiff spring is solved by implicit Euler, a weak one by its force", "[oracle]") {
    DenseAxis axis;
    axis.drive = DenseAxis::Drive::spring;
    axis.stiffness = 1e5;
    axis.damping = 100;
    axis.max_force = 1e30;
    // m dv = -h (k (x + h v) + c v)
    const double v = (2 * 3 - 0.01 * 1e5 * 0.1) / (2 + 0.01 * 0.01 * 1e5 + 0.01 * 100);
    CHECK(slid(axis, 3, 0.1).velocity[0].x == Approx(v - 3));
    axis.stiffness = 1000;
    axis.damping = 0;
    CHECK(slid(axis, 3, 0.1).velocity[0].x == Approx(-1000 * 0.1 * 0.01 / 2));
}

// Each of these mistakes was made in the laws or their loops, and failed this test by a factor of 300 or more:
//   linear_row: the Jacobian of A without the gap between the anchors
//   row_entry: two joints that share a body, A of the one and B of the other, coupled with the wrong sign
//   eliminate: no fill-in between the first and the later links of a joint
//   JOINT_COMPLIANCE twice what it is
// and that a limit lets go whatever it pushes with leaves a third of the passes with a law unmet.
TEST_CASE("oracle: the joint solver on the CPU agrees with the dense solution", "[oracle]") {
    JointVerdicts verdicts;
    for (const JointCase& what : joint_cases()) {
        INFO(what.name);
        for (std::uint32_t seed = 1; seed <= 3; ++seed) judge_steps(checked(random_block(what, seed)), verdicts);
        CHECK(verdicts.worst() < JointVerdicts::worst_allowed);
    }
    CHECK(verdicts.count() == 12 * 3 * judged_steps * 5);
    CHECK(verdicts.median() < JointVerdicts::median_allowed);
    CHECK(verdicts.part_that_meets_laws() > JointVerdicts::part_meeting_laws);
}
