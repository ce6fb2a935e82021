// The dense oracle of joints judges the joint solver on a device.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/plan/plan.h"
#include "host/vulkan/device.h"
#include "tests/oracle/joint_judge.h"
#include "tests/oracle/random_joints.h"
#include "tests/stages/watched_device.h"

using namespace scree;
using namespace scree::oracle;

namespace {

template <class Record>
void read(const DeviceRunner& runner, Table table, std::size_t count, std::vector<Record>& records) {
    records.resize(count);
    runner.read(table, std::as_writable_bytes(std::span(records)));
}

JointTablesNow tables_of(const DeviceRunner& runner, const State& state) {
    JointTablesNow tables;
    read(runner, Table::poses, state.fixed().bodies, tables.poses);
    read(runner, Table::velocities, state.fixed().bodies, tables.velocities);
    read(runner, Table::joints, runner.joint_records(), tables.joints);
    read(runner, Table::slot_ends, state.fixed().bodies, tables.slot_ends);
    read(runner, Table::slots, tables.slot_ends.back(), tables.slots);
    return tables;
}

// Three blocks of each case in a single scene, since compiling a scene's pipelines takes longest here.
struct Blocks {
    std::vector<Scene> each;
    Scene all;
};
Blocks three_of_each() {
    Blocks blocks;
    for (std::size_t i = 0; i < 3 * joint_cases().size(); ++i) {
        const Scene block = blocks.each.emplace_back(checked(random_block(joint_cases()[i / 3], 1 + i % 3)));
        const vec3 at(0, 0, 8 * static_cast<float>(blocks.each.size()) - 150);
        const std::size_t first = blocks.all.bodies.size();
        for (Body body : block.bodies) {
            body.position += at;
            blocks.all.bodies.push_back(body);
        }
        for (Joint joint : block.joints) {
            if (joint.a == the_world) joint.anchor_a += at;
            if (joint.a != the_world) joint.a += first;
            joint.b += first;
            blocks.all.joints.push_back(joint);
        }
        // Keep the oracle's copy in step.
        for (Joint& joint : blocks.each.back().joints)
            if (joint.a == the_world) joint.anchor_a += at;
    }
    return blocks;
}

}  // namespace

TEST_CASE("oracle: the joint solver on the device agrees with the dense solution", "[oracle][vulkan][process:kinds]") {
    const Blocks blocks = three_of_each();
    const Settings settings = joint_settings();
    const Watched watched;
    DeviceRunner runner(watched.device);
    State state(checked(blocks.all), settings, runner.group_size(), runner.in_place());
    runner.attach(state);
    const std::vector<Stage> stages = plan(settings.substeps, state.features());
    JointVerdicts verdicts;
    const auto judge = [&](const JointTablesNow& before, const JointTablesNow& after, JointPass pass) {
        std::size_t body = 0, joint = 0;
        for (const Scene& block : blocks.each) {
            const auto records = std::span(state.joint_records).subspan(joint, block.joints.size());
            verdicts.add(judge_joints(block, records, state.fixed(), before, after, pass, body));
            body += block.bodies.size();
            joint += block.joints.size();
        }
    };
    for (int step = 0; step < judged_steps; ++step) {
        runner.begin_step();
        for (std::size_t i = 0; i < stages.size(); ++i) {
            const auto pass = joint_pass_of(stages[i].name, stages[i].pass);
            const JointTablesNow before = pass ? tables_of(runner, state) : JointTablesNow{};
            runner.run_stages(i, i + 1);
            if (pass) judge(before, tables_of(runner, state), *pass);
        }
    }
    CHECK(verdicts.count() == blocks.each.size() * judged_steps * 5);
    CHECK(verdicts.worst() < JointVerdicts::worst_allowed);
    CHECK(verdicts.median() < JointVerdicts::median_allowed);
    CHECK(verdicts.part_that_meets_laws() > JointVerdicts::part_meeting_laws);
}
