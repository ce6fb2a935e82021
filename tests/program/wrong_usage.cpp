// Wrong usage and input: messages with place, cause and remedy; exit status 2; no files left behind.
#include <signal.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/program/program.h"
#include "tests/sanitized.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

void require_refused(const Outcome& outcome, const std::vector<std::string>& words) {
    INFO(outcome.errors);
    REQUIRE(outcome.status == 2);
    REQUIRE(outcome.output.empty());
    for (const std::string& word : words) {
        INFO(word);
        REQUIRE(says(outcome.errors, word));
    }
    REQUIRE(says(outcome.errors, "scree: "));
    REQUIRE_FALSE(says(outcome.errors, "terminate called"));
}

void require_scene_refused(const std::string& text, const std::vector<std::string>& words) {
    const Place place;
    const std::string file = place.write("scene.json", text);
    const Outcome outcome = run_scree("run '" + file + "' --backend cpu --steps 1");
    require_refused(outcome, words);
    REQUIRE(says(outcome.errors, file + ": "));
}

std::string scene_with(const std::string& body) {
    return "{\"bodies\": [{\"shape\": {\"sphere\": {\"radius\": 1}}},\n" + body + "]}";
}

// Writes a fake ffmpeg that is found first.
void write_encoder(const Place& place, const std::string& script) {
    std::filesystem::permissions(place.write("ffmpeg", "#!/bin/sh\n" + script + "\n"), std::filesystem::perms::owner_all);
}
std::string with_encoder_of(const Place& place) {
    return "PATH='" + place.path().string() + "':\"$PATH\"; export PATH;";
}

// A long run with frames, a video and a report, interrupted after some pictures.
Outcome run_until_pictures(const Place& place, const std::string& before = "") {
    const std::string at = place.path().string();
    const std::string start =
        "--seconds 10000 --size 320x180 --frames '" + at + "/frames' --video '" + at + "/clip.mp4' --report '" + at + "/r.json'";
    // The shell writes the program's process id to a file.
    std::thread interrupter([&] {
        for (int i = 0; i < 600 && !std::filesystem::exists(place / "frames/frame_000003.png"); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        const int process = std::atoi(place.read("pid").c_str());
        if (process > 0) ::kill(process, SIGINT);
    });
    const Outcome outcome = run_scree("run dominoes --backend cpu " + start, before + " echo $$ >'" + at + "/pid'; exec");
    interrupter.join();
    return outcome;
}

}  // namespace

TEST_CASE("program: an unknown demo is answered with the nearest and with scree list", "[program]") {
    require_refused(run_scree("run avalanch"), {"unknown demo \"avalanch\"", "nearest: \"avalanche\"", "scree list"});
    require_refused(run_scree("check pyramit"), {"nearest: \"pyramid\""});
    require_refused(run_scree("export nothing-like-it"), {"unknown demo", "scree list"});
    require_refused(run_scree("export wall -o wall.glb"), {"wall.glb", "NAME.json", "--export"});
}

TEST_CASE("program: an unknown option or value is answered with what is known", "[program]") {
    require_refused(run_scree("run wall --backend vulcan"), {"--backend", "\"vulcan\"", "nearest: \"vulkan\"", "cpu"});
    require_refused(run_scree("run wall --colour speed"), {"run: unknown option \"--colour\"", "nearest: \"--color\"", "--help"});
    require_refused(run_scree("run pile --bodys=100"), {"unknown option \"--bodys\"", "nearest: \"--bodies\""});
    require_refused(run_scree("compare mix --subteps 4"), {"compare: unknown option \"--subteps\"", "nearest: \"--substeps\""});
    require_refused(run_scree("--versoin"), {"unknown option \"--versoin\"", "nearest: \"--version\""});
    require_refused(run_scree("exprot wall"), {"unknown command \"exprot\", nearest: \"export\""});
    require_refused(run_scree("run wall --color sped"), {"--color", "speed"});
    require_refused(run_scree("run wall --size 12by9"), {"12by9", "WIDTHxHEIGHT"});
    require_refused(run_scree("run wall --size 8x8"), {"between 16 and 16384"});
    require_refused(run_scree("run wall --color-range 5:1"), {"LOW must be below HIGH"});
    require_refused(run_scree("run wall --steps 0"), {"--steps"});
    require_refused(run_scree("run wall --color-range -5:1e39"), {"--color-range", "1e39 is out of range"});
    require_refused(run_scree("run wall --seed -1"), {"--seed", "\"-1\""});
    require_refused(run_scree("export wall --seed 18446744073709551616"), {"--seed", "between 0 and 18446744073709551615"});
    require_refused(run_scree("foo"), {"unknown command \"foo\"", "view, serve, compare, check"});
    require_refused(run_scree("run wall --rate nan"), {"--rate", "between 10 and 1000"});
    require_refused(run_scree("run wall --seconds nan"), {"--seconds"});
    require_refused(run_scree("run wall --color-range nan:1"), {"nan"});
    require_refused(run_scree("run wall --steps 5 --seconds 1"), {"--s"});
    require_refused(run_scree("run pile --bodies many"), {"\"many\" is not a number"});
    require_refused(run_scree("run pile --bodies -5"), {"--bodies", "at least 1"});
    require_refused(run_scree("run wall --bodies 100"), {"wall", "fixed number", "avalanche"});
    require_refused(run_scree("run wall --frames nowhere --fps 120"), {"--fps 120", "--rate"});
    require_refused(run_scree(""), {"--help"});
}

