// Grains that come in during a run, and grains of scene files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compute/scene_file/load_scene.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/scene_schema.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/world/rain.h"

using namespace scree;

namespace {

void run(const SceneDocument& document, World& world, int steps) {
    for (int i = 0; i < steps; ++i) {
        perform_due(document.events, world);
        world.step();
    }
}

struct There {
    std::size_t count = 0;
    double mass = 0;  // kg
};
There poured_into(const World& world, const std::string& name) {
    There there;
    for (const Body& body : world.scene().bodies) {
        if (!body.name.starts_with(name + " ")) continue;
        ++there.count;
        there.mass += static_cast<double>(mass_properties(body).mass);
    }
    return there;
}

std::string refusal(const std::string& grains, const std::string& more = "") {
    return tests::refusal_of([&] {
        scene_from_json(R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}}], "grains": [)" + grains + "]" + more + "}");
    });
}

}  // namespace

TEST_CASE("poured grains come at their rate, in their mass or number, with their velocity", "[grains]") {
    const SceneDocument by_mass = scene_from_json(tests::rain(R"("mass": 60, "mass_rate": 40, "start": 0.5)"));
    World world(by_mass.scene);
    REQUIRE(by_mass.events.size() == 1);
    run(by_mass, world, 30);
    CHECK(poured_into(world, "rain").count == 0);
    const double heaviest = 2650 * 0.5236 * 0.09 * 0.09 * 0.09;  // kg
    for (int tenth = 1; tenth <= 10; ++tenth) {
        perform_due(by_mass.events, world);
        const There there = poured_into(world, "rain");
        CHECK(there.mass <= 4 * tenth + 1e-3);
        CHECK(there.mass >= 4 * tenth - heaviest);
        CHECK(world.body(world.scene().bodies.size() - 1).velocity == vec3(0, -2, 0));
        run(by_mass, world, 6);
    }
    run(by_mass, world, 60);
    CHECK(poured_into(world, "rain").mass == Approx(60).margin(heaviest));
    const std::size_t all = world.scene().bodies.size();
    run(by_mass, world, 30);
    CHECK(world.scene().bodies.size() == all);

    const SceneDocument by_count = scene_from_json(tests::rain(R"("count": 35, "count_rate": 50)"));
    World other(by_count.scene);
    for (const std::size_t expected : {5u, 10u, 15u, 20u, 25u, 30u, 35u, 35u}) {
        perform_due(by_count.events, other);
        CHECK(poured_into(other, "rain").count == expected);
        run(by_count, other, 6);
    }
}

TEST_CASE("poured grains overlap with nothing, and wait where there is no room, in their order", "[grains]") {
    // Into a cup that is full after a while.
    const SceneDocument document = scene_from_json(tests::rain(R"("count": 400, "count_rate": 300)", 0.2f));
    World world(document.scene);
    std::size_t before = 0, waited = 0;
    for (int burst = 0; burst < 20; ++burst) {
        perform_due(document.events, world);
        const std::size_t now = world.scene().bodies.size();
        waited += now - before < 30;
        for (std::size_t i = before; i < now; ++i) {
            if (world.scene().bodies[i].motion != Motion::dynamic) continue;
            const Body& body = world.scene().bodies[i];
            const BodyState state = world.body(i);
            const ShapeOverlap itself{
                .shape = body.shape, .position = state.position, .orientation = state.orientation, .ignored = i};
            CHECK(world.overlaps({&itself, 1}).items.empty());
            CHECK(body.name == "rain " + std::to_string(i - document.scene.bodies.size()));
        }
        before = now;
        world.step(6);
    }
    CHECK(waited > 5);
    CHECK(before > 60);
}

