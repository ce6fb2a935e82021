// scree in the race: a World whose bodies never sleep.
#include "compute/device/device_runner.h"
#include "compute/world.h"
#include "host/vulkan/device.h"
#include "tests/peers/engine.h"

namespace scree::peers {

namespace {

Settings awake(int substeps) {
    Settings settings;
    if (substeps > 0) settings.substeps = substeps;
    settings.rate = 1 / step_seconds;
    settings.sleeping = false;
    return settings;
}

class Scree : public Engine {
public:
    Scree(const Scene& scene, std::unique_ptr<Runner> runner, int substeps)
        : world_(scene, awake(substeps), std::move(runner)), substeps_(substeps) {}
    std::string name() const override {
        Runner& runner = world_.runner();
        return "scree " + runner.backend() + ", " + runner.device() +
               (substeps_ > 0 ? ", " + std::to_string(substeps_) + " substeps" : "");
    }
    void step() override { world_.step(); }
    std::vector<Pose> poses() const override {
        std::vector<Pose> all;
        for (const BodyState& body : world_.bodies()) all.push_back({body.position, body.orientation});
        return all;
    }
    std::size_t points() const override { return world_.statistics().points; }

private:
    mutable World world_;
    int substeps_;  // 0: the default
};

}  // namespace

std::unique_ptr<Engine> make_scree_on_processor(const Scene& scene, int threads, int substeps) {
    return std::make_unique<Scree>(scene, make_reference_runner(threads), substeps);
}

std::unique_ptr<Engine> make_scree_on_device(const Scene& scene, int substeps) {
    return std::make_unique<Scree>(scene, make_device_runner(host::Device::open()), substeps);
}

}  // namespace scree::peers
