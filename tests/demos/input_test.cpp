// Recording and replay of user input.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "demos/play/session.h"
#include "demos/program/exit_status.h"
#include "tests/refusal.h"

using namespace scree;
using namespace scree::demos;

namespace {

SceneOptions options_of(const std::string& name) {
    SceneOptions options;
    options.name = name;
    return options;
}
std::unique_ptr<Runner> on_cpu() {
    return make_reference_runner(1);
}

// A run of 90 steps with every user command.
void play(Session& session) {
    for (int step = 0; step < 90; ++step) {
        if (step == 0) session.perform(Turn{.sleeping = true});
        if (step == 4) session.perform(Grab{0, 5, vec3(0.1f, 0.2f, 0.3f), vec3(1.0f / 3, 2, 0)});
        if (step > 4 && step < 30) {
            session.perform(Drag{0, vec3(0, 2, 0)});  // of these two drags only the second counts
            session.perform(Drag{0, vec3(0.1f * static_cast<float>(step), 2.7182818f, 1e-9f)});
        }
        if (step == 30) session.perform(Release{0});
        if (step == 33) {
            Body ball;
            ball.shape = Sphere{0.3f};
            ball.position = vec3(4, 1, 0.1f);
            ball.velocity = vec3(-12.3456789f, 3, -0.0f);
            session.perform(Add{ball});
        }
        if (step == 36) {
            Joint rope;
            rope.name = "a rope";
            rope.kind = Distance{0.1f, 10.0f / 3, Spring{1e3f / 3, 1.1f, 0.7f}};
            rope.a = 3;
            rope.b = 6;
            rope.anchor_a = vec3(0.1f, 1.0f / 3, -0.0f);
            rope.break_force = 1e7f / 3;
            session.perform(Join{rope});
        }
        if (step == 38) session.perform(SetMaterial{.body = 4, .friction = 0.1f, .rolling_resistance = 1.0f / 3});
        if (step == 39) session.perform(SetMass{7, 1234.567f});
        if (step == 52) session.perform(SetMotion{2, Motion::fixed});
        if (step == 57) session.perform(SetMotion{2, Motion::dynamic});
        if (step == 65) session.perform(Remove{8});
        if (step == 70) session.perform(Unjoin{0});
        if (step > 40 && step < 45) session.perform(Push{5, vec3(3e4f, 1, -2)});
        if (step == 50) session.perform(Explode{vec3(0.3f, 0, 0), 4, 7});
        if (step == 60)
            session.perform(Turn{.gravity = vec3(1, -5, 0), .substeps = 5, .friction_factor = 0.3f, .least_restitution = 0.7f});
        session.step();
    }
}

std::uint64_t replayed(const Input& input, const SceneOptions& options) {
    const LoadedScene subject = load_subject(options);
    World world(subject.scene, subject.settings(options), on_cpu());
    const Script script = script_of(input, "played.json", subject.before_step);
    while (world.steps() < input.steps) {
        script(world);
        world.step();
    }
    script(world);
    return world.state_hash();
}

std::string wrong(const std::string& acts, const std::string& rest = "") {
    return tests::refusal_of(
        [&] { input_from_json(R"({"scree_input": 1, "scene": "stack", "steps": 9)" + rest + R"(, "acts": [)" + acts + "]}"); });
}

}  // namespace

TEST_CASE("what a user did, written as JSON and read again, leads to the same state") {
    for (const char* name : {"stack", "dominoes"}) {  // the second has a script
        Session session(options_of(name), on_cpu);
        play(session);
        const Input input = session.input();
        REQUIRE(input.steps == 90);
        const Input read = input_from_json(json_of(input));
        REQUIRE(json_of(read) == json_of(input));
        REQUIRE(read.acts.size() == input.acts.size());
        REQUIRE(replayed(read, session.options()) == session.world().state_hash());
        REQUIRE(read.end_hash == session.world().state_hash());

        Input less = read;
        less.acts.pop_back();
        REQUIRE(replayed(less, session.options()) != session.world().state_hash());
    }
}

TEST_CASE("of the places that a body is drawn to before one step only the last is recorded") {
    Session session(options_of("stack"), on_cpu);
    session.perform(Grab{0, 5, vec3(0), vec3(0, 5, 0)});
    for (int i = 0; i < 10; ++i) session.perform(Drag{0, vec3(0, static_cast<float>(i), 0)});
    session.step();
    session.perform(Drag{0, vec3(1)});
    const Input input = session.input();
    REQUIRE(input.acts.size() == 3);
    REQUIRE(std::get<Drag>(input.acts[1].act).target.y == 9);
    REQUIRE(input.acts[2].step == 1);
}