TEST_CASE("a run that was saved while grains come goes on with the same bits, on another world and after going back",
          "[grains]") {
    const SceneDocument document = scene_from_json(tests::rain(R"("count": 120, "count_rate": 100)"));
    World world(document.scene);
    run(document, world, 33);
    const std::vector<std::byte> saved = world.save();
    world.keep_state();
    run(document, world, 57);
    const std::uint64_t end = world.state_hash();
    REQUIRE(poured_into(world, "rain").count == 120);
    World other(document.scene);
    run(document, other, 50);  // further than the state that it is brought back to
    other.restore(saved);
    CHECK(poured_into(other, "rain").count == 60);
    run(document, other, 57);
    CHECK(other.state_hash() == end);
    world.roll_back(57);
    run(document, world, 57);
    CHECK(world.state_hash() == end);
}

TEST_CASE("a snapshot of a run goes on pouring what is still to come", "[grains]") {
    SceneDocument document = scene_from_json(tests::rain(R"("count": 60, "count_rate": 100, "start": 0.2)"));
    World world(document.scene);
    run(document, world, 30);
    const std::size_t there = poured_into(world, "rain").count;
    CHECK((there > 10 && there < 60));
    SceneDocument later = document;
    later.scene = world.snapshot();
    later.events = coming_events(document.events, world);
    const SceneDocument read = scene_from_json(scene_to_json(later));
    REQUIRE(read.events.size() == 1);
    World next(read.scene);
    run(read, next, 60);
    CHECK(poured_into(next, "rain").count == 60);
    run(document, world, 60);
    CHECK(coming_events(document.events, world).empty());
}

TEST_CASE("scene file: grains become bodies and events, which are written and read again", "[grains]") {
    const std::string text = R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}}],
        "grains": [{"name": "stone", "sieve": [{"size": 0.02, "passing": 0}, {"size": 0.04, "passing": 100}], "count": 200,
                    "shapes": [{"form": {"polyhedron": {"elongation": 0.6}}, "share": 3}, {"form": {"ellipsoid": {}}}],
                    "friction": 0.3, "rolling": 0.1, "color": "#ff0000", "region": {"cylinder": {"radius": 0.2, "height": 1}}},
                   {"size": 0.05, "count": 10, "count_rate": 20, "start": 2,
                    "region": {"box": {"lower": [0, 2, 0], "upper": [1, 3, 1]}}}]})";
    const SceneDocument document = scene_from_json(text);
    REQUIRE(document.scene.bodies.size() == 201);
    CHECK(document.grains.empty());
    const Body& last = document.scene.bodies.back();
    CHECK(last.name == "stone 199");
    CHECK(last.friction == 0.3f);
    CHECK((last.rolling_resistance > 0.0009f && last.rolling_resistance < 0.0021f));
    CHECK(last.color == vec3(1, 0, 0));
    REQUIRE(document.events.size() == 1);
    CHECK(document.events[0].time == 2);
    const std::string written = scene_to_json(document);
    CHECK(scene_to_json(scene_from_json(written)) == written);
    CHECK(hash_of(checked(scene_from_json(written).scene)) == hash_of(checked(document.scene)));
    const auto schema = nlohmann::json::parse(scene_schema());
    CHECK(schema["properties"].contains("grains"));
    CHECK(schema["$defs"]["file_grains"]["properties"].contains("sieve"));
    CHECK(schema["$defs"]["grain_form"]["properties"].size() == 4);
}

TEST_CASE("scene file: grains of a mesh file have its hull, and few grains are told", "[grains]") {
    const tests::TemporaryFolder folder;
    folder.write("wedge.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const auto scene = [&](const std::string& file, const std::string& more = "") {
        return folder.write("scene.json",
                            R"({"bodies": [], "grains": [{"size": 0.05, "count": 7, "shapes": [{"form": {"mesh": {"file": ")" +
                                file + R"("}}}], "region": {"box": {"lower": [0, 0, 0], "upper": [1, 1, 1]}}})" + more + "]}");
    };
    const SceneDocument document = load_scene(scene("wedge.obj"));
    REQUIRE(document.scene.bodies.size() == 7);
    CHECK(std::get<Hull>(document.scene.bodies[0].shape).points.size() == 4);
    CHECK(sieve_size(document.scene.bodies[0].shape) == Approx(0.05).epsilon(1e-3));
    CHECK_THROWS_WITH(load_scene(scene("none.obj")), Catch::StartsWith("/grains/0/shapes/0/form/mesh/file: "));
    CHECK_THROWS_WITH(load_scene(scene("../wedge.obj")), Catch::Contains("lies outside of the scene file's folder"));
    std::vector<std::string> notes;
    load_scene(scene("wedge.obj",
                     R"(, {"sieve": [{"size": 0.01, "passing": 0}, {"size": 0.02, "passing": 50}, {"size": 0.08, "passing": 100}],
        "count": 9, "region": {"box": {"lower": [0, 0, 0], "upper": [1, 1, 1]}}})"),
               {}, &notes);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("scene.json: /grains/1: 9 grains miss the sieve curve by "));
}