TEST_CASE("program: wrong names and numbers of granular cases are refused before anything runs", "[program]") {
    const Place place;
    const std::string plots = (place.path() / "plots").string();
    require_refused(run_scree("validate granular jansen --plots '" + plots + "'"), {"\"jansen\"", "janssen", "beverloo"});
    require_refused(run_scree("validate granular column --seeds 0"), {"--seeds", "1"});
    require_refused(run_scree("validate granular column --bodies few"), {"--bodies", "few"});
    require_refused(run_scree("validate granular column --bodies 20"), {"--bodies", "100"});
    require_refused(run_scree("validate slide --seeds 2"), {"--seeds", "granular"});
    require_refused(run_scree("validate granular --list --plots '" + plots + "'"), {"--list", "--plots"});
    require_refused(run_scree("validate granular column --plots '" + place.write("file", "") + "'"), {"--plots", "file"});
    REQUIRE_FALSE(std::filesystem::exists(plots));
}

TEST_CASE("program: a scene file that is not there or not JSON is refused with line and column", "[program]") {
    require_refused(run_scree("run no/such/scene.json"), {"no/such/scene.json", "No such file"});
    require_scene_refused("{\"bodies\": [\n  {\"shape\": }\n]}", {"line 2, column 13", "not valid JSON"});
    require_scene_refused("", {"line 1, column 1"});
    require_scene_refused("[]", {"must be an object"});
    require_scene_refused("{}", {"bodies"});
}

