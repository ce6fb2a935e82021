// Joints that are added or taken away while a world runs: blocks and lists are made anew, what lasts of the others stays.
#include <algorithm>

#include "compute/step/joint_blocks.h"
#include "compute/step/state.h"

namespace scree {

void State::rejoin(const Scene& scene, std::optional<std::size_t> without) {
    std::vector<physics::Joint> before;
    for (const std::uint32_t record : joint_records) before.push_back(joints[record]);
    if (without) before.erase(before.begin() + static_cast<std::ptrdiff_t>(*without));
    std::vector<physics::Traits> by_id;
    for (std::size_t id = 0; id < fixed().first_part; ++id) {
        by_id.push_back(traits[row_of(id)]);
        by_id.back().joints = physics::NONE;
    }
    JointTables made = joint_tables(scene, by_id);
    for (std::size_t id = 0; id < by_id.size(); ++id) traits[row_of(id)].joints = by_id[id].joints;
    for (physics::Joint& record : made.records)
        for (physics::uint* body : {&record.a, &record.b, &record.member})
            if (*body != physics::NONE) *body = row_of(*body);
    joints = std::move(made.records);
    joint_records = std::move(made.record_of);
    fixed().joint_blocks = made.blocks;
    for (std::size_t j = 0; j < std::min(before.size(), joint_records.size()); ++j) {
        physics::Joint& now = joints[joint_records[j]];
        const physics::Joint& was = before[j];
        std::copy(std::begin(was.rows), std::end(was.rows), now.rows);  // with the impulses that the next step begins with
        now.pins = was.pins;
        now.broken = was.broken;
        now.force = was.force;
        now.greatest_force = was.greatest_force;
        now.torque = was.torque;
        now.greatest_torque = was.greatest_torque;
    }
    for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
        const std::vector<Wheel>& wheels = scene.vehicles[v].wheels;
        for (std::size_t k = 0; k < wheels.size(); ++k) vehicles[v].wheel[k].joint = joint_records[wheels[k].joint];
    }
    allocate();
}

}  // namespace scree