TEST_CASE("what was done after the last step is done again") {
    Session session(options_of("stack"), on_cpu);
    session.step();
    const std::uint64_t before = session.world().state_hash();
    session.perform(Add{});
    REQUIRE(session.world().state_hash() != before);
    REQUIRE(replayed(session.input(), session.options()) == session.world().state_hash());
}

TEST_CASE("what was done before a restart and in another scene is kept") {
    Session session(options_of("stack"), on_cpu);
    for (int i = 0; i < 5; ++i) session.step();
    session.reset();  // nothing was done
    REQUIRE(session.earlier().empty());
    session.perform(Add{});
    for (int i = 0; i < 5; ++i) session.step();
    const std::uint64_t first = session.world().state_hash();
    session.reset();
    session.perform(Explode{vec3(0), 50, 3});
    session.step();
    const std::uint64_t second = session.world().state_hash();
    session.open("dominoes");
    REQUIRE(session.earlier().size() == 2);
    REQUIRE(session.acts() == 0);
    REQUIRE(replayed(session.earlier()[0], options_of("stack")) == first);
    REQUIRE(replayed(session.earlier()[1], options_of("stack")) == second);
    session.perform(Add{});
    REQUIRE_THROWS(session.open("no such demo"));
    REQUIRE(session.earlier().size() == 2);
}

TEST_CASE("commands are taken back one after the other, a whole drag at once") {
    Session session(options_of("stack"), on_cpu);
    REQUIRE_FALSE(session.undo());
    for (int i = 0; i < 10; ++i) session.step();
    const std::uint64_t at_10 = session.world().state_hash();
    session.perform(Explode{vec3(0), 50, 3});
    for (int i = 0; i < 70; ++i) session.step();  // a state is kept meanwhile
    const std::uint64_t at_80 = session.world().state_hash();
    session.perform(Grab{0, 5, vec3(0), vec3(0, 5, 0)});
    for (int i = 0; i < 9; ++i) {
        session.perform(Drag{0, vec3(0, static_cast<float>(i), 0)});
        session.step();
    }
    session.perform(Release{0});
    session.step();
    REQUIRE(session.undo());
    REQUIRE(session.world().steps() == 80);
    REQUIRE(session.farthest_step() == 80);
    REQUIRE(session.world().state_hash() == at_80);
    REQUIRE(session.acts() == 1);
    session.perform(Add{});  // before a step
    REQUIRE(session.undo());
    REQUIRE(session.world().state_hash() == at_80);
    REQUIRE(session.undo());
    REQUIRE(session.world().state_hash() == at_10);
    REQUIRE(session.input().acts.empty());
    REQUIRE_FALSE(session.undo());
    session.step();
    REQUIRE(replayed(session.input(), session.options()) == session.world().state_hash());
}

TEST_CASE("a session goes back to any moment with the same bits, and on from there") {
    for (const char* name : {"stack", "dominoes"}) {
        Session session(options_of(name), on_cpu);
        std::vector<std::uint64_t> hashes;
        play(session);
        const std::uint64_t end = session.world().state_hash(), last = session.world().steps();
        const Input whole = session.input();
        session.go_to(40);
        REQUIRE(session.world().steps() == 40);
        REQUIRE(session.farthest_step() == last);
        const std::uint64_t middle = session.world().state_hash();
        REQUIRE(replayed(session.input(), session.options()) == middle);
        session.go_to(last);  // the recorded commands are repeated
        REQUIRE(session.world().state_hash() == end);
        REQUIRE(json_of(session.input()) == json_of(whole));
        session.go_to(40);
        REQUIRE(session.world().state_hash() == middle);
        session.perform(Explode{vec3(0), 50, 3});  // a branch: what came later is gone
        REQUIRE(session.farthest_step() == 40);
        for (int i = 0; i < 20; ++i) session.step();
        REQUIRE(session.world().state_hash() != end);
        REQUIRE(replayed(session.input(), session.options()) == session.world().state_hash());
    }
}

