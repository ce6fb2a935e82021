// Ranks that fail: they end the others, and ask them for nothing.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/distributed_runner.h"
#include "compute/distributed/in_process.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"

using namespace scree;

namespace {

// An exchange that fails at one of the things that its rank says.
class FailingExchange : public Exchange {
public:
    explicit FailingExchange(std::shared_ptr<Exchange> inner) : inner_(std::move(inner)) {}
    [[noreturn]] void end_all(int status) override {
        inner_->end_all(status);
        std::abort();
    }
    int rank() const override { return inner_->rank(); }
    int ranks() const override { return inner_->ranks(); }
    std::vector<Bytes> all_to_all(const std::vector<Bytes>& to) override { return count(), inner_->all_to_all(to); }
    void start(const std::vector<Bytes>& to, std::vector<Bytes>& from) override { count(), inner_->start(to, from); }
    void finish() override { count(), inner_->finish(); }
    void unite(std::span<std::uint32_t> bits) override { count(), inner_->unite(bits); }
    void add(std::span<std::uint32_t> numbers) override { count(), inner_->add(numbers); }
    int said = 0, fails_at = 0;
    bool is_to_be_silent = false;

private:
    void count() {
        if (is_to_be_silent) throw std::logic_error("it asks the others, which do something else");
        if (++said == fails_at) throw std::runtime_error("the machine is gone");
    }
    std::shared_ptr<Exchange> inner_;
};

// Is to be silent from a step that lacked room until the next one.
class SilentRunner : public DistributedRunner {
public:
    explicit SilentRunner(std::shared_ptr<FailingExchange> exchange)
        : DistributedRunner(exchange, 1), exchange_(std::move(exchange)) {}
    bool step() override {
        exchange_->is_to_be_silent = false;
        const bool had_room = DistributedRunner::step();
        exchange_->is_to_be_silent = !had_room;
        return had_room;
    }

private:
    std::shared_ptr<FailingExchange> exchange_;
};

}  // namespace

// A rank is lost at each thing that it says in a step, whatever the others wait for then.
TEST_CASE("a rank that fails anywhere in a step ends the others, and what was saved goes on elsewhere", "[ranks]") {
    const demos::DemoScene built = demos::build(*demos::find_demo("shatter"), {.bodies = 40});
    World alone(built.scene, {}, make_reference_runner(1));
    alone.step(36);
    const std::vector<std::byte> saved = alone.save();
    alone.step(4);
    int said = 0;  // in the step that bodies break in
    run_in_process(3, [&](const std::shared_ptr<Exchange>& exchange) {
        const auto failing = std::make_shared<FailingExchange>(exchange);
        World world(built.scene, {}, make_distributed_runner(failing));
        world.restore(saved);
        failing->said = 0;
        world.step(4);
        if (exchange->rank() == 1) said = failing->said;
    });
    REQUIRE(said > 100);
    for (int at = 1; at <= said; at += 3) {
        std::vector<int> ended(3);
        REQUIRE_THROWS_WITH(run_in_process(3,
                                           [&](const std::shared_ptr<Exchange>& exchange) {
                                               const auto rank = static_cast<std::size_t>(exchange->rank());
                                               const auto failing = std::make_shared<FailingExchange>(exchange);
                                               World world(built.scene, {}, make_distributed_runner(failing));
                                               world.restore(saved);
                                               failing->said = 0;
                                               if (rank == 1) failing->fails_at = at;
                                               try {
                                                   world.step(4);
                                               } catch (...) {
                                                   ended[rank] = 1;
                                                   throw;
                                               }
                                           }),
                            "the machine is gone");
        REQUIRE(ended == std::vector{1, 1, 1});
    }
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(built.scene, {}, make_distributed_runner(exchange));
        world.restore(saved);
        world.step(4);
        const std::uint64_t hash = world.state_hash();
        if (exchange->rank() == 0) REQUIRE(hash == alone.state_hash());
    });
}

TEST_CASE("a rank that fails ends the others", "[ranks]") {
    REQUIRE_THROWS_WITH(run_in_process(3,
                                       [](const std::shared_ptr<Exchange>& exchange) {
                                           if (exchange->rank() == 1) throw std::runtime_error("no more");
                                           std::uint32_t word[1] = {1};
                                           for (;;) exchange->unite(word);
                                       }),
                        "no more");
    REQUIRE_THROWS_AS(run_in_process(2,
                                     [](const std::shared_ptr<Exchange>& exchange) {
                                         World world(demos::build(*demos::find_demo("stack"), {}).scene, {},
                                                     make_distributed_runner(exchange), 2);
                                     }),
                      std::invalid_argument);
}

TEST_CASE("a rank that alone lacks memory says so, and asks the others for nothing", "[ranks]") {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 400; ++i) {  // in two places: 19,900 pairs each
        Body& body = scene.bodies.emplace_back();
        body.shape = Box{vec3(0.5f)};
        body.position = vec3(100.0f * static_cast<float>(i / 200) + 0.0001f * static_cast<float>(i), 0.5f, 0);
    }
    std::vector<int> lost(2);
    REQUIRE_THROWS_WITH(
        run_in_process(2,
                       [&](const std::shared_ptr<Exchange>& exchange) {
                           const auto rank = static_cast<std::size_t>(exchange->rank());
                           World world(scene, {}, std::make_unique<SilentRunner>(std::make_shared<FailingExchange>(exchange)));
                           if (rank == 1) world.set_memory_limit(1'000'000);
                           try {
                               world.step(2);
                           } catch (const RankLost&) {
                               lost[rank] = 1;
                               throw;
                           }
                       }),
        Catch::Contains("step 1 is beyond memory") && Catch::Contains("alone may touch 199 others"));
    CHECK(lost == std::vector{1, 0});
}
