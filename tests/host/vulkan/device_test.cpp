// Devices, buffers, pipelines and command buffers, for every kind of buffer access, with validation.
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cctype>
#include <chrono>
#include <cstring>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "host/files/file.h"
#include "host/spirv/spirv.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/transfer.h"
#include "tests/host/vulkan/compiled.h"
#include "tests/temporary_folder.h"

using namespace scree::host;
using namespace scree::tests;

namespace {

// A device with validation; any message fails the test.
class Watched {
public:
    explicit Watched(bool staged = false)
        : device_(Device::open({.which = "", .validation = true, .staged = staged, .on_message = {}})) {}
    ~Watched() {
        for (const std::string& message : device_->validation_messages()) FAIL_CHECK(message);
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
    const std::shared_ptr<Device>& get() const { return device_; }
    const std::shared_ptr<Device>& operator->() const { return device_; }

private:
    std::shared_ptr<Device> device_;
};

constexpr std::uint32_t group = 64;

const std::vector<std::uint32_t>& affine() {
    static const std::vector<std::uint32_t> words = without_contraction(compiled(R"(
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint addend = 1u;
layout(push_constant) uniform Push { uint count; uint factor; };
layout(std430, binding = 0) buffer Input { uint inputs[]; };
layout(std430, binding = 1) buffer Output { uint outputs[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    outputs[i] = inputs[i] * factor + addend;
}
)"));
    return words;
}

struct Push {
    std::uint32_t count, factor;
};

}  // namespace

TEST_CASE("devices are listed with what they are and what they lack") {
    const std::vector<DeviceReport> reports = list_devices();
    REQUIRE_FALSE(reports.empty());
    for (std::size_t i = 0; i < reports.size(); ++i) {
        REQUIRE(reports[i].index == static_cast<int>(i));
        REQUIRE_FALSE(reports[i].name.empty());
        REQUIRE_FALSE(reports[i].driver.empty());
        REQUIRE(reports[i].memory_bytes > 0);
        REQUIRE(reports[i].largest_binding >= (1u << 27));
    }
}

TEST_CASE("a device that does not exist is refused with the list of those that do") {
    const std::string first = list_devices().front().name;
    for (const char* which : {"7777", "no such card", "99999999999999999999"}) {
        REQUIRE_THROWS_WITH(Device::open({.which = which, .validation = false, .staged = false, .on_message = {}}),
                            Catch::Contains(std::string("no Vulkan device ") + which + "; there are: 0 " + first));
    }
}

TEST_CASE("a device is found by index and by part of its name in any case") {
    DeviceReport usable;
    for (const DeviceReport& report : list_devices()) {
        if (report.lacks.empty()) usable = report;
    }
    std::string part = usable.name.substr(0, 5);
    for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    for (const std::string& which : {std::to_string(usable.index), part}) {
        const auto device = Device::open({.which = which, .validation = false, .staged = false, .on_message = {}});
        REQUIRE(device->report().name.substr(0, 5) == usable.name.substr(0, 5));
    }
}

TEST_CASE("validation notices a mistake and forwards it") {
    std::string forwarded;
    const auto device =
        Device::open({.which = "", .validation = true, .staged = false, .on_message = [&](const std::string& message) {
                          forwarded += message;
                      }});
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;  // size 0, which is invalid
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    device->vk().vkCreateBuffer(device->handle(), &info, nullptr, &buffer);
    if (buffer) device->vk().vkDestroyBuffer(device->handle(), buffer, nullptr);
    REQUIRE_THAT(forwarded, Catch::Contains("VUID-VkBufferCreateInfo-size"));
    REQUIRE_FALSE(device->validation_messages().empty());
}

TEST_CASE("synchronisation validation notices a missing barrier") {
    const auto device = Device::open({.which = "", .validation = true, .staged = false, .on_message = {}});
    const Buffer a(device, "a", 256), b(device, "b", 256), c(device, "c", 256);
    CommandBuffer commands(device);
    commands.copy(a, b, 256);
    commands.copy(b, c, 256);
    commands.end();
    REQUIRE(device->validation_messages().size() == 1);
    REQUIRE_THAT(device->validation_messages()[0], Catch::Contains("READ_AFTER_WRITE") || Catch::Contains("READ-AFTER-WRITE"));
}

TEST_CASE("buffers begin as zero and give back what was written") {
    const bool staged = GENERATE(false, true);
    const BufferUse use = GENERATE(BufferUse::storage, BufferUse::upload, BufferUse::readback);
    CAPTURE(staged, static_cast<int>(use));
    const Watched device(staged);
    for (std::size_t bytes :
         {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{4097}, (std::size_t{33} << 20) + 5}) {
        Buffer buffer(device.get(), "round trip", bytes, use);
        REQUIRE(buffer.bytes() == bytes);
        REQUIRE((buffer.mapped() == nullptr) == (staged && use == BufferUse::storage));
        std::vector<unsigned char> got(bytes, 0xAB);
        buffer.read(got.data(), bytes);
        REQUIRE(got == std::vector<unsigned char>(bytes, 0));
        std::vector<unsigned char> values(bytes);
        std::iota(values.begin(), values.end(), static_cast<unsigned char>(1));
        buffer.write(values.data(), bytes);
        buffer.read(got.data(), bytes);
        REQUIRE(got == values);
        if (bytes < 64) continue;
        const unsigned char middle[3] = {200, 201, 202};
        buffer.write(middle, 3, 31);
        std::memcpy(values.data() + 31, middle, 3);
        buffer.read(got.data(), bytes - 7, 7);
        REQUIRE(std::memcmp(got.data(), values.data() + 7, bytes - 7) == 0);
    }
}

TEST_CASE("a range outside a buffer is refused") {
    const Watched device;
    Buffer buffer(device.get(), "small", 16);
    char data[32] = {};
    REQUIRE_THROWS_AS(buffer.write(data, 17), std::out_of_range);
    REQUIRE_THROWS_AS(buffer.read(data, 1, 16), std::out_of_range);
    REQUIRE_THROWS_AS(buffer.read(data, 2, ~std::size_t{0}), std::out_of_range);
    CommandBuffer commands(device.get());
    REQUIRE_THROWS_AS(commands.copy(buffer, buffer, 8, 12, 0), std::out_of_range);
    REQUIRE_THROWS_AS(commands.dispatch_indirect(buffer, 8), std::out_of_range);
    commands.end();
}

TEST_CASE("of overlapping pieces of an upload the last one counts, with and without staging") {
    const bool staged = GENERATE(false, true);
    const Watched device(staged);
    Buffer buffer(device.get(), "pieces", 64);
    std::vector<std::byte> ones(32, std::byte{1}), twos(16, std::byte{2}), threes(8, std::byte{3}), got(64);
    upload(device.get(), std::vector<Upload>{{ones, &buffer, 0}, {twos, &buffer, 8}, {ones, &buffer, 32}, {threes, &buffer, 4}});
    buffer.read(got.data(), got.size());
    for (std::size_t i = 0; i < got.size(); ++i)
        REQUIRE(static_cast<int>(got[i]) == (i >= 4 && i < 12 ? 3 : i >= 8 && i < 24 ? 2 : 1));
}

TEST_CASE("a transfer is used again for more and for less, also after a range that it refused") {
    const bool staged = GENERATE(false, true);
    const Watched device(staged);
    Transfer transfer(device.get());
    const std::size_t most = (std::size_t{16} << 20) + 4096;  // more than a submission stages
    Buffer buffer(device.get(), "bytes", most);
    for (const std::size_t bytes : {std::size_t{8}, std::size_t{100000}, most, std::size_t{12}}) {
        std::vector<std::byte> sent(bytes), got(bytes);
        for (std::size_t i = 0; i < bytes; ++i) sent[i] = static_cast<std::byte>(i * 7 + bytes);
        transfer.upload(std::vector<Upload>{{sent, &buffer, most - bytes}});
        REQUIRE_THROWS_AS(transfer.upload(std::vector<Upload>{{sent, &buffer, most - bytes + 1}}), std::out_of_range);
        transfer.download(std::vector<Download>{{got, &buffer, most - bytes}});
        REQUIRE(got == sent);
    }
}

TEST_CASE("a command buffer records again what it shall do, with timestamps") {
    const Watched device;
    Buffer a(device.get(), "a", 64), b(device.get(), "b", 64);
    CommandBuffer commands(device.get(), 2);
    for (const std::uint32_t word : {0x01010101u, 0x02020202u}) {
        if (word != 0x01010101u) commands.begin_again();
        commands.timestamp();
        commands.fill(a, word, 32, 16);
        commands.barrier();
        commands.copy(a, b, 64);
        commands.timestamp();
        commands.end();
        device.get()->submit_and_wait({commands.handle()});
        REQUIRE(commands.timestamp_seconds().size() <= 1);
        std::vector<std::byte> got(64);
        b.read(got.data(), got.size());
        for (std::size_t i = 0; i < got.size(); ++i)
            REQUIRE(static_cast<std::uint32_t>(got[i]) == (i >= 16 && i < 48 ? word & 0xFF : 0));
    }
    REQUIRE_THROWS_AS(commands.fill(a, 0, 32, 36), std::out_of_range);
}

TEST_CASE("a buffer larger than a binding is refused by name where it is to be bound, and found by its address") {
    DeviceOptions options;
    options.largest_binding = 1000;
    const auto device = Device::open(options);
    const Buffer buffer(device, "pairs", 1001);
    const auto bound = std::make_shared<BindingSetLayout>(device, 1, 0);
    REQUIRE_THROWS_WITH(BindingSet(bound, {&buffer}),
                        Catch::Contains("the buffer pairs of 1001") && Catch::Contains("once, 1000"));
    REQUIRE(device->report().has_addresses);
    REQUIRE(buffer.address() != 0);
    const auto far = std::make_shared<BindingSetLayout>(device, 1, 0, Reach::far);
    REQUIRE_NOTHROW(BindingSet(far, {&buffer}));
}

TEST_CASE("a moved buffer keeps its bytes and leaves an empty one") {
    const Watched device;
    Buffer first(device.get(), "first", 16);
    first.write("moved", 6);
    Buffer second = std::move(first);
    char text[6] = {};
    second.read(text, 6);
    REQUIRE(std::string(text) == "moved");
    REQUIRE_FALSE(static_cast<bool>(first));  // NOLINT(bugprone-use-after-move): what is left is empty
    second = Buffer();
    REQUIRE_FALSE(static_cast<bool>(second));
}

TEST_CASE("a dispatch with push constants reaches every item and no other") {
    const bool staged = GENERATE(false, true);
    const bool indirect = GENERATE(false, true);
    const std::uint32_t count = GENERATE(0u, 1u, group - 1, group, group + 1, 1234u);
    CAPTURE(staged, indirect, count);
    const Watched device(staged);
    const std::uint32_t room = 2000, poison = 0xDEADBEEFu;
    Buffer inputs(device.get(), "inputs", room * 4), outputs(device.get(), "outputs", room * 4),
        arguments(device.get(), "arguments", 28);
    std::vector<std::uint32_t> values(room), got(room, poison);
    std::iota(values.begin(), values.end(), 3u);
    inputs.write(values.data(), room * 4);
    outputs.write(got.data(), room * 4);
    const VkDispatchIndirectCommand groups{(count + group - 1) / group, 1, 1};
    arguments.write(&groups, sizeof groups, 16);

    auto layout = std::make_shared<BindingSetLayout>(device.get(), 3, 8);
    const BindingSet table(layout, {&inputs, &outputs, nullptr});
    const Pipeline pipeline(layout, "affine", affine(), {5});
    CommandBuffer commands(device.get(), 3);
    commands.bind(pipeline, table);
    const Push push{count, 7};
    commands.push(&push, sizeof push);
    commands.timestamp();
    indirect ? commands.dispatch_indirect(arguments, 16) : commands.dispatch(groups.x);
    commands.barrier();
    commands.timestamp();
    commands.copy(outputs, inputs, 4, 4 * (room - 1), 4 * (room - 1));
    commands.timestamp();
    commands.end();
    for (int again = 0; again < 2; ++again) device->submit_and_wait({commands.handle()});
    device->submit_and_wait({commands.handle(), commands.handle()});

    outputs.read(got.data(), room * 4);
    for (std::uint32_t i = 0; i < room; ++i) REQUIRE(got[i] == (i < count ? values[i] * 7 + 5 : poison));
    inputs.read(got.data(), 4, 4 * (room - 1));
    REQUIRE(got[0] == poison);
    const std::vector<double> seconds = commands.timestamp_seconds();
    REQUIRE(seconds.size() == (device->timestamp_bits() > 0 ? 2u : 0u));
    for (double s : seconds) REQUIRE((s >= 0 && s < 10));
}

TEST_CASE("stages that feed each other through a barrier run in order") {
    const Watched device;
    const std::uint32_t count = 1000;
    Buffer a(device.get(), "a", count * 4), b(device.get(), "b", count * 4);
    auto layout = std::make_shared<BindingSetLayout>(device.get(), 2, 8);
    const BindingSet there(layout, {&a, &b}), back(layout, {&b, &a});
    const Pipeline pipeline(layout, "affine", affine(), {1});
    CommandBuffer commands(device.get());
    const Push push{count, 2};
    for (int i = 0; i < 10; ++i) {
        commands.bind(pipeline, i % 2 == 0 ? there : back);
        if (i == 0) commands.push(&push, sizeof push);
        commands.dispatch((count + group - 1) / group);
        commands.barrier();
    }
    commands.zero(b);
    commands.end();
    device->submit_and_wait({commands.handle()});
    std::vector<std::uint32_t> got(count);
    a.read(got.data(), count * 4);
    REQUIRE(got == std::vector<std::uint32_t>(count, 1023));
    b.read(got.data(), count * 4);
    REQUIRE(got == std::vector<std::uint32_t>(count, 0));
}

TEST_CASE("equal pipelines of a device are one, whoever made the first, and others are not") {
    const Watched device;
    VkPipeline first;
    {
        const Pipeline made(std::make_shared<BindingSetLayout>(device.get(), 2, 8), "affine", affine(), {1});
        first = made.handle();
    }
    const auto layout = std::make_shared<BindingSetLayout>(device.get(), 2, 8);
    CHECK(Pipeline(layout, "again", affine(), {1}).handle() == first);
    CHECK(Pipeline(layout, "affine", affine(), {2}).handle() != first);
    CHECK(Pipeline(std::make_shared<BindingSetLayout>(device.get(), 3, 8), "affine", affine(), {1}).handle() != first);
    CHECK(device->pipelines().size() == 3);
}

TEST_CASE("a device keeps the most recently used of its pipelines") {
    const Watched device;
    SharedPipelines pipelines(2);
    const auto was_made = [&](std::uint64_t key) {
        bool made = false;
        pipelines.get({key, 0}, [&] {
            made = true;
            return std::make_shared<MadePipeline>(device->vk(), device->handle(), VK_NULL_HANDLE);
        });
        return made;
    };
    CHECK(was_made(1));
    CHECK(was_made(2));
    CHECK_FALSE(was_made(1));
    CHECK(was_made(3));
    CHECK(pipelines.size() == 2);
    CHECK_FALSE(was_made(1));
    CHECK(was_made(2));
}

TEST_CASE("a pipeline that threads ask for at once is made once, and by another thread if its maker fails") {
    const Watched device;
    SharedPipelines pipelines;
    std::atomic<int> asked = 0, failed = 0, made = 0;
    std::array<SharedPipelines::Made, 8> got;
    std::vector<std::thread> threads;
    for (SharedPipelines::Made& one : got)
        threads.emplace_back([&] {
            const auto make = [&] {
                while (asked < 8) std::this_thread::yield();
                if (failed++ == 0) throw std::runtime_error("no memory");
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                ++made;
                return std::make_shared<MadePipeline>(device->vk(), device->handle(), VK_NULL_HANDLE);
            };
            ++asked;
            try {
                one = pipelines.get({1, 0}, make);
            } catch (const std::runtime_error&) {
            }
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(made == 1);
    CHECK(std::count(got.begin(), got.end(), nullptr) == 1);
    CHECK(std::set<SharedPipelines::Made>(got.begin(), got.end()).size() == 2);
}

TEST_CASE("wrong use of a table, a pipeline and a recording is refused with its reason") {
    const Watched device;
    const Buffer buffer(device.get(), "buffer", 16);
    REQUIRE_THROWS_AS(BindingSetLayout(device.get(), 1u << 30, 0), DeviceError);
    REQUIRE_THROWS_AS(BindingSetLayout(device.get(), 1, 1u << 20), DeviceError);
    auto layout = std::make_shared<BindingSetLayout>(device.get(), 2, 8);
    REQUIRE_THROWS_AS(BindingSet(layout, {&buffer}), std::invalid_argument);
    REQUIRE_THROWS_WITH(Pipeline(layout, "broken", std::vector<std::uint32_t>{1, 2, 3}),
                        Catch::Contains("broken: not a SPIR-V module"));
    CommandBuffer commands(device.get(), 1);
    const Push push{1, 1};
    REQUIRE_THROWS_AS(commands.push(&push, sizeof push), std::logic_error);
    const Pipeline pipeline(layout, "affine", affine());
    const BindingSet table(layout, {&buffer, &buffer});
    commands.bind(pipeline, table);
    REQUIRE_THROWS_AS(commands.push(&push, 12), std::invalid_argument);
    commands.timestamp();
    REQUIRE_THROWS_AS(commands.timestamp(), std::out_of_range);
    if (device->limits().maxComputeWorkGroupCount[0] < ~0u) {
        REQUIRE_THROWS_AS(commands.dispatch(~0u), DeviceError);
    }
}

TEST_CASE("a damaged pipeline cache is ignored and replaced") {
    const scree::tests::TemporaryFolder folder;
    const char* before = getenv("XDG_CACHE_HOME");
    const std::string kept = before ? before : "";
    setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
    std::vector<std::filesystem::path> files;
    { const Watched device; }
    if (std::filesystem::exists(folder.path() / "scree")) {
        for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "scree")) files.push_back(entry.path());
    }
    CHECK(files.size() == 1);
    for (const std::filesystem::path& file : files) {
        const std::string whole = read_text(file);
        for (const std::string& damaged : {std::string(), std::string("junk"), whole.substr(0, whole.size() - 1), whole + "x"}) {
            write_atomically(file, damaged);
            { const Watched device; }
            REQUIRE(read_text(file) == whole);
        }
    }
    before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}