TEST_CASE("going back begins with a state that was kept, also of a moment when a body was held") {
    int worlds = 0;
    Session session(options_of("stack"), [&] {
        ++worlds;
        return make_reference_runner(1);
    });
    session.perform(Grab{0, 10, vec3(0), vec3(0, 9, 1)});
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < 200; ++step) {
        session.perform(Drag{0, vec3(0, 9 + 0.01f * static_cast<float>(step), 1)});
        if (step == 150) session.perform(Add{});
        hashes.push_back(session.world().state_hash());
        session.step();
    }
    REQUIRE(session.kept_states() >= 1);  // fewer than three where the machine is busy
    REQUIRE(session.kept_bytes() > 0);
    for (const std::uint64_t step : {199u, 120u, 165u, 61u}) {
        session.go_to(step);
        REQUIRE(session.world().steps() == step);
        REQUIRE(session.world().state_hash() == hashes[step]);
    }
    REQUIRE(worlds == 1);
    session.perform(Turn{.sleeping = false});  // a branch, which lets go and keeps states of its own
    for (int step = 0; step < 100; ++step) session.step();
    const std::uint64_t end = session.world().state_hash();
    session.go_to(130);
    session.go_to(161);
    REQUIRE(session.world().state_hash() == end);
    REQUIRE(replayed(session.input(), session.options()) == end);
    session.go_to(3);  // before all that are kept
    REQUIRE(session.world().state_hash() == hashes[3]);
    REQUIRE(worlds == 2);
}

TEST_CASE("a session returns to a moment that was taken, with the same bits and its recording") {
    Session session(options_of("stack"), on_cpu);
    for (int i = 0; i < 10; ++i) session.step();
    session.perform(Explode{vec3(0.5f, 0.5f, 0.5f), 3, 4});
    session.perform(Grab{0, 5, vec3(0), session.world().body(5).position + vec3(0, 1, 0)});
    for (int i = 0; i < 10; ++i) session.step();
    const Session::Moment moment = session.moment();
    const std::uint64_t hash = session.world().state_hash();
    session.perform(Add{Body{.shape = Sphere{0.3f}, .position = vec3(0, 20, 0)}});
    for (int i = 0; i < 20; ++i) session.step();
    REQUIRE(session.world().state_hash() != hash);
    session.go_to(5);  // what was done after it is a future that is left
    session.perform(Explode{vec3(0), 1, 1});
    session.return_to(moment);
    CHECK(session.world().steps() == 20);
    CHECK(session.world().bodies_there() == session.subject().scene.bodies.size());
    // What was held is let go, and the recording says so.
    for (int i = 0; i < 20; ++i) session.step();
    const Input input = session.input();
    Session again(options_of("stack"), on_cpu);
    require_start(input, again.world());
    for (perform_due(input, again.world()); again.world().steps() < input.steps; perform_due(input, again.world()))
        again.world().step();
    CHECK(again.world().state_hash() == session.world().state_hash());
    session.open("wall");
    CHECK_THROWS_AS(session.return_to(moment), std::logic_error);
    CHECK(session.world().steps() == 0);
}

TEST_CASE("an act that the world refuses is not recorded") {
    Session session(options_of("stack"), on_cpu);
    REQUIRE_THROWS_AS(session.perform(Drag{0, vec3(0)}), std::out_of_range);
    REQUIRE_THROWS_AS(session.perform(Push{999, vec3(0)}), std::out_of_range);
    REQUIRE_THROWS_AS(session.perform(SetMaterial{.body = 999, .friction = 1.0f}), std::out_of_range);
    REQUIRE_THROWS_AS(session.perform(SetMaterial{.body = 5, .friction = -1.0f}), SceneError);
    REQUIRE_THROWS_AS(session.perform(SetMass{5, 0}), SceneError);
    REQUIRE_THROWS_AS(session.perform(SetMass{0, 10}), SceneError);  // the ground is a plane
    REQUIRE_THROWS_AS(session.perform(SetMotion{0, Motion::dynamic}), SceneError);
    REQUIRE_THROWS_AS(session.perform(Remove{999}), std::out_of_range);
    REQUIRE_THROWS_AS(session.perform(Grab{1, 5, vec3(0), vec3(0)}), std::invalid_argument);  // slot 0 is free
    REQUIRE_THROWS_AS(session.perform(Turn{.substeps = 65}), std::invalid_argument);
    REQUIRE(session.input().acts.empty());
    session.perform(Grab{0, 5, vec3(0), vec3(0)});  // the other slot was released
}

TEST_CASE("to begin again is a new recording of the same scene, to open another one a recording of that") {
    Session session(options_of("stack"), on_cpu);
    const std::uint64_t start = session.world().state_hash();
    session.perform(Explode{vec3(0), 10, 5});
    session.step();
    session.reset();
    REQUIRE(session.world().state_hash() == start);
    REQUIRE(session.input().acts.empty());
    REQUIRE(session.beginnings() == 2);
    session.open("wall");
    REQUIRE(session.input().scene == "wall");
    REQUIRE_THROWS_WITH(session.open("wal"), Catch::Contains("wall"));
    REQUIRE(session.subject().name == "wall");
}

