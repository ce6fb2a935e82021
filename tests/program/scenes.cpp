// Demos by the program: exported scenes run identically, reports are complete, no initial overlap.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compute/scene_file/scene_json.h"
#include "shaders/physics/base/arithmetic.h"
#include "tests/program/program.h"

using nlohmann::json;
using scree::Body;
using scree::vec3;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

// Names of the gallery's demos; trials are listed after an empty line.
std::vector<std::string> demo_names() {
    std::istringstream lines(run_scree("list").output);
    std::vector<std::string> names;
    std::string line;
    std::getline(lines, line);  // the heading
    while (std::getline(lines, line) && !line.empty()) names.push_back(line.substr(0, line.find(' ')));
    return names;
}

std::string few_bodies(const std::string& name) {
    const bool many = name == "pile" || name == "mix" || name == "avalanche" || name == "assortment" || name == "terrain" ||
                      name == "ragdolls" || name == "hopper" || name == "ballast" || name == "drum";
    return many ? " --bodies 300" : "";
}

std::string hash_of_run(const std::string& scene) {
    const Outcome outcome = run_scree("run " + scene + " --backend cpu --steps 5 --quiet --report -");
    INFO(outcome.errors);
    REQUIRE(outcome.status == 0);
    return json::parse(outcome.output).at("state_hash");
}

// Support of a body along a unit direction, from its centre, m.
double extent(const Body& body, vec3 along) {
    if (const auto* sphere = std::get_if<scree::Sphere>(&body.shape)) return sphere->radius;
    const vec3 inside = scree::physics::rotate_back(body.orientation, along);
    const double across = std::hypot(inside.x, inside.z);
    if (const auto* capsule = std::get_if<scree::Capsule>(&body.shape))
        return capsule->radius + std::abs(inside.y) * capsule->half_height;
    if (const auto* cylinder = std::get_if<scree::Cylinder>(&body.shape))
        return across * cylinder->radius + std::abs(inside.y) * cylinder->half_height;
    if (const auto* cone = std::get_if<scree::Cone>(&body.shape))
        return std::max(0.75 * inside.y * cone->height, across * cone->radius - 0.25 * inside.y * cone->height);
    if (const auto* hull = std::get_if<scree::Hull>(&body.shape)) {
        double most = 0;
        for (const vec3& point : hull->points) most = std::max(most, static_cast<double>(glm::dot(inside, point)));
        return most;
    }
    if (const auto* compound = std::get_if<scree::Compound>(&body.shape)) {
        double most = -1e9;
        for (const scree::Part& part : compound->parts) {
            Body one;
            one.shape = scree::whole_shape(part.shape);
            one.orientation = part.orientation;
            most = std::max(most, static_cast<double>(glm::dot(inside, part.position)) + extent(one, inside));
        }
        return most;
    }
    const vec3 h = std::get<scree::Box>(body.shape).half_extents;
    return std::abs(inside.x) * h.x + std::abs(inside.y) * h.y + std::abs(inside.z) * h.z;
}

// Separating axis test (with tolerance for touching bodies). Candidates are the axes of the world and of the bodies, their cross
// products and the line of centres, which suffices for boxes and for all placements of the demos.
bool parted(const Body& a, const Body& b) {
    std::vector<vec3> directions = {b.position - a.position};
    const vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const vec3& axis : axes) {
        directions.push_back(axis);
        directions.push_back(scree::physics::rotate(a.orientation, axis));
        directions.push_back(scree::physics::rotate(b.orientation, axis));
        for (const vec3& other : axes) {
            directions.push_back(
                glm::cross(scree::physics::rotate(a.orientation, axis), scree::physics::rotate(b.orientation, other)));
        }
    }
    return std::any_of(directions.begin(), directions.end(), [&](vec3 along) {
        if (glm::length(along) < 1e-4f) return false;
        along = glm::normalize(along);
        if (glm::dot(b.position - a.position, along) < 0) along = -along;
        return glm::dot(b.position - a.position, along) + 1e-4 > extent(a, along) + extent(b, -along);
    });
}

bool above(const Body& body, const scree::Plane& plane) {
    return glm::dot(body.position, plane.normal) - plane.offset + 1e-4 > extent(body, -plane.normal);
}

}  // namespace

