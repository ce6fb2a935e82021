// The dense oracle of joints as the judge of the joint solver on a device.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/step/plan.h"
#include "host/vulkan/device.h"
#include "tests/oracle/joint_judge.h"
#include "tests/oracle/random_joints.h"

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

}  // namespace

TEST_CASE("oracle: the joint solver on the device agrees with the dense solution", "[oracle][vulkan]") {
    const auto device = host::Device::open({});
    const Settings settings = joint_settings();
    JointVerdicts verdicts;
    for (const JointCase& what : joint_cases()) {
        INFO(what.name);
        const Scene scene = checked(random_block(what, 1));
        DeviceRunner runner(device);
        State state(scene, settings, runner.group_size(), runner.in_place());
        runner.attach(state);
        const std::vector<Stage> stages = plan(settings.substeps, state.features());
        for (int step = 0; step < judged_steps; ++step) {
            runner.begin_step();
            for (std::size_t i = 0; i < stages.size(); ++i) {
                const auto pass = joint_pass_of(stages[i].name, stages[i].pass);
                const JointTablesNow before = pass ? tables_of(runner, state) : JointTablesNow{};
                runner.run_stage(i);
                if (pass)
                    verdicts.add(
                        judge_joints(scene, state.joint_records, state.fixed(), before, tables_of(runner, state), *pass));
            }
        }
        CHECK(verdicts.worst() < JointVerdicts::worst_allowed);
    }
    CHECK(verdicts.count() == 12 * judged_steps * 5);
    CHECK(verdicts.median() < JointVerdicts::median_allowed);
    CHECK(verdicts.part_that_meets_laws() > JointVerdicts::part_meeting_laws);
}
