// What a script tells of a world on one processor and on several ranks.
#pragma once

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/world.h"

namespace scree::tests {

using Lines = std::vector<std::string>;
using TellingScript = std::function<Lines(World&)>;
using MakeRank = std::function<std::unique_ptr<Runner>(const std::shared_ptr<Exchange>&)>;

inline Lines told_by_one(const Scene& scene, const TellingScript& script) {
    World world(scene, {}, make_reference_runner(1));
    return script(world);
}

// By rank.
inline std::vector<Lines> told_by_ranks(
    int ranks, const Scene& scene, const TellingScript& script,
    const MakeRank& make = [](const std::shared_ptr<Exchange>& exchange) { return make_distributed_runner(exchange); }) {
    std::vector<Lines> told(static_cast<std::size_t>(ranks));
    run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, {}, make(exchange));
        told[static_cast<std::size_t>(exchange->rank())] = script(world);
    });
    return told;
}

inline void check_alike(const std::vector<Lines>& told, const Lines& expected) {
    for (std::size_t rank = 0; rank < told.size(); ++rank) {
        INFO("rank " << rank << " of " << told.size());
        REQUIRE(told[rank].size() == expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            INFO("line " << i + 1);
            CHECK((told[rank][i] == expected[i]));  // they are long
        }
    }
}

// The bits of what joints() tells.
inline std::string line_of_joints(const World& world) {
    std::string line;
    for (const JointState& joint : world.joints()) {
        for (const vec3& v : {joint.force, joint.torque}) line += fmt::format("{:a} {:a} {:a} ", v.x, v.y, v.z);
        line += fmt::format("{:a} {:a} {:a}", joint.max_force, joint.max_torque, joint.gap);
        for (const float coordinate : joint.coordinates) line += fmt::format(" {:a}", coordinate);
        line += joint.broken ? " broken; " : "; ";
    }
    return line;
}

inline std::string line_of_vehicles(const World& world) {
    std::string line;
    for (std::size_t i = 0; i < world.scene().vehicles.size(); ++i) {
        const VehicleState vehicle = world.vehicle(i);
        line += fmt::format("{:a} {:a} throttle {:a} next {} passed {}; ", vehicle.speed, vehicle.curvature,
                            vehicle.controls.throttle, vehicle.next, vehicle.passed);
    }
    return line;
}

}  // namespace scree::tests