TEST_CASE("scene file: grains that cannot be are refused with their place", "[grains]") {
    const std::string region = R"("region": {"box": {"lower": [0, 0, 0], "upper": [1, 1, 1]}})";
    const auto with = [&](const std::string& keys) { return refusal("{" + keys + ", " + region + "}"); };
    CHECK_THAT(with(R"("size": 0.1, "count": 3, "sizes": 3)"), Catch::StartsWith("/grains/0/sizes: unknown key"));
    CHECK_THAT(with(R"("size": 0.1, "count": -3)"), Catch::StartsWith("/grains/0/count: must be"));
    CHECK_THAT(with(R"("size": 0.1, "count": 3, "start": 1)"), Catch::StartsWith("/grains/0/start: is of poured grains"));
    CHECK_THAT(with(R"("size": 0.1, "count": 3, "mass_rate": 1, "count_rate": 1)"), Catch::StartsWith("/grains/0/count_rate:"));
    CHECK_THAT(with(R"("size": 0.1, "fill": 0.3, "mass_rate": 1)"), Catch::StartsWith("/grains/0/fill: is of grains"));
    CHECK_THAT(with(R"("size": 0.1, "count": 3, "count_rate": 1, "from": 9)"), Catch::StartsWith("/grains/0/from: there are 3"));
    CHECK_THAT(with(R"("size": 1.1, "count": 3, "count_rate": 1)"), Catch::StartsWith("/grains/0/region: is too narrow"));
    CHECK_THAT(with(R"("size": 0.1, "count": 3, "shapes": [{"form": {"cube": {}}}])"),
               Catch::StartsWith("/grains/0/shapes/0/form"));
    CHECK_THAT(with(R"("size": 0.1, "count": 3, "shapes": [{"form": {"mesh": {"file": "a.obj"}}}])"),
               Catch::Contains("/grains/0/shapes/0/form/mesh: \"a.obj\" has not been read"));
    CHECK_THAT(refusal(R"({"size": 0.1, "count": 3})"), Catch::StartsWith("/grains/0: lacks \"region\""));
    CHECK_THAT(refusal("3"), Catch::StartsWith("/grains/0: must be an object"));
    const std::string pour = R"({"size": 0.1, "count": 3, "count_rate": 1, )" + region + "}";
    CHECK_THAT(refusal(pour + "," + pour), Catch::Contains("are named \"grain\", too; give them names"));
    const std::string named = R"({"name": "grain", "size": 0.1, "count": 3, )" + region + "}";
    CHECK_THAT(refusal(named + "," + pour),
               Catch::StartsWith("/events/0/action/pour/name: a body of the scene is named \"grain 2\""));
    CHECK_THAT(refusal("", R"(, "events": [{"time": 0, "action": {"pour": {"size": 0.1, "count": 3, )" + region + "}}}]"),
               Catch::StartsWith("/events/0/action/pour: needs a \"mass_rate\" or \"count_rate\""));
    try {
        scene_from_json(R"({"bodies": [], "grains": [{"size": 0.01, "count": 1000000, )" + region + "}]}", 5000);
        FAIL("too many");
    } catch (const SceneError& error) {
        CHECK_THAT(error.what(), Catch::StartsWith("/grains/0: these are more than 5000 grains"));
    }
}
