// Scenes whose bodies come one after the other: ranks begin with their shares, to the bits of a world that has all of them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/scene_stream.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random_bodies.h"

using namespace scree;

namespace {

// What a world of the whole scene has after its steps, and a streamed one on ranks.
struct Outcome {
    std::vector<std::uint64_t> hashes;
    std::vector<std::byte> saved;
    std::size_t manifolds = 0;
};

Outcome outcome_of(World& world, int steps) {
    Outcome found;
    found.hashes.push_back(world.state_hash());
    for (int step = 1; step <= steps; ++step) {
        world.step();
        if (step % 10 == 0) found.hashes.push_back(world.state_hash());
    }
    found.manifolds = world.statistics().manifolds;
    found.saved = world.save();
    return found;
}

StreamedScene streamed(const std::string& demo, std::size_t bodies) {
    demos::DemoScene built = demos::build_streamed(*demos::find_demo(demo), {.bodies = bodies});
    return {std::move(built.scene), std::move(built.others)};
}

// Of a list, from its `first` bodies on.
StreamedScene streamed(Scene scene, std::size_t first) {
    auto others =
        std::make_shared<std::vector<Body>>(scene.bodies.begin() + static_cast<std::ptrdiff_t>(first), scene.bodies.end());
    scene.bodies.resize(first);
    return {std::move(scene), [others](const TakeBody& take) {
                for (const Body& body : *others) take(body);
            }};
}

void begins_alike(const StreamedScene& scene, int steps, std::initializer_list<int> ranks, bool shared = true) {
    World alone(scene.whole(), {}, make_reference_runner(1));
    const Outcome expected = outcome_of(alone, steps);
    for (const int n : ranks) {
        std::vector<Outcome> found(static_cast<std::size_t>(n));
        std::vector<std::uint8_t> is_shared(found.size());
        run_in_process(n, [&](const std::shared_ptr<Exchange>& exchange) {
            World world(scene, {}, make_distributed_runner(exchange));
            const auto rank = static_cast<std::size_t>(exchange->rank());
            is_shared[rank] = world.share().has_value();
            found[rank] = outcome_of(world, steps);
        });
        INFO(n << " ranks");
        for (std::size_t rank = 0; rank < found.size(); ++rank) {
            REQUIRE(is_shared[rank] == shared);
            REQUIRE(found[rank].hashes == expected.hashes);
            REQUIRE(found[rank].manifolds == expected.manifolds);
            alone.restore(found[rank].saved);  // takes none of another scene
            REQUIRE(alone.state_hash() == expected.hashes.back());
        }
    }
}

// Fixed, kinematic and dynamic bodies in turn, with hulls, a fixed compound and a mesh among them.
Scene medley() {
    Scene scene = demos::build(*demos::find_demo("pile"), {.bodies = 60}).scene;
    demos::Random random(3);
    const auto add = [&](Body body, vec3 place) {
        body.position = place;
        scene.bodies.push_back(std::move(body));
    };
    for (int i = 0; i < 12; ++i) {
        const float x = 0.5f * static_cast<float>(i) - 3;
        add(demos::random_stone(0.3f, random), {x, 6, 0.2f});
        Body still;
        still.motion = i % 3 == 0 ? Motion::kinematic : Motion::fixed;
        still.shape = Box{{0.1f, 0.1f, 0.1f}};
        if (i % 4 == 1) still.shape = Compound{{{Box{{0.1f, 0.1f, 0.1f}}, {0.2f, 0, 0}}, {Sphere{0.1f}, {-0.2f, 0, 0}}}};
        if (i % 4 == 2) {
            still.motion = Motion::fixed;
            still.shape = Mesh{.vertices = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
        }
        if (i % 4 == 1) still.motion = Motion::fixed;
        if (still.motion == Motion::kinematic) still.velocity = {0, 0.1f, 0};
        add(still, {x, 1.2f, -0.3f});
    }
    return scene;
}

}  // namespace

TEST_CASE("ranks that begin with shares of a streamed scene move it as one world does", "[ranks]") {
    begins_alike(streamed("pile", 300), 100, {2, 3, 4, 8});
}

TEST_CASE("a streamed scene may have fixed and kinematic bodies, compounds, meshes and hulls anywhere", "[ranks]") {
    const Scene scene = medley();
    begins_alike(streamed(scene, 0), 60, {2, 3});
    begins_alike(streamed(scene, 70), 60, {2});
    begins_alike(streamed(scene, scene.bodies.size()), 60, {2});
}

TEST_CASE("a streamed scene may have dynamic bodies alone, and fewer than ranks", "[ranks]") {
    Scene scene;
    for (int i = 0; i < 6; ++i) {
        Body box;
        box.shape = Box{vec3(0.3f)};
        box.position = {0.5f * static_cast<float>(i % 3), 0.55f * static_cast<float>(i), 0};
        scene.bodies.push_back(box);
    }
    begins_alike(streamed(scene, 0), 30, {2, 3, 8});
    begins_alike(streamed(scene, 3), 30, {2});
    scene.bodies.resize(1);
    begins_alike(streamed(scene, 0), 10, {3});
}

TEST_CASE("more ranks than bodies begin with shares, too", "[ranks]") {
    begins_alike(streamed("mix", 3), 20, {5});
    begins_alike(streamed(Scene{}, 0), 2, {2}, false);  // nothing to share
}

TEST_CASE("what ranks cannot share out they hold whole from a streamed scene as well", "[ranks]") {
    begins_alike(streamed("assortment", 60), 30, {2}, false);  // moving compounds
    const demos::DemoScene chain = demos::build(*demos::find_demo("chain"), {});
    begins_alike(streamed(chain.scene, 1), 20, {2}, false);
}

TEST_CASE("a streamed scene of many bodies is shared out in their order in space", "[ranks]") {
    begins_alike(streamed("pile", 6000), 20, {3});
}

TEST_CASE("bodies of a streamed scene are there for whoever looks, and can be edited", "[ranks]") {
    const StreamedScene scene = streamed("mix", 200);
    const auto act = [](World& world) {
        world.step(3);
        const std::vector<Body> bodies = world.scene().bodies;
        std::vector<float> values;
        for (const Body& body : bodies) values.insert(values.end(), {body.position.x, body.density, body.friction});
        world.add_bodies(std::vector<Body>(3, demos::build(*demos::find_demo("pile"), {.bodies = 10}).scene.bodies.back()));
        world.step(20);  // shared out again
        world.remove_body(50);
        world.step(5);
        values.push_back(static_cast<float>(world.statistics().points));
        return std::pair(values, world.state_hash());
    };
    World alone(scene.whole(), {}, make_reference_runner(1));
    const auto expected = act(alone);
    run_in_process(3, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, {}, make_distributed_runner(exchange));
        const auto found = act(world);
        if (found != expected) throw std::runtime_error("rank " + std::to_string(exchange->rank()) + " differs");
    });
}

