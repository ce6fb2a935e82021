// A device of the host program: what it must have, a world on it with the bits of the CPU, and leases of its tables.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "compute/device/body_lease.h"
#include "compute/device/make_device_runner.h"
#include "compute/world.h"
#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/device.h"
#include "host/vulkan/host_device.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// A host program's Vulkan: its instance and physical device are those of a device that was opened under validation, its device is
// of its own.
class Program {
public:
    explicit Program(bool timelines = true, bool addresses = true, bool validation = true)
        : opened_(host::Device::open({.validation = validation})), vk_(opened_->vk()) {
        features_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
        features_.timelineSemaphore = timelines;
        features_.bufferDeviceAddress = addresses;
        queue_info_.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue_info_.queueFamilyIndex = opened_->queue_family();
        queue_info_.queueCount = 1;
        queue_info_.pQueuePriorities = &priority_;
        info_.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info_.pNext = &features_;
        info_.queueCreateInfoCount = 1;
        info_.pQueueCreateInfos = &queue_info_;
        host::check(vk_.vkCreateDevice(opened_->physical(), &info_, nullptr, &device_), "making the program's device");
        REQUIRE(vk_.load_device(device_) == nullptr);
        vk_.vkGetDeviceQueue(device_, opened_->queue_family(), 0, &queue_);
    }
    ~Program() {
        vk_.vkDeviceWaitIdle(device_);
        for (VkSemaphore one : semaphores_) vk_.vkDestroySemaphore(device_, one, nullptr);
        vk_.vkDestroyDevice(device_, nullptr);
        for (const std::string& message : opened_->validation_messages()) FAIL_CHECK(message);
    }
    host::HostDevice described() {
        return {.instance = opened_->instance(),
                .physical = opened_->physical(),
                .device = device_,
                .queue = queue_,
                .queue_family = opened_->queue_family(),
                .made_with = &info_,
                .queue_mutex = &mutex_};
    }
    VkSemaphore timeline() {
        VkSemaphoreTypeCreateInfo type{};
        type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
        type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
        VkSemaphoreCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        info.pNext = &type;
        host::check(vk_.vkCreateSemaphore(device_, &info, nullptr, &semaphores_.emplace_back()), "making a semaphore");
        return semaphores_.back();
    }
    void open(VkSemaphore timeline, std::uint64_t value) {  // from the host
        const auto signal = reinterpret_cast<PFN_vkSignalSemaphore>(vk_.vkGetDeviceProcAddr(device_, "vkSignalSemaphore"));
        VkSemaphoreSignalInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
        info.semaphore = timeline;
        info.value = value;
        host::check(signal(device_, &info), "opening a semaphore");
    }
    const host::VulkanFunctions& vk() const { return vk_; }

private:
    std::shared_ptr<host::Device> opened_;
    host::VulkanFunctions vk_;
    const float priority_ = 1;
    VkPhysicalDeviceVulkan12Features features_{};
    VkDeviceQueueCreateInfo queue_info_{};
    VkDeviceCreateInfo info_{};
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::vector<VkSemaphore> semaphores_;
    std::mutex mutex_;
};

std::string refusal(const host::HostDevice& device) {
    try {
        host::Device::adopt(device);
    } catch (const host::DeviceError& error) {
        return error.what();
    }
    return "";
}

// The program's command buffer that copies a table, after `ready` and before `done` reaches `value`.
std::vector<float> copied(Program& program, const std::shared_ptr<host::Device>& device, const BodyLease& lease,
                          const LeasedTable& table, VkSemaphore done, std::uint64_t value) {
    host::Buffer read(device, "the program's copy", table.bytes, host::BufferUse::readback);
    host::CommandBuffer commands(device);
    const VkBufferCopy region{table.offset, 0, table.bytes};
    program.vk().vkCmdCopyBuffer(commands.handle(), table.buffer, read.handle(), 1, &region);
    commands.end();
    host::Submission(*device, {commands.handle()}, {lease.ready, lease.ready_value}, {done, value}).wait();
    std::vector<float> words(table.bytes / sizeof(float));
    std::memcpy(words.data(), read.mapped(), table.bytes);
    return words;
}

}  // namespace

TEST_CASE("a device of the program without what the step needs is refused by name", "[vulkan]") {
    Program program;
    REQUIRE(refusal(program.described()).empty());
    host::HostDevice device = program.described();
    device.queue = VK_NULL_HANDLE;
    CHECK(refusal(device) == "the device to adopt has no VkQueue");
    device = program.described();
    device.made_with = nullptr;
    CHECK(refusal(device) == "the device to adopt has no VkDeviceCreateInfo (made_with)");
    device = program.described();
    device.queue_family = 17;
    CHECK_THAT(refusal(device), Catch::Contains("a queue with compute (family 17)"));
    device = program.described();
    device.api_version = VK_API_VERSION_1_1;
    CHECK_THAT(refusal(device), Catch::Contains("an instance made for Vulkan 1.2"));
    Program without(false);
    CHECK_THAT(refusal(without.described()), Catch::Contains("the feature timelineSemaphore, which was not turned on"));
}

