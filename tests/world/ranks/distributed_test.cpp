// One world on several ranks: the same bits as on one.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "tests/world/feet.h"

using namespace scree;

namespace {

std::vector<std::uint64_t> hashes_of(World& world, int steps, int every, const demos::Script& act) {
    std::vector<std::uint64_t> hashes;
    for (int step = 1; step <= steps; ++step) {
        if (act) act(world);
        world.step();
        if (step % every == 0) hashes.push_back(world.state_hash());
    }
    return hashes;
}

void agrees(const std::string& name, const Scene& scene, const demos::Script& act, int steps, std::initializer_list<int> ranks) {
    constexpr int every = 10;
    World alone(scene, {}, make_reference_runner(1));
    const std::vector<std::uint64_t> expected = hashes_of(alone, steps, every, act);
    for (const int n : ranks) {
        std::vector<std::vector<std::uint64_t>> seen(static_cast<std::size_t>(n));
        std::vector<Statistics> statistics(seen.size());
        run_in_process(n, [&](const std::shared_ptr<Exchange>& exchange) {
            World world(scene, {}, make_distributed_runner(exchange));
            const auto rank = static_cast<std::size_t>(exchange->rank());
            seen[rank] = hashes_of(world, steps, every, act);
            statistics[rank] = world.statistics();
        });
        INFO(name << " on " << n << " ranks");
        for (const auto& hashes : seen) {
            const auto differs = std::mismatch(hashes.begin(), hashes.end(), expected.begin(), expected.end()).first;
            INFO("first differs by step " << (differs - hashes.begin() + 1) * every);
            REQUIRE(hashes == expected);
        }
        REQUIRE(statistics[0].points == alone.statistics().points);
        REQUIRE(statistics[0].penetration_max == alone.statistics().penetration_max);
    }
}
void agrees(const std::string& demo, std::size_t bodies, int steps, std::initializer_list<int> ranks) {
    const demos::Demo* found = demos::find_demo(demo);
    REQUIRE(found);
    const demos::DemoScene built = demos::build(*found, {.bodies = bodies});
    agrees(demo + " of " + std::to_string(bodies) + " bodies", built.scene, built.before_step, steps, ranks);
}

// An exchange that notes how often a rank has worked between the start and the finish of a message.
class WatchedExchange : public Exchange {
public:
    explicit WatchedExchange(std::shared_ptr<Exchange> inner) : inner_(std::move(inner)) {}
    [[noreturn]] void end_all(int status) override {
        inner_->end_all(status);
        std::abort();
    }
    int rank() const override { return inner_->rank(); }
    int ranks() const override { return inner_->ranks(); }
    std::vector<Bytes> all_to_all(const std::vector<Bytes>& to) override { return inner_->all_to_all(to); }
    void start(const std::vector<Bytes>& to, std::vector<Bytes>& from) override {
        travels_ = true;
        inner_->start(to, from);
    }
    void progress() override { worked += travels_; }
    void finish() override {
        travels_ = false;
        inner_->finish();
    }
    void unite(std::span<std::uint32_t> bits) override { inner_->unite(bits); }
    void add(std::span<std::uint32_t> numbers) override { inner_->add(numbers); }
    int worked = 0;

private:
    std::shared_ptr<Exchange> inner_;
    bool travels_ = false;
};

}  // namespace

TEST_CASE("a pile on several ranks moves as on one", "[ranks]") {
    agrees("pile", 300, 200, {1, 2, 3, 4, 8});
}

TEST_CASE("stacks, mixed shapes, compounds and meshes on several ranks move as on one", "[ranks]") {
    agrees("stack", 0, 60, {2});
    agrees("mix", 150, 150, {3});
    agrees("assortment", 100, 90, {2});
    agrees("mesh", 60, 60, {3});
    agrees("dominoes", 30, 90, {2});
    agrees("cradle", 0, 60, {2});
}

TEST_CASE("bodies in several contacts with another move on several ranks as on one", "[ranks]") {
    agrees("feet", 0, 60, {2, 3});
    agrees("what has feet", tests::what_has_feet(7), {}, 60, {2, 4});
}

TEST_CASE("joints, vehicles, what breaks, and what comes and goes on several ranks move as on one", "[ranks]") {
    agrees("ragdolls", 40, 60, {3});
    agrees("wrecking", 60, 90, {2});
    agrees("cars", 10, 40, {2});
    agrees("shatter", 40, 60, {3});
    agrees("fountain", 80, 90, {2});
}