TEST_CASE("bodies of a streamed scene that go or change their motion do so on every rank", "[ranks]") {
    const StreamedScene scene = streamed("mix", 200);
    using Act = void (*)(World&);
    for (const Act act :
         {Act{[](World& world) { world.remove_body(50); }}, Act{[](World& world) { world.set_motion(60, Motion::kinematic); }},
          Act{[](World& world) { world.set_motion(70, Motion::fixed); }}}) {
        for (const int before : {0, 1, 30}) {
            CAPTURE(before);
            World alone(scene.whole(), {}, make_reference_runner(1));
            alone.step(before);
            act(alone);
            alone.step(30);
            const std::uint64_t expected = alone.state_hash();
            run_in_process(3, [&](const std::shared_ptr<Exchange>& exchange) {
                World world(scene, {}, make_distributed_runner(exchange));
                world.step(before);
                act(world);
                world.step(30);
                if (world.state_hash() != expected) throw std::runtime_error("another hash");
            });
        }
    }
}

TEST_CASE("checkpoints of worlds that began with shares and whole are each other's", "[ranks]") {
    const StreamedScene scene = streamed("pile", 200);
    World alone(scene.whole(), {}, make_reference_runner(1));
    alone.step(30);
    const std::vector<std::byte> early = alone.save();
    alone.step(30);
    const std::uint64_t expected = alone.state_hash();
    std::vector<std::byte> late;
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, {}, make_distributed_runner(exchange));
        world.restore(early);
        world.step(15);
        const std::vector<std::byte> saved = world.save();
        if (exchange->rank() == 0) late = saved;
        world.step(15);
        if (world.state_hash() != expected) throw std::runtime_error("another hash");
    });
    World other(scene.whole(), {}, make_reference_runner(1));
    other.restore(late);
    other.step(15);
    REQUIRE(other.state_hash() == expected);
}

TEST_CASE("a body that a streamed scene may not have is refused by its index, on every rank", "[ranks]") {
    StreamedScene scene = streamed("pile", 40);
    scene.others = [others = scene.others](const TakeBody& take) {
        others(take);
        Body bad;
        bad.shape = Sphere{-1};
        take(bad);
    };
    std::vector<std::string> told(2);
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        try {
            World world(scene, {}, make_distributed_runner(exchange));
        } catch (const SceneError& error) {
            told[static_cast<std::size_t>(exchange->rank())] = error.pointer;
        }
    });
    const std::string place = "/bodies/" + std::to_string(streamed("pile", 40).whole().bodies.size()) + "/shape/sphere/radius";
    REQUIRE(told == std::vector<std::string>{place, place});
}

TEST_CASE("a streamed scene that gives other bodies when it is asked again is refused", "[ranks]") {
    for (const int change : {-1, 1}) {
        StreamedScene scene = streamed("pile", 40);
        scene.others = [others = scene.others, change](const TakeBody& take) {
            static thread_local int calls;
            int left = 40 + change * (calls++ % 3 == 1 ? 1 : 0);
            Body last;
            others([&](Body body) {
                last = body;
                if (left-- > 0) take(std::move(body));
            });
            while (left-- > 0) take(last);
        };
        std::vector<std::uint8_t> by(2);
        run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
            try {
                World world(scene, {}, make_distributed_runner(exchange));
            } catch (const std::logic_error&) {
                by[static_cast<std::size_t>(exchange->rank())] = 1;
            }
        });
        REQUIRE(by == std::vector<std::uint8_t>{1, 1});
    }
}