TEST_CASE("a world on a device of the program has the bits of the CPU, with and without addresses", "[vulkan]") {
    const bool addresses = GENERATE(false, true);
    CAPTURE(addresses);
    Program program(true, addresses);
    const auto device = host::Device::adopt(program.described());
    REQUIRE(device->report().has_addresses == addresses);
    REQUIRE(device->handle() == program.described().device);
    const Scene scene = tests::heap(60);
    World there(scene, {}, make_device_runner(device)), here(scene, {}, 1);
    there.step(40);
    here.step(40);
    REQUIRE(there.state_hash() == here.state_hash());
}

TEST_CASE("leased tables are those of the last step, and rise in generation when they grow", "[vulkan]") {
    Program program;
    const auto device = host::Device::adopt(program.described());
    World world(tests::heap(30), {}, make_device_runner(device));
    const VkSemaphore done = program.timeline();
    std::uint64_t value = 0, generation = lease_bodies(world.runner()).generation;
    const auto agree = [&] {
        const BodyLease lease = lease_bodies(world.runner());
        const std::vector<float> positions = copied(program, device, lease, lease.positions, done, ++value),
                                 orientations = copied(program, device, lease, lease.orientations, done, ++value),
                                 velocities = copied(program, device, lease, lease.velocities, done, ++value),
                                 turns = copied(program, device, lease, lease.angular_velocities, done, ++value);
        return_bodies(world.runner(), done, value);
        const std::vector<BodyState> bodies = world.bodies();
        REQUIRE(lease.rows >= bodies.size());
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const std::size_t pose = world.row_of(i) * lease.positions.stride / 4,
                              motion = world.row_of(i) * lease.velocities.stride / 4;
            for (int k = 0; k < 3; ++k) {
                REQUIRE(positions.at(pose + k) == bodies[i].position[k]);
                REQUIRE(velocities.at(motion + k) == bodies[i].velocity[k]);
                REQUIRE(turns.at(motion + k) == bodies[i].angular_velocity[k]);
            }
            for (int k = 0; k < 4; ++k) REQUIRE(orientations.at(pose + k) == bodies[i].orientation[k]);
        }
        return lease;
    };
    const BodyLease first = agree();
    world.step(5);
    const BodyLease second = agree();
    REQUIRE(second.ready_value == first.ready_value + 5);
    REQUIRE(second.ready == first.ready);
    std::vector<Body> more(200, Body{.shape = Sphere{0.1f}});
    for (std::size_t i = 0; i < more.size(); ++i)
        more[i].position = {0.3f * static_cast<float>(i % 20), 9, 0.3f * static_cast<float>(i / 20)};
    world.add_bodies(more);
    const BodyLease grown = agree();
    REQUIRE(grown.generation > generation);
    REQUIRE(grown.rows >= 230);
    world.step(3);
    agree();
}

TEST_CASE("a step, and the growth of buffers, wait for what the program still reads", "[vulkan]") {
    // The validation layer waits for its own count of a semaphore that the host signals, in vain, and then says so.
    Program program(true, true, false);
    const auto device = host::Device::adopt(program.described());
    World world(tests::heap(10), {}, make_device_runner(device));
    world.step(2);
    const auto opened_after = [&](const auto& work) {
        const VkSemaphore gate = program.timeline();
        return_bodies(world.runner(), gate, 1);
        std::atomic<bool> opened = false;
        std::thread opener([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            opened = true;
            program.open(gate, 1);
        });
        work();
        const bool was_opened = opened;
        opener.join();
        return was_opened;
    };
    REQUIRE(opened_after([&] { world.step(1); }));
    REQUIRE(opened_after([&] { world.add_bodies(std::vector<Body>(300, Body{.shape = Sphere{0.1f}, .position = {0, 30, 0}})); }));
    REQUIRE(opened_after([&] { world.step(3); }));
}

TEST_CASE("a runner without a device leases nothing, and says so", "[vulkan]") {
    World world(tests::heap(3), {}, 1);
    REQUIRE_THROWS_WITH(lease_bodies(world.runner()), Catch::Contains("the runner \"cpu\" has no tables on a device"));
    REQUIRE_THROWS_AS(return_bodies(world.runner(), VK_NULL_HANDLE, 0), std::invalid_argument);
}