// A block whose first body breaks is nobody's by that body: the others are still solved, and once.
TEST_CASE("chains whose first body breaks move on several ranks as on one", "[ranks]") {
    std::string bodies = R"({"shape": {"plane": {}}, "motion": "fixed"})", joints;
    for (int chain = 0; chain < 6; ++chain) {
        for (int k = 0; k < 3; ++k)
            bodies += fmt::format(R"(, {{"shape": {{"box": {{"half_extents": [0.25, 0.25, 0.25]}}}}, "density": 800,
                                       "position": [{}, {}, {}]{}}})",
                                  4 * chain - 10 + 0.6 * k, 2 + 0.1 * chain, 0.3 * chain,
                                  k > 0 ? "" : R"(, "fracture": {"impulse": 100, "cutting": "boxes", "pieces": 4})");
        for (int k = 0; k < 2; ++k)
            joints += fmt::format(
                R"({}{{"kind": {{"ball": {{}}}}, "a": {}, "b": {}, "anchor_a": [0.3, 0, 0], "anchor_b": [-0.3, 0, 0]}})",
                joints.empty() ? "" : ", ", 1 + 3 * chain + k, 2 + 3 * chain + k);
    }
    const Scene scene = scene_from_json(fmt::format(R"({{"bodies": [{}], "joints": [{}]}})", bodies, joints)).scene;
    World alone(scene, {}, make_reference_runner(1));
    alone.step(120);
    REQUIRE(alone.statistics().broken >= 3);
    agrees("six chains", scene, {}, 120, {2, 3});
}

// One rank pushes, all are told: edits between steps, and what is read of the world.
TEST_CASE("a world on ranks is edited, read, saved and restored like one", "[ranks]") {
    const demos::DemoScene built = demos::build(*demos::find_demo("pile"), {.bodies = 60});
    const bool watched = GENERATE(true, false);  // which brings all contacts to every rank
    const auto live = [&](World& world, std::vector<std::byte>& mark) {
        std::vector<std::uint64_t> hashes;
        const std::size_t body = built.scene.bodies.size() - 1;
        world.set_events({.contacts = watched});
        std::size_t told = 0;
        for (int step = 0; step < 80; ++step) {
            if (step == 20) world.apply_impulse(body, {50, 400, 30});
            if (step == 30) world.set_motion(body, Motion::kinematic);
            if (step == 40) world.set_motion(body, Motion::dynamic);
            if (step == 45) world.add_bodies(std::vector<Body>(3, built.scene.bodies[body]));
            if (step == 50) mark = world.save();
            if (step == 60) world.remove_bodies(std::vector{world.handle_of(body - 1), world.handle_of(1), world.handle_of(2)});
            world.step();
            told += world.take_events().size();
            hashes.push_back(world.state_hash());
        }
        world.restore(mark);
        hashes.push_back(world.statistics().points);  // before a step gives bodies their owners again
        hashes.push_back(world.save() == mark);
        world.step(10);
        hashes.push_back(world.state_hash());
        hashes.push_back(told);
        return hashes;
    };
    std::vector<std::byte> mark_alone;
    World alone(built.scene, {}, make_reference_runner(1));
    const auto expected = live(alone, mark_alone);
    std::vector<std::uint64_t> seen;
    std::vector<std::byte> mark;
    run_in_process(3, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(built.scene, {}, make_distributed_runner(exchange));
        std::vector<std::byte> mark_of_rank;
        const auto seen_of_rank = live(world, mark_of_rank);
        if (exchange->rank() != 0) return;
        seen = seen_of_rank;
        mark = mark_of_rank;
    });
    CHECK(seen == expected);
    World one(built.scene, {}, make_reference_runner(1));  // what three have saved, one goes on with
    one.restore(mark);
    one.step(10);
    CHECK(one.state_hash() == expected[82]);
}

TEST_CASE("a rank solves contacts and joints while the velocities of ghosts travel", "[ranks]") {
    for (const char* name : {"pile", "ragdolls"}) {
        const demos::DemoScene built = demos::build(*demos::find_demo(name), {.bodies = 200});
        std::array<int, 2> worked{};
        run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
            const auto watched = std::make_shared<WatchedExchange>(exchange);
            World world(built.scene, {}, make_distributed_runner(watched));
            world.step(20);
            worked[static_cast<std::size_t>(exchange->rank())] = watched->worked;
        });
        const int passes = 2 * Settings{}.substeps * 20;
        const int stages = built.scene.joints.empty() ? 1 : 2;
        INFO(name);
        CHECK(worked == std::array{stages * passes, stages * passes});
    }
}

