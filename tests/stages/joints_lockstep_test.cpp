// Joints of every kind: the same bits on both processors.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/scene.h"
#include "compute/world.h"
#include "host/vulkan/device.h"

using namespace scree;

namespace {

// Rows of capsules that hang from the world, fall on a ground and fall asleep; each row with other kinds between them.
Scene all_kinds() {
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    Hinge limited, driven, sprung;
    limited.turn.limits = Limits{-0.3f, 0.5f};
    driven.turn.motor = Motor{2, 3};
    sprung.turn.spring = Spring{2000, 5, 0.3f};  // too stiff to be a mere force
    Slider damped;
    damped.slide.spring = Spring{500, 5, 0};
    SixDegrees wheel;
    wheel.x.locked = wheel.z.locked = wheel.swing_z.locked = true;
    wheel.y.limits = Limits{-0.1f, 0.1f};
    wheel.twist.motor = Motor{5, 1};
    wheel.swing_y.spring = Spring{50, 2, 0.2f};
    const std::vector<std::vector<JointKind>> rows = {
        {Ball{}, Ball{0.5f}, limited, ConeTwist{0.4f, {-0.2f, 0.2f}, 0.1f}, driven, Fixed{}},
        {Ball{}, damped, sprung, wheel, Distance{0.1f, 0.3f, Spring{1000, 1, 0.2f}}, limited},
        {Distance{0.2f, 0.2f, {}}, Ball{}, Fixed{}, driven, Ball{}, Distance{0, 0.3f, {}}}};
    for (std::size_t k = 0; k < rows.size(); ++k) {
        std::size_t before = the_world;
        for (std::size_t i = 0; i < rows[k].size(); ++i) {
            const float x = 0.5f * static_cast<float>(i), z = 0.6f * static_cast<float>(k);
            Body body;
            body.shape = Capsule{0.05f, 0.2f};
            body.position = {x + 0.25f, 0.9f, z};
            body.orientation = {0, 0, 0.70710678f, 0.70710678f};
            scene.bodies.push_back(body);
            const std::size_t now = scene.bodies.size() - 1;
            Joint joint = joint_at(scene, rows[k][i], before, now, {x, 0.9f, z}, {0, 0, 1});
            if (i == 3) joint.break_force = 150;
            scene.joints.push_back(joint);
            before = now;
        }
    }
    return scene;
}

}  // namespace

TEST_CASE("joints of every kind give the same bits on both processors, and validation stays silent") {
    host::DeviceOptions options;
    options.validation = true;
    const auto device = host::Device::open(options);
    Settings settings;
    settings.sleep_time = 0.2f;
    Lockstep lockstep(all_kinds(), settings, device, 2);
    for (int i = 0; i < 60 && lockstep.step(); ++i) continue;
    const LockstepResult& result = lockstep.result();
    INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                 << result.detail);
    CHECK(result.equal);
    for (const std::string& message : device->validation_messages()) FAIL_CHECK(message);
}

TEST_CASE("joints that come and go while a world runs give the same bits on both processors") {
    host::DeviceOptions options;
    options.validation = true;
    options.on_message = [](const std::string& message) { FAIL_CHECK(message); };
    Scene bare = all_kinds();
    const std::vector<Joint> joints = bare.joints;
    bare.joints.clear();
    World cpu(bare, {}, 2), there(bare, {}, make_device_runner(host::Device::open(options)));
    for (int step = 0; step < 30; ++step) {
        for (World* world : {&cpu, &there}) {
            // None, then all, then every second one goes, and two chains are tied together where they are.
            if (step == 3)
                for (const Joint& joint : joints) world->add_joint(joint);
            if (step == 12)
                for (std::size_t j = joints.size(); j-- > 0;)
                    if (j % 2 == 1) world->remove_joint(j);
            if (step == 20) world->add_joint(world->joint_at(Fixed{}, 1, 7, world->body(1).position));
            world->step();
        }
        CAPTURE(step);
        REQUIRE(there.state_hash() == cpu.state_hash());
    }
    CHECK(there.joint(2).greatest_force == cpu.joint(2).greatest_force);
    CHECK(cpu.statistics().not_finite == 0);
}