TEST_CASE("program: list names the demos, help teaches, the version is told", "[program]") {
    const std::vector<std::string> names = demo_names();
    for (const char* name : {"rest", "stack", "tower", "wall", "pyramid", "seesaw", "slopes", "cradle", "dominoes", "pile", "mix",
                             "avalanche", "assortment", "terrain", "mesh"}) {
        REQUIRE(std::count(names.begin(), names.end(), name) == 1);
    }
    const Outcome list = run_scree("list");
    REQUIRE(says(list.output, "\n\ntrial "));
    for (const char* name : {"\nstack20 ", "\npyramid100 ", "\njenga "}) REQUIRE(says(list.output, name));
    const Outcome help = run_scree("--help");
    REQUIRE(help.status == 0);
    for (const char* command :
         {"list", "devices", "run", "compare", "check", "validate", "bench", "export", "info", "Exit status"})
        REQUIRE(says(help.output, command));
    REQUIRE(says(run_scree("--version").output, "scree "));
}

TEST_CASE("program: every --help fits into 100 columns and tells each option's default or unit", "[program]") {
    for (const char* command :
         {"", "list ", "devices ", "run ", "view ", "compare ", "check ", "validate ", "bench ", "export ", "info "}) {
        const Outcome help = run_scree(std::string(command) + "--help");
        REQUIRE(help.status == 0);
        std::istringstream lines(help.output);
        for (std::string line; std::getline(lines, line);) {
            INFO(command << ": " << line);
            CHECK(line.size() <= 100);
        }
    }
    const std::string run = run_scree("run --help").output;
    for (const char* words :
         {"Worker threads for --backend cpu (0: one per core). Default: 0.", "Colour map: ember", "Default: 30."})
        REQUIRE(says(run, words));
}

TEST_CASE("program: an exported scene runs to the hash of its demo", "[program]") {
    const Place place;
    for (const std::string& name : demo_names()) {
        if (name == "fountain") continue;  // a script adds and removes its bodies
        INFO(name);
        const std::string file = (place / (name + ".json")).string();
        REQUIRE(run_scree("export " + name + few_bodies(name) + " -o '" + file + "'").status == 0);
        REQUIRE(hash_of_run("'" + file + "'") == hash_of_run(name + few_bodies(name)));
        const std::string again = (place / "again.json").string();
        REQUIRE(run_scree("export '" + file + "' -o '" + again + "'").status == 0);
    }
}

TEST_CASE("program: no bodies of a demo overlap at the start", "[program]") {
    for (const std::string& name : demo_names()) {
        const Outcome exported = run_scree("export " + name + few_bodies(name));
        REQUIRE(exported.status == 0);
        const scree::Scene told = scree::scene_from_json(exported.output).scene, scene = scree::checked(told);
        const std::size_t count = told.bodies.size();  // followed by pending fragments
        REQUIRE(count > 1);
        std::size_t overlaps = 0;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) {
                const Body &a = scene.bodies[i], &b = scene.bodies[j];
                const bool joined = std::any_of(scene.joints.begin(), scene.joints.end(), [&](const scree::Joint& joint) {
                    return !joint.collide && std::minmax(joint.a, joint.b) == std::minmax(i, j);
                });
                if (joined || a.motion != scree::Motion::dynamic || (j <= i && b.motion == scree::Motion::dynamic)) continue;
                // Overlap with triangles is tested in tests/demos/vulkan/lockstep_test.cpp.
                if (std::holds_alternative<scree::Mesh>(b.shape) || std::holds_alternative<scree::HeightField>(b.shape)) continue;
                const auto* plane = std::get_if<scree::Plane>(&b.shape);
                if (plane ? above(a, *plane) : parted(a, b)) continue;
                if (overlaps++ == 0) UNSCOPED_INFO("bodies " << i << " and " << j);
            }
        }
        INFO(name);
        REQUIRE(overlaps == 0);
    }
}

TEST_CASE("program: a report has every key, and says the same on every run", "[program]") {
    const Place place;
    const std::string file = (place / "report.json").string();
    REQUIRE(run_scree("run mix --bodies 200 --backend cpu --steps 30 --quiet --report '" + file + "'").status == 0);
    const json report = json::parse(place.read("report.json"));
    for (const char* key : {"demo",
                            "backend",
                            "device",
                            "processor",
                            "lanes",
                            "bodies",
                            "steps",
                            "dt",
                            "substeps",
                            "ms_per_step",
                            "stages",
                            "manifolds",
                            "points",
                            "penetration",
                            "max_speed",
                            "max_spin",
                            "spin_limited",
                            "kinetic_energy",
                            "momentum",
                            "drift_max",
                            "not_finite",
                            "below_ground",
                            "buffer_growths",
                            "state_hash",
                            "first_step_seconds",
                            "peak_memory_bytes",
                            "peak_memory_per_body"}) {
        INFO(key);
        REQUIRE(report.contains(key));
    }
    for (const char* key : {"mean", "median", "p95", "min"}) REQUIRE(report["ms_per_step"][key].get<double>() > 0);
    REQUIRE(report["penetration"].contains("mean"));
    REQUIRE(report["penetration"].contains("max"));
    REQUIRE(report["momentum"].size() == 3);
    REQUIRE(report["first_step_seconds"].get<double>() > 0);
    REQUIRE(report["first_step_seconds"].get<double>() <= report["seconds_total"].get<double>());
    REQUIRE(report["peak_memory_per_body"].get<double>() == Approx(report["peak_memory_bytes"].get<double>() / 205));
    REQUIRE(report["bodies"] == 205);  // with a ground and four walls
    REQUIRE(report["steps"] == 30);
    REQUIRE(report["dt"].get<double>() == Approx(1.0 / 60));
    REQUIRE(report["stages"].size() > 5);
    REQUIRE(run_scree("run mix --bodies 200 --backend cpu --threads 1 --steps 30 --quiet --report '" + file + "'").status == 0);
    REQUIRE(json::parse(place.read("report.json"))["state_hash"] == report["state_hash"]);
}