// What a share is taken from comes back whole to who looks, with hulls, names and numbers of one's own.
TEST_CASE("a world that was shared out is found whole by who looks into it", "[ranks]") {
    demos::DemoScene built = demos::build(*demos::find_demo("bins"), {});
    const demos::DemoScene heap = demos::build(*demos::find_demo("mix"), {.bodies = 60});
    for (const Body& body : heap.scene.bodies) {
        built.scene.bodies.push_back(body);
        built.scene.bodies.back().position += vec3(40, 0, 0);
        built.scene.bodies.back().user_data = built.scene.bodies.size();
        if (built.scene.bodies.size() % 7 == 0)
            built.scene.bodies.back().name = fmt::format("the {}th", built.scene.bodies.size());
    }
    World alone(built.scene, {}, make_reference_runner(1));
    alone.step(60);
    const std::uint64_t scene_hash = hash_of(alone.scene()), there = hash_of(alone.snapshot());
    const Statistics expected = alone.statistics();
    const std::size_t contacts = alone.contacts().size();
    const std::vector<std::byte> saved = alone.save();
    alone.step(60);
    const std::uint64_t end = alone.state_hash();
    run_in_process(3, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(built.scene, {}, make_distributed_runner(exchange));
        const std::size_t at_first = world.buffer_bytes();
        world.step(60);
        const std::size_t bytes = world.buffer_bytes();
        const Statistics found = world.statistics();  // of shares
        const bool stayed = world.buffer_bytes() == bytes && world.bodies_there() == expected.bodies;
        const bool sums_agree = found.bodies == expected.bodies && found.asleep == expected.asleep &&
                                found.below_ground == expected.below_ground && found.max_speed == expected.max_speed &&
                                found.drift_max == expected.drift_max && found.points == expected.points &&
                                found.kinetic_energy == Approx(expected.kinetic_energy).epsilon(1e-12) &&
                                found.potential_energy == Approx(expected.potential_energy).epsilon(1e-12) &&
                                found.angular_momentum[1] == Approx(expected.angular_momentum[1]).epsilon(1e-9);
        const bool scene_agrees = hash_of(world.scene()) == scene_hash && hash_of(world.snapshot()) == there;
        const bool contacts_agree = world.contacts().size() == contacts && world.statistics().points == expected.points;
        world.step(60);  // whole for some steps, then shares again
        const bool ends_alike = world.state_hash() == end;
        World other(built.scene, {}, make_distributed_runner(exchange));
        other.step(7);
        other.restore(saved);
        other.step(60);
        const bool is_restored = other.state_hash() == end;
        if (exchange->rank() != 1) return;
        CHECK(at_first > 0);
        CHECK(stayed);
        CHECK(sums_agree);
        CHECK(scene_agrees);
        CHECK(contacts_agree);
        CHECK(ends_alike);
        CHECK(is_restored);
    });
}

TEST_CASE("a rank's tables are its share of the world and the bodies near it", "[ranks]") {
    const demos::DemoScene built = demos::build(*demos::find_demo("pile"), {.bodies = 4000});
    World alone(built.scene, {}, make_reference_runner(1));
    alone.step(100);
    std::vector<std::size_t> bytes(4);
    run_in_process(4, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(built.scene, {}, make_distributed_runner(exchange));
        world.step(100);
        bytes[static_cast<std::size_t>(exchange->rank())] = world.buffer_bytes();
    });
    for (const std::size_t one : bytes) CHECK(static_cast<double>(one) < 0.36 * static_cast<double>(alone.buffer_bytes()));
}