TEST_CASE("program: a scene file with a wrong key or value is refused with its JSON pointer", "[program]") {
    require_scene_refused(scene_with(R"({"shape": {"torus": {"radius": 1}}})"),
                          {"/bodies/1/shape: unknown shape \"torus\"; known: box, capsule, compound, cone, cylinder, "
                           "ellipsoid, height_field, hull, mesh, plane, sphere"});
    require_scene_refused(scene_with(R"({"shape": {"sphere": {"radius": 1}}, "frictoin": 1})"),
                          {"/bodies/1/frictoin: unknown key \"frictoin\"; nearest: \"friction\""});
    require_scene_refused(scene_with(R"({"shape": {"sphere": {"radius": 1}}, "position": [0, NaN, 0]})"),
                          {"line 2", "NaN", "must be finite"});
    require_scene_refused(scene_with(R"({"shape": {"sphere": {"radius": 1}}, "position": [0, 1e999, 0]})"),
                          {"line 2", "1e999", "3.4e38"});
    require_scene_refused(scene_with(R"({"shape": {"sphere": {"radius": 1e39}}})"), {"/bodies/1/shape/sphere/radius", "3.4e38"});
    require_scene_refused(scene_with(R"({"shape": {"sphere": {"radius": 0}}, "name": "dot"})"),
                          {"/bodies/1/shape/sphere/radius: must be between 0.001 and 100000 m, is 0", "(body \"dot\")"});
    require_scene_refused(scene_with(R"({"shape": {"box": {"half_extents": [1, -0.5, 1]}}})"),
                          {"/bodies/1/shape/box/half_extents/1: must be between 0.001 and 100000 m, is -0.5"});
    require_scene_refused(scene_with(R"({"shape": {"sphere": {"radius": 1}}, "orientation": [0, 0, 0, 0]})"),
                          {"/bodies/1/orientation", "length 0"});
    require_scene_refused(scene_with(R"({"shape": {"plane": {}}})"), {"/bodies/1/motion", "fixed"});
    require_scene_refused(R"({"bodies": [], "joints": [{}]})", {"/joints/0", "lacks \"kind\""});
    const std::string bodies =
        R"({"bodies": [{"name": "door", "shape": {"sphere": {"radius": 1}}}], "joints": [{"name": "pin", )";
    require_scene_refused(bodies + R"("kind": {"ball": {}}, "a": 7}]})", {"/joints/0/a", "no body 7", "pin"});
    require_scene_refused(bodies + R"("kind": {"ball": {}}, "a": "gate"}]})", {"/joints/0/a", "no body named \"gate\""});
    const std::string twins =
        R"({"bodies": [{"name": "leg", "shape": {"sphere": {"radius": 1}}}, {"shape": {"sphere": {"radius": 1}}}, )"
        R"({"name": "leg", "shape": {"sphere": {"radius": 1}}}], )";
    require_scene_refused(twins + R"("joints": [{"kind": {"ball": {}}, "a": 1, "b": "leg"}]})",
                          {"/joints/0/b", "\"leg\" names bodies 0 and 2; give an index"});
    require_scene_refused(twins + R"("events": [{"time": 0, "action": {"impulse": {"body": "leg", "impulse": [1, 0, 0]}}}]})",
                          {"/events/0/action/impulse/body", "\"leg\" names bodies 0 and 2"});
    require_scene_refused(bodies + R"("kind": {"ball": {}}, "a": "door", "b": 0}]})", {"/joints/0/b", "joined to itself", "pin"});
    require_scene_refused(bodies + R"("kind": {"hinge": {}}, "b": 0, "anchor": [0, 0, 0], "axis": [0, 0, 0]}]})",
                          {"/joints/0/axis", "length 0"});
    require_scene_refused(bodies + R"("kind": {"hinge": {"limits": {"lower": 1, "upper": -1}}}, "b": 0}]})",
                          {"/joints/0/kind/hinge/limits", "reversed", "pin"});
    require_scene_refused(bodies + R"("kind": {"hook": {}}, "b": 0}]})", {"/joints/0/kind", "unknown kind of joint \"hook\""});
}

TEST_CASE("program: more bodies than fit into memory are refused before they are made, with what would fit", "[program]") {
    require_refused(run_scree("run pile --bodies 900G"), {"--bodies 900000000000", "beyond memory", "GB", "enough for about"});
    if (scree::tests::sanitized) return;  // their shadow memory is beyond any limit
    // Five fragments each: the bodies alone would fit.
    require_refused(run_scree("run shatter --bodies 20000 --backend cpu", "ulimit -v 400000;"),
                    {"--bodies 20000", "beyond memory", "20005 bodies and the 100000 pieces"});
    const Place place;
    std::string text = "{\"bodies\": [";
    for (int i = 0; i < 150000; ++i) text += std::string(i ? "," : "") + "{\"shape\":{\"sphere\":{\"radius\":1}}}\n";
    const std::string file = place.write("large.json", text + "]}");
    require_refused(run_scree("run '" + file + "' --backend cpu --steps 1", "ulimit -v 400000;"), {file, "/bodies", "memory"});
}

TEST_CASE("program: a step that needs more memory than is allowed or free ends the run, with what takes it", "[program]") {
    const Place place;
    std::string text = R"({"bodies": [)";
    for (int i = 0; i < 600; ++i)
        text += std::string(i ? "," : "") + R"({"shape":{"box":{"half_extents":[1,1,1]}},"position":[0,5,0]})";
    const std::string file = place.write("crowd.json", text + "]}"), run = "run '" + file + "' --backend cpu --steps 3 -q";
    const auto require_ended = [&](const Outcome& ended, const char* cause) {
        INFO(ended.errors);
        REQUIRE(ended.status == 1);
        for (const char* words : {"step 1 is beyond memory: 179700", cause, "alone may touch 599 others"})
            CHECK(says(ended.errors, words));
    };
    require_ended(run_scree(run + " --memory 20M"), "0.02 GB are allowed");
    require_refused(run_scree(run + " --memory much"), {"--memory", "much"});
    require_ended(run_scree("bench '" + file + "' --backend cpu --steps 1 -q --memory 20M"), "0.02 GB are allowed");
    const Outcome checked = run_scree("check calm --backend cpu -q --memory 1k");
    CHECK(checked.status == 1);
    CHECK(says(checked.errors, "is beyond memory"));
    if (scree::tests::sanitized) return;  // their shadow memory is beyond any limit
    // Only a thread alone takes the same address space each time: arenas of others may take what was free.
    require_ended(run_scree(run + " --threads 1", "ulimit -v 170000;"), "GB are allowed");
    require_ended(run_scree(run + " --threads 1 --memory 1G", "ulimit -v 170000;"), "the system gave less");
    const Outcome of_many = run_scree(run + " --threads 4", "ulimit -v 170000;");
    CAPTURE(of_many.errors);
    CHECK(of_many.status == 1);
    CHECK(says(of_many.errors, "step 1 is beyond memory"));
}