TEST_CASE("program: the summary tells when the first step was done and what a body takes", "[program]") {
    const Outcome run = run_scree("run rest --backend cpu --steps 2");
    REQUIRE(run.status == 0);
    REQUIRE(says(run.output, "first step      after "));
    REQUIRE(says(run.output, "bytes per body"));
}

TEST_CASE("program: a size in another notation is the size of the pictures", "[program]") {
    const Place place;
    const Outcome run =
        run_scree("run rest --backend cpu --steps 1 --quiet --size 1e2x64 --frames '" + place.path().string() + "'");
    INFO(run.errors);
    REQUIRE(run.status == 0);
    const std::string png = place.read("frame_000000.png");
    REQUIRE(png.size() > 24);
    REQUIRE(png.substr(16, 8) == std::string("\0\0\0\x64\0\0\0\x40", 8));  // IHDR: width, height
}

TEST_CASE("program: check holds a demo to its promise, and a run that is too short is not judged", "[program]") {
    const Outcome kept = run_scree("check rest slopes --backend cpu --quiet");
    INFO(kept.output);
    REQUIRE(kept.status == 0);
    REQUIRE(says(kept.output, "acceleration of the rolling sphere"));
    REQUIRE(says(kept.output, "promises kept"));
    const Outcome brief = run_scree("run stack --backend cpu --steps 10");
    REQUIRE(brief.status == 0);
    REQUIRE(says(brief.output, "not judged"));
    // With one substep forty boxes do not stand: the promise is missed, as the exit status shows.
    const Outcome missed = run_scree("run tower --backend cpu --substeps 1");
    INFO(missed.output);
    REQUIRE(missed.status == 1);
    REQUIRE(says(missed.output, "MISS"));
}

TEST_CASE("program: check takes patterns, lists what is promised, and reports as JSON", "[program]") {
    const Outcome list = run_scree("check --list 'sees*' rest");
    REQUIRE(list.status == 0);
    for (const char* words : {"slant with equal weights", "at most 0.001 degrees", "rounding of single precision",
                              "how it is measured", "greatest drift"})
        REQUIRE(says(list.output, words));
    const Place place;
    const std::string file = (place / "check.json").string();
    const Outcome check = run_scree("check 're?t' crad --backend cpu --quiet --report '" + file + "'");
    INFO(check.errors);
    REQUIRE(check.status == 0);
    const json report = json::parse(place.read("check.json"));
    REQUIRE(report["scenes"].size() == 2);
    REQUIRE(report["scenes"][0]["scene"] == "rest");
    REQUIRE(report["kept"] == report["of"]);
    REQUIRE(says(check.output, report["scenes"][1]["state_hash"].get<std::string>()));
    const Outcome again = run_scree("check cradle --backend cpu --threads 1 --quiet --report -");
    REQUIRE(json::parse(again.output)["scenes"][0]["state_hash"] == report["scenes"][1]["state_hash"]);
    const Outcome run = run_scree("run cradle --backend cpu --quiet --report -");
    REQUIRE(json::parse(run.output)["state_hash"] == report["scenes"][1]["state_hash"]);
}

TEST_CASE("program: every demo has a promise", "[program]") {
    for (const std::string& name : demo_names()) {
        const Outcome run = run_scree("run " + name + few_bodies(name) + " --backend cpu --steps 1");
        INFO(name);
        REQUIRE(run.status == 0);
        REQUIRE(says(run.output, "The promise was not judged"));
    }
}

