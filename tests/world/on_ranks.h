// What a script tells of a world on one processor and on several ranks.
#pragma once

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/distributed_runner.h"
#include "compute/distributed/in_process.h"
#include "compute/world.h"
#include "tests/world/coarse.h"
#include "tests/world/poisoned.h"

namespace scree::tests {

using Lines = std::vector<std::string>;
using TellingScript = std::function<Lines(World&)>;
using MakeRank = std::function<std::unique_ptr<Runner>(const std::shared_ptr<Exchange>&)>;

// Bodies that the step of this number finds beyond all scenes; none if there are none.
struct Poison {
    std::vector<std::size_t> bodies;
    int step = 0;
    template <class Base, class... Arguments>
    std::unique_ptr<Runner> in(Arguments&&... arguments) const {
        return std::make_unique<Poisoned<Base>>(bodies, step, 2e15f, std::forward<Arguments>(arguments)...);
    }
};

inline Lines told_by_one(const Scene& scene, const TellingScript& script, const Poison& poison = {}) {
    World world(scene, coarse(), poison.in<ReferenceRunner>(1));
    return script(world);
}

// By rank.
inline std::vector<Lines> told_by_ranks(int ranks, const Scene& scene, const TellingScript& script, const MakeRank& make) {
    std::vector<Lines> told(static_cast<std::size_t>(ranks));
    run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, coarse(), make(exchange));
        told[static_cast<std::size_t>(exchange->rank())] = script(world);
    });
    return told;
}
inline std::vector<Lines> told_by_ranks(int ranks, const Scene& scene, const TellingScript& script, const Poison& poison = {}) {
    return told_by_ranks(ranks, scene, script,
                         [&](const std::shared_ptr<Exchange>& exchange) { return poison.in<DistributedRunner>(exchange, 1); });
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
