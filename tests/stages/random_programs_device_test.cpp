// Random programs on a device and on the CPU: the same bits. SCREE_PROGRAMS=1000 runs so many, from SCREE_PROGRAMS_FROM on,
// without validation, which takes half of the time.
#include <cstdlib>
#include <memory>
#include <optional>

#include "compute/cpu/reference_runner.h"
#include "compute/device/device_runner.h"
#include "tests/stages/watched_device.h"
#include "tests/world/random_program.h"

using namespace scree;

TEST_CASE("random programs give the same bits on a device as on the CPU", "[vulkan][process:runs]") {
    const char *count = std::getenv("SCREE_PROGRAMS"), *from = std::getenv("SCREE_PROGRAMS_FROM");
    const std::optional<Watched> watched = count ? std::nullopt : std::make_optional<Watched>();
    const std::shared_ptr<host::Device> device = watched ? watched->device : host::Device::open({});
    const int first = from ? std::atoi(from) : 1;
    for (int seed = first; seed < first + (count ? std::atoi(count) : 2); ++seed) {
        INFO("program " << seed);
        tests::RandomProgram program = tests::random_program(static_cast<std::uint32_t>(seed));
        const std::string parts = tests::difference(
            program, [] { return std::make_unique<ReferenceRunner>(1); }, [&] { return make_device_runner(device); });
        if (!parts.empty()) FAIL_CHECK(parts);
    }
}