TEST_CASE("program: bench writes a table and CSV with a row for every stage", "[program]") {
    const Place place;
    const Outcome bench =
        run_scree("bench pile --bodies 50,200 --steps 3 --warmup 1 --backend cpu --csv '" + (place / "b.csv").string() + "'");
    INFO(bench.errors);
    REQUIRE(bench.status == 0);
    REQUIRE(says(bench.output, "us/body"));
    const std::string csv = place.read("b.csv");
    REQUIRE(says(csv,
                 "demo,backend,device,bodies,manifolds,points,asleep,buffer_bytes,stage,ms_median,ms_25,ms_75,ms_mean,bytes,"
                 "copy_bytes_per_s,share_of_copy"));
    REQUIRE(std::count(csv.begin(), csv.end(), '\n') > 20);
    REQUIRE(says(csv, "solve_contacts"));
    REQUIRE(says(bench.output, "compute_bounds"));
    REQUIRE(says(bench.output, "% of copying"));
}

TEST_CASE("program: bench shows what a driver tells of its pipelines, or says that it tells nothing", "[program]") {
    const Outcome bench = run_scree("bench rest --steps 1 --warmup 1 --backend vulkan --pipelines -q");
    INFO(bench.errors);
    REQUIRE(bench.status == 0);
    REQUIRE((says(bench.output, "rest: what the driver tells of its pipelines") ||
             says(bench.output, "tells nothing of its pipelines")));
}

TEST_CASE("program: bench measures pairs of two kinds that touch, and refuses what it would leave out", "[program]") {
    const Outcome bench =
        run_scree("bench --pairs 60 hull-box sphere-sphere --steps 5 --backend cpu --threads 1 --quiet --csv -");
    INFO(bench.errors);
    REQUIRE(bench.status == 0);
    REQUIRE(says(bench.output, "medians of 20 steps"));
    for (const char* kinds : {"\nbox-box,60,", "\nbox-hull,60,", "\nsphere-sphere,60,"}) {
        const std::size_t at = bench.output.find(kinds);
        REQUIRE(at != std::string::npos);
        const std::string row = bench.output.substr(at + std::string(kinds).size());
        CHECK(std::stod(row) > 85);                           // percentage of touching pairs, which dominate the cost
        CHECK(std::stod(row.substr(row.find(',') + 1)) > 0);  // ns
    }
    REQUIRE_FALSE(says(bench.output, "hull-hull"));
    const Outcome unknown = run_scree("bench --pairs 60 hull-pudding");
    REQUIRE(unknown.status == 2);
    REQUIRE(says(unknown.errors, "hull-pudding"));
    REQUIRE(says(unknown.errors, "cylinder"));
    REQUIRE(run_scree("bench --pairs 60 --bodies 1k").status == 2);
    REQUIRE(run_scree("bench --pairs 60 --settle 2").status == 2);
}

TEST_CASE("program: bench settles a pile once, keeps it, and measures it again from the file", "[program]") {
    const Place place;
    const std::string command =
        "bench mix --bodies 40 --steps 2 --warmup 1 --settle 0.5 --backend cpu --quiet --csv - --settled '" +
        (place / "kept").string() + "'";
    const Outcome first = run_scree(command);
    INFO(first.errors);
    REQUIRE(first.status == 0);
    const std::filesystem::path kept = place / "kept" / "mix-40-0.5s.json";
    REQUIRE(std::filesystem::exists(kept));
    std::filesystem::resize_file(kept, 10);
    const Outcome second = run_scree(command);
    REQUIRE(second.status != 0);
    REQUIRE(says(second.errors, "mix-40-0.5s.json"));
    REQUIRE(run_scree("bench rest --settled '" + place.path().string() + "'").status == 2);
}

TEST_CASE("program: run saves the scene as it is at the end, to the last bit of every position", "[program]") {
    const Place place;
    const std::string file = (place / "later.json").string();
    REQUIRE(run_scree("run seesaw --backend cpu --steps 7 --quiet --save '" + file + "'").status == 0);
    const json start = json::parse(run_scree("export seesaw").output), later = json::parse(place.read("later.json"));
    REQUIRE(later["bodies"].size() == start["bodies"].size());
    REQUIRE(later["camera"] == start["camera"]);
    REQUIRE(later["bodies"] != start["bodies"]);
    REQUIRE(run_scree("run '" + file + "' --backend cpu --steps 1 --quiet").status == 0);
    REQUIRE(run_scree("export '" + file + "' -o '" + file + ".again'").status == 0);
    REQUIRE(place.read("later.json.again") == place.read("later.json"));
}

TEST_CASE("program: the schema is JSON and knows every key of an exported scene", "[program]") {
    const Outcome schema = run_scree("export --schema");
    REQUIRE(schema.status == 0);
    const json known = json::parse(schema.output);
    const json scene = json::parse(run_scree("export avalanche --bodies 50").output);
    for (const auto& [key, value] : scene.items()) REQUIRE(known["properties"].contains(key));
    for (const json& body : scene["bodies"]) {
        for (const auto& [key, value] : body.items()) REQUIRE(known["$defs"]["body"]["properties"].contains(key));
    }
}