TEST_CASE("a recording of another scene is refused") {
    Session session(options_of("stack"), on_cpu);
    session.step();
    Input input = session.input();
    REQUIRE_THROWS_WITH(replayed(input, options_of("wall")), Catch::Contains("/start_hash"));
    input.start_hash.reset();
    input.acts.push_back({0, Push{500, vec3(1)}});
    REQUIRE_THROWS_WITH(replayed(input, options_of("stack")), Catch::Contains("played.json: /acts/0: body 500"));
    input.acts.back().act = Unjoin{3};
    REQUIRE_THROWS_WITH(replayed(input, options_of("stack")), Catch::Contains("played.json: /acts/0: joint 3 of 0"));
    Joint joint;
    joint.a = 500;
    input.acts.back().act = Join{joint};
    REQUIRE_THROWS_WITH(replayed(input, options_of("stack")), Catch::Contains("there is no body 500"));
}

TEST_CASE("a mistake in a recording is told with its place") {
    using Catch::Contains;
    CHECK_THAT(wrong("", ", \"seeds\": 3"), Contains("/seeds: unknown key \"seeds\"; nearest: \"seed\""));
    CHECK_THAT(wrong("", ", \"rate\": 5"), Contains("/rate: must be between 10 and 1000"));
    CHECK_THAT(wrong("", ", \"substeps\": 0"), Contains("/substeps"));
    CHECK_THAT(wrong("", ", \"start_hash\": \"12\""), Contains("/start_hash: must be 16 hexadecimal digits"));
    CHECK_THAT(wrong("3"), Contains("/acts/0: must be an object"));
    CHECK_THAT(wrong(R"({"step": 1})"), Contains("/acts/0: must have \"step\" and one act"));
    CHECK_THAT(wrong(R"({"step": -1, "release": {"grip": 0}})"), Contains("/acts/0/step: must be a whole number"));
    CHECK_THAT(wrong(R"({"step": 10, "release": {"grip": 0}})"), Contains("/acts/0/step: lies beyond /steps"));
    CHECK_THAT(wrong(R"({"step": 5, "release": {"grip": 0}}, {"step": 4, "release": {"grip": 0}})"), Contains("/acts/1/step"));
    CHECK_THAT(wrong(R"({"step": 1, "relese": {"grip": 0}})"),
               Contains("/acts/0/relese: unknown act \"relese\"; nearest: \"release\""));
    CHECK_THAT(wrong(R"({"step": 1, "release": {"grip": 0.5}})"), Contains("/acts/0/release/grip: must be a whole number"));
    CHECK_THAT(wrong(R"({"step": 1, "drag": {"grip": 0}})"), Contains("/acts/0/drag: lacks \"target\""));
    CHECK_THAT(wrong(R"({"step": 1, "drag": {"grip": 0, "target": [1, 2]}})"),
               Contains("/acts/0/drag/target: must be an array of 3"));
    CHECK_THAT(wrong(R"({"step": 1, "add": {"shape": {"torus": {}}}})"), Contains("/acts/0/add/shape: unknown shape"));
    CHECK_THAT(wrong(R"({"step": 1, "add": {"shape": {"sphere": {"radius": 0}}}})"),
               Contains("/acts/0/add/shape/sphere/radius: must be"));
    CHECK_THAT(wrong(R"({"step": 1, "join": {"kind": {"ball": {}}, "a": 1, "anchor": [0, 0, 0]}})"),
               Contains("/acts/0/join/anchor: its bodies move: say \"anchor_a\""));
    CHECK_THAT(wrong(R"({"step": 1, "join": {"kind": {"rope": {}}, "a": 1}})"), Contains("/acts/0/join/kind: unknown kind"));
    CHECK_THAT(wrong(R"({"step": 1, "unjoin": {"joint": -1}})"), Contains("/acts/0/unjoin/joint: must be a whole number"));
    CHECK_THAT(wrong(R"({"step": 1, "turn": {}})"), Contains("/acts/0/turn: changes no setting"));
    CHECK_THAT(wrong(R"({"step": 1, "turn": {"substeps": 65}})"), Contains("/acts/0/turn/substeps"));
    CHECK_THAT(wrong(R"({"step": 1, "push": {"body": 1, "force": [1, 1e99, 0]}})"), Contains("/acts/0/push/force/1"));
    CHECK_THAT(wrong("{,}"), Contains("line 1, column"));
    CHECK(wrong(R"({"step": 1, "release": {"grip": 0}})").empty());
    REQUIRE_THROWS_WITH(input_from_json("{}"), Contains("lacks \"scree_input\""));
    REQUIRE_THROWS_WITH(input_from_json(R"({"scree_input": 2, "scene": "stack", "steps": 1, "acts": []})"),
                        Contains("/scree_input"));
}