TEST_CASE("a rank has memory for its own contacts, also after the world is read", "[ranks]") {
    const demos::DemoScene built = demos::build(*demos::find_demo("pile"), {.bodies = 1000});
    World alone(built.scene, {}, make_reference_runner(1));
    alone.step(120);
    struct Seen {
        std::size_t at_first = 0, stepped = 0, after_statistics = 0, after_contacts = 0, later = 0, never_read = 0;  // bytes
        std::size_t contacts = 0;
        Statistics statistics;
    };
    std::vector<Seen> of_ranks(4);
    run_in_process(4, [&](const std::shared_ptr<Exchange>& exchange) {
        Seen& seen = of_ranks[static_cast<std::size_t>(exchange->rank())];
        World world(built.scene, {}, make_distributed_runner(exchange));
        seen.at_first = world.buffer_bytes();
        world.step(120);
        seen.stepped = world.buffer_bytes();
        seen.statistics = world.statistics();
        seen.after_statistics = world.buffer_bytes();
        seen.contacts = world.contacts().size();
        seen.after_contacts = world.buffer_bytes();
        world.step(20);  // after a while without a look
        seen.later = world.buffer_bytes();
        World unread(built.scene, {}, make_distributed_runner(exchange));
        unread.step(140);
        seen.never_read = unread.buffer_bytes();
    });
    const double whole = static_cast<double>(alone.buffer_bytes());
    const Statistics expected = alone.statistics();
    for (const Seen& seen : of_ranks) {
        CHECK(static_cast<double>(seen.at_first) < 0.6 * whole);
        CHECK(static_cast<double>(seen.stepped) < 0.6 * whole);
        CHECK(static_cast<double>(seen.later) < 0.6 * whole);
        CHECK(seen.statistics.manifolds == expected.manifolds);
        CHECK(seen.statistics.points == expected.points);
        CHECK(seen.statistics.penetration_mean == Approx(expected.penetration_mean).epsilon(1e-12));
        CHECK(seen.after_statistics == seen.stepped);
        CHECK(seen.contacts == expected.manifolds);  // of all ranks
        CHECK(seen.after_contacts > seen.stepped);
        CHECK(static_cast<double>(seen.later) < 1.1 * static_cast<double>(seen.never_read));
    }
}

TEST_CASE("a world that is shared out is saved in pieces, of which no rank holds the whole", "[ranks]") {
    demos::DemoScene built = demos::build(*demos::find_demo("mix"), {.bodies = 300});
    for (const auto& [name, bodies] : {std::pair("bins", 0), std::pair("mesh", 20)}) {  // hulls; triangles, which are parts
        const demos::DemoScene more = demos::build(*demos::find_demo(name), {.bodies = static_cast<std::size_t>(bodies)});
        for (Body body : more.scene.bodies) {
            if (std::holds_alternative<Plane>(body.shape)) continue;
            if (body.motion == Motion::dynamic && std::holds_alternative<Compound>(body.shape))
                continue;  // would not be shared out
            body.position += vec3(name[0] == 'b' ? 60 : -60, 0, 0);
            built.scene.bodies.push_back(body);
        }
    }
    World alone(built.scene, {}, make_reference_runner(1));
    alone.step(70);
    alone.apply_impulse(7, vec3(10, 3, 0));
    alone.step(20);
    const std::vector<std::byte> expected = alone.save();
    const Statistics statistics = alone.statistics();
    alone.step(50);
    const std::uint64_t end = alone.state_hash();
    for (const int n : {2, 3, 5}) {
        std::vector<std::byte> all;
        std::size_t most = 0;
        run_in_process(n, [&](const std::shared_ptr<Exchange>& exchange) {
            World world(built.scene, {}, make_distributed_runner(exchange));
            world.step(70);
            world.apply_impulse(7, vec3(10, 3, 0));
            world.step(20);
            const std::size_t share = world.buffer_bytes();
            world.save_in_pieces([&](std::uint64_t at, std::span<const std::byte> bytes) {
                most = std::max(most, bytes.size());
                all.resize(std::max<std::size_t>(all.size(), at + bytes.size()));
                std::copy(bytes.begin(), bytes.end(), all.begin() + static_cast<std::ptrdiff_t>(at));
            });
            const bool is_share = world.buffer_bytes() == share && 10 * share < 9 * alone.buffer_bytes();
            world.step(50);
            const bool goes_on = world.state_hash() == end;
            World other(built.scene, {}, make_distributed_runner(exchange));
            other.step(3);
            exchange->all_gather({});  // the bytes are there
            other.restore(all);
            const bool is_restored = other.statistics().penetration_max == statistics.penetration_max;
            other.step(50);
            const bool ends_alike = other.state_hash() == end;
            if (exchange->rank() != 1) return;
            CHECK(is_share);
            CHECK(goes_on);
            CHECK(is_restored);
            CHECK(ends_alike);
        });
        INFO(n << " ranks");
        const bool is_file_of_one = all == expected;
        CHECK(is_file_of_one);
        CHECK(most < all.size());
        World later(built.scene, {}, make_reference_runner(1));
        later.restore(all);
        CHECK(later.statistics().penetration_max == statistics.penetration_max);
        CHECK(later.statistics().points == statistics.points);
        later.step(50);
        CHECK(later.state_hash() == end);
    }
}
