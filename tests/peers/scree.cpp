// scree in the race: a World whose bodies never sleep.
#include "compute/device/device_runner.h"
#include "compute/world.h"
#include "host/vulkan/device.h"
#include "tests/peers/engine.h"

namespace scree::peers {

namespace {

Settings awake() {
    Settings settings;
    settings.rate = 1 / step_seconds;
    settings.sleeping = false;
    return settings;
}

class Scree : public Engine {
public:
    Scree(const Scene& scene, std::unique_ptr<Runner> runner) : world_(scene, awake(), std::move(runner)) {}
    std::string name() const override {
        Runner& runner = world_.runner();
        return "scree " + runner.backend() + ", " + runner.device();
    }
    void step() override { world_.step(); }
    std::vector<vec3> positions() const override {
        std::vector<vec3> all;
        for (const BodyState& body : world_.bodies()) all.push_back(body.position);
        return all;
    }
    std::size_t points() const override { return world_.statistics().points; }

private:
    mutable World world_;
};

}  // namespace

std::unique_ptr<Engine> make_scree_on_processor(const Scene& scene, int threads) {
    return std::make_unique<Scree>(scene, make_reference_runner(threads));
}

std::unique_ptr<Engine> make_scree_on_device(const Scene& scene) {
    return std::make_unique<Scree>(scene, make_device_runner(host::Device::open()));
}

}  // namespace scree::peers