TEST_CASE("program: a frames folder, video or report that cannot be written is refused before the run", "[program]") {
    const Place place;
    const std::string file = place.write("file", "in the way");
    require_refused(run_scree("run rest --frames '" + file + "/frames'"), {file});
    require_refused(run_scree("run rest --video '" + file + "/clip.mp4'"), {file});
    require_refused(run_scree("run rest --report '" + file + "/r.json'"), {file, "make it first"});
    require_refused(run_scree("run rest --report '" + place.path().string() + "'"), {"--report", "is a folder"});
    require_refused(run_scree("run rest --report /proc/report.json"), {"--report", "/proc", "no file can be made"});
    require_refused(run_scree("bench rest --csv '" + place.path().string() + "'"), {"--csv", "is a folder"});
    REQUIRE(place.read("file") == "in the way");
}

TEST_CASE("program: a video that would replace what is no file is refused before the run", "[program]") {
    const Place place;
    const std::string pipe = (place / "pipe").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    require_refused(run_scree("run rest --steps 1 --video '" + pipe + "'"), {pipe, "not a regular file", "scree.mp4"});
    REQUIRE(std::filesystem::is_fifo(pipe));
    require_refused(run_scree("run rest --steps 1 --video /dev/null"), {"/dev/null", "not a regular file"});
    require_refused(run_scree("run rest --steps 1 --video '" + place.path().string() + "'"), {"is a folder"});
}

TEST_CASE("program: through a link, the video that it leads to is written", "[program]") {
    const Place place;
    write_encoder(place, "for last; do :; done; cat >/dev/null; echo video >\"${last#file:}\"");
    place.write("old.mp4", "old");
    std::filesystem::create_symlink("old.mp4", place / "link.mp4");
    std::filesystem::create_symlink("new.mp4", place / "early.mp4");
    for (const char* name : {"link.mp4", "early.mp4"}) {
        const Outcome run = run_scree("run rest --backend cpu --steps 1 --size 64x64 --video '" + (place / name).string() + "'",
                                      with_encoder_of(place));
        INFO(run.errors);
        REQUIRE(run.status == 0);
        REQUIRE(std::filesystem::is_symlink(place / name));
    }
    REQUIRE(place.read("old.mp4") == "video\n");
    REQUIRE(place.read("new.mp4") == "video\n");
}

TEST_CASE("program: frames are not mixed with those of an earlier run", "[program]") {
    const Place place;
    place.write("frame_000007.png", "earlier");
    require_refused(run_scree("run rest --steps 1 --frames '" + place.path().string() + "'"),
                    {place.path().string(), "frame_000007.png", "another folder", "remove"});
    REQUIRE(place.read("frame_000007.png") == "earlier");
}

TEST_CASE("program: closed streams change no status", "[program]") {
    const auto status_of = [](const std::string& words) {
        const int code = std::system(("'" SCREE_PROGRAM_PATH "' " + words).c_str());
        return WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
    };
    REQUIRE(status_of("run nosuch 2>&-") == 2);
    REQUIRE(status_of("run rest --backend cpu --steps 1 2>&- >/dev/null") == 0);
    REQUIRE(status_of("run rest --backend cpu --steps 1 >&- 2>/dev/null") == 1);
    REQUIRE(status_of("list >&- 2>&-") == 1);
}

TEST_CASE("program: a body that starts too fast is noted", "[program]") {
    const Place place;
    const std::string file = place.write("fast.json", scene_with(R"({"shape": {"sphere": {"radius": 1}}, "position": [9, 0, 0],
        "velocity": [300, 300, 0]})"));
    const Outcome run = run_scree("run '" + file + "' --backend cpu --steps 1");
    INFO(run.errors);
    REQUIRE(says(run.errors, "note: 1 body starts faster than 400 m/s and is slowed to that"));
}

TEST_CASE("program: a device that is not there is refused with those that are", "[program][vulkan]") {
    require_refused(run_scree("run rest --device 99"), {"99", "there are"});
    require_refused(run_scree("run rest --backend cpu --device 0"), {"--device", "--threads"});
}

TEST_CASE("program: without ffmpeg a video is refused with the package to install", "[program]") {
    const Place place;
    const std::string video = (place / "clip.mp4").string();
    require_refused(run_scree("run rest --steps 1 --video '" + video + "'", "PATH=/nowhere"),
                    {"ffmpeg", "apt-get install ffmpeg"});
    REQUIRE_FALSE(std::filesystem::exists(video));
}

TEST_CASE("program: without a Vulkan driver a run goes on with the processor and says so", "[program][vulkan]") {
    const std::string none = "VK_DRIVER_FILES=/nowhere.json VK_ICD_FILENAMES=/nowhere.json";
    const Outcome run = run_scree("run rest --steps 2", none);
    INFO(run.errors);
    REQUIRE(run.status == 0);
    REQUIRE(says(run.errors, "simulating on the processor"));
    require_refused(run_scree("run rest --steps 2 --backend vulkan", none), {"mesa-vulkan-drivers"});
    require_refused(run_scree("run rest --steps 2 --frames frames-nowhere --canvas vulkan", none), {"mesa-vulkan-drivers"});
    require_refused(run_scree("devices", none), {"mesa-vulkan-drivers"});
}

TEST_CASE("program: a video's name is a file's name, whatever the encoder would take it for", "[program]") {
    const Place place;
    for (const std::string name : {"10:30.mp4", "-x.mp4", "tcp:.mp4"}) {
        const Outcome run = run_scree("run rest --backend cpu --steps 2 --size 64x64 --video='" + name + "'",
                                      "cd '" + place.path().string() + "';");
        INFO(name << ": " << run.errors);
        REQUIRE(run.status == 0);
        REQUIRE(std::filesystem::file_size(place / name) > 0);
    }
}

TEST_CASE("program: an encoder that fails is a failure of the work, and leaves no video behind", "[program]") {
    const Place place;
    write_encoder(place, "exit 1");
    const std::string video = (place / "clip.mp4").string();
    const Outcome outcome =
        run_scree("run rest --backend cpu --steps 2 --size 64x64 --video '" + video + "'", with_encoder_of(place));
    INFO(outcome.errors);
    REQUIRE(outcome.status == 1);
    REQUIRE(says(outcome.errors, "ffmpeg failed"));
    REQUIRE_FALSE(std::filesystem::exists(video));
}

TEST_CASE("program: Ctrl-C tells of a video that could not be written", "[program]") {
    const Place place;
    write_encoder(place, "cat >/dev/null; echo no space left >&2; exit 1");
    const Outcome outcome = run_until_pictures(place, with_encoder_of(place));
    INFO(outcome.errors);
    REQUIRE(outcome.status == 130);
    REQUIRE(says(outcome.errors, "no space left"));
    REQUIRE(says(outcome.errors, "interrupted after"));
    REQUIRE_FALSE(std::filesystem::exists(place / "clip.mp4"));
}

TEST_CASE("program: Ctrl-C ends a long run with whole pictures, a report of what there is, and status 130", "[program]") {
    const Place place;
    const Outcome outcome = run_until_pictures(place);
    INFO(outcome.errors);
    REQUIRE(outcome.status == 130);
    REQUIRE(says(outcome.errors, "interrupted after"));
    const nlohmann::json report = nlohmann::json::parse(place.read("r.json"));
    REQUIRE(report["interrupted"] == true);
    REQUIRE(report["steps"] > 0);
    REQUIRE(report["frames"] >= 4);
    for (const auto& entry : std::filesystem::directory_iterator(place.path())) {
        INFO(entry.path());
        const std::string name = entry.path().filename().string();
        REQUIRE((name == "frames" || name == "pid" || name == "clip.mp4" || name == "r.json"));
        if (name == "clip.mp4") REQUIRE(says(place.read(name), "moov"));  // the index, which is written last
    }
    for (const auto& entry : std::filesystem::directory_iterator(place / "frames")) {
        INFO(entry.path());
        REQUIRE(entry.path().extension() == ".png");
        const std::string bytes = place.read("frames/" + entry.path().filename().string());
        REQUIRE(bytes.size() > 20);
        REQUIRE(bytes.substr(bytes.size() - 8, 4) == "IEND");
    }
}
