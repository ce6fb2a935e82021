// The window on a virtual display, with mouse and keys by xdotool; screenshots are kept in the build folder.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "host/vulkan/device.h"
#include "host/window/window.h"
#include "shaders/physics/base/records.h"
#include "tests/program/window/hands.h"

using nlohmann::json;
using namespace scree::program;

namespace {

bool can_show() {
    for (const char* program : {"Xvfb", "xdotool"}) {
        if (is_installed(program)) continue;
        WARN("skipped: " << program << " is not installed");
        return false;
    }
    return true;
}

// A 1 m box on the ground, in the centre of the window.
constexpr const char* scene = R"({"bodies": [
  {"name": "ground", "motion": "fixed", "shape": {"plane": {}}},
  {"name": "box", "shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "position": [0, 0.5, 0]},
  {"shape": {"capsule": {"radius": 0.3, "half_height": 0.4}}, "position": [2.5, 0.7, -1]},
  {"shape": {"sphere": {"radius": 0.4}}, "position": [-2, 0.4, -1]}],
  "camera": {"eye": [0, 2, 8], "target": [0, 0.5, 0], "vertical_fov": 40}})";

void drag_the_box(const Viewer& viewer) {
    viewer.point(400, 225);
    viewer.hand("mousedown 1");
    for (int i = 1; i <= 10; ++i) {
        viewer.point(400 + 15 * i, 225 - 8 * i);
        wait_for(0.05);
    }
    viewer.shoot("2_pulled");
    // 150 pixels are about 2 m here.
    REQUIRE(viewer.until([](const json& now) {
        const json& grabbed = now.at("grabbed");
        return grabbed.size() == 1 && grabbed[0].at("body") == 1 && grabbed[0].at("to")[0] > 1.2 && grabbed[0].at("to")[1] > 0.8;
    }));
    viewer.shoot("2_held");
    viewer.hand("mouseup 1");
    REQUIRE(viewer.until([](const json& now) { return now.at("selected") == 1 && now.at("selected_position")[1] < 0.8; }));
    REQUIRE(viewer.report().at("bodies") == 4);
}

void throw_a_ball(const Viewer& viewer) {
    viewer.point(330, 230);
    viewer.strike("space");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 5 && now.at("thrown") == 1; }));
    viewer.shoot("3_thrown");
}

void stop_the_clock(const Viewer& viewer) {
    viewer.strike("p");
    REQUIRE(viewer.until([](const json& now) { return now.at("paused") == true; }));
    const json before = viewer.next(), after = viewer.next();
    REQUIRE(after.at("steps") == before.at("steps"));
    REQUIRE(after.at("pictures") > before.at("pictures"));
    viewer.strike("period");
    REQUIRE(viewer.until([&](const json& now) { return now.at("steps") == before.at("steps").get<int>() + 1; }));
    viewer.shoot("4_paused");
    viewer.strike("p");
    REQUIRE(viewer.until([&](const json& now) { return now.at("steps") > before.at("steps").get<int>() + 5; }));
}

void change_the_size(const Viewer& viewer) {
    for (const auto& [width, height] : {std::pair(1000, 620), {420, 300}, {800, 450}}) {
        viewer.hand("windowsize " + viewer.window() + " " + std::to_string(width) + " " + std::to_string(height));
        REQUIRE(viewer.until([&, w = width](const json& now) { return now.at("width") == w; }));
        const json before = viewer.next();
        REQUIRE(viewer.until([&](const json& now) { return now.at("pictures") > before.at("pictures").get<int>() + 1; }));
        viewer.shoot("5_" + std::to_string(width));
    }
    viewer.hand("windowunmap " + viewer.window());
    const json hidden = viewer.next();
    viewer.hand("windowmap " + viewer.window());
    REQUIRE(viewer.until([&](const json& now) { return now.at("pictures") > hidden.at("pictures").get<int>() + 1; }));
    viewer.hand("windowfocus --sync " + viewer.window());
}

// Clicks on the panel do not reach the scene behind it, not even between two pictures.
void use_the_panel(const Viewer& viewer) {
    const json before = viewer.report();
    viewer.hand("mousemove --window " + viewer.window() + " 38 236 mousedown 1");  // "Pause"
    wait_for(0.3);
    viewer.hand("mouseup 1");
    REQUIRE(viewer.until([](const json& now) { return now.at("paused") == true; }));
    REQUIRE(viewer.report().at("grabbed") == before.at("grabbed"));
    REQUIRE(viewer.report().at("selected") == before.at("selected"));
    viewer.strike("p");
    REQUIRE(viewer.until([](const json& now) { return now.at("paused") == false; }));
}

}  // namespace

TEST_CASE(
    "in the window a drag moves the body that was grabbed, space throws, pause stops the clock, and a resize keeps drawing") {
    if (!can_show()) return;
    const Screen screen;
    REQUIRE_FALSE(screen.name().empty());
    for (const std::string backend : {"vulkan", "cpu"}) {
        CAPTURE(backend);
        const Place place;
        const std::string file = place.write("box.json", scene), recording = (place / "played.json").string();
        Viewer viewer(screen, place, backend,
                      {file, "--backend", backend, "--validate", "--size", "800x450", "--record", recording});
        viewer.find_window();
        viewer.shoot("1_begun");
        drag_the_box(viewer);
        throw_a_ball(viewer);
        stop_the_clock(viewer);
        change_the_size(viewer);
        use_the_panel(viewer);
        viewer.strike("q");
        const int status = viewer.process().end(30);
        INFO(viewer.errors());
        REQUIRE(status == 0);
        REQUIRE(viewer.errors().empty());

        for (const std::string other : {"cpu", "vulkan"}) {
            const Outcome outcome = run_scree("run --input '" + recording + "' --backend " + other);
            INFO(outcome.output << outcome.errors);
            REQUIRE(outcome.status == 0);
            REQUIRE(says(outcome.output, "as recorded"));
            REQUIRE(says(outcome.output, viewer.report().at("state_hash").get<std::string>()));
        }
    }
}

TEST_CASE(
    "in the window bodies are selected, duplicated, deleted and joined, and Escape closes what is open but not the program") {
    if (!can_show()) return;
    const Screen screen;
    const Place place;
    const std::string file = place.write("box.json", scene), recording = (place / "edited.json").string();
    Viewer viewer(screen, place, "edit", {file, "--backend", "cpu", "--validate", "--size", "800x450", "--record", recording});
    viewer.find_window();
    const auto click = [&](int x, int y) {
        viewer.point(x, y);
        viewer.next();
        viewer.hand("click 1");
        viewer.next();
    };
    viewer.strike("h");
    click(265, 219);  // the sphere
    REQUIRE(viewer.until([](const json& now) { return now.contains("selected") && now.at("selected") == 3; }));
    viewer.shoot("1_selected");
    viewer.strike("v");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 5; }));
    viewer.strike("Delete");
    REQUIRE(viewer.until([](const json& now) { return !now.contains("selected"); }));
    viewer.strike("j");
    click(400, 225);  // the box
    viewer.next();
    viewer.point(500, 210);
    viewer.next();
    viewer.shoot("2_joining");
    click(570, 199);  // the capsule
    viewer.next();
    click(400, 400);  // the ground
    REQUIRE(viewer.until([](const json& now) { return now.contains("selected") && now.at("selected") == 0; }));
    click(400, 225);
    REQUIRE(viewer.until([](const json& now) { return now.contains("selected") && now.at("selected") == 1; }));
    viewer.strike("h");
    viewer.next();
    viewer.shoot("3_joined");
    viewer.point(95, 48);  // the list of scenes
    viewer.next();
    viewer.hand("mousedown 1");
    viewer.next();
    viewer.hand("mouseup 1");
    viewer.next();
    viewer.shoot("4_list");
    viewer.strike("Escape");
    viewer.next();
    viewer.strike("o");
    viewer.next();
    viewer.shoot("5_open");
    viewer.strike("Escape");  // the list of files
    viewer.next();
    REQUIRE(viewer.report().contains("selected"));
    viewer.strike("Escape");
    REQUIRE(viewer.until([](const json& now) { return !now.contains("selected"); }));
    viewer.strike("Escape");
    const json before = viewer.next();
    REQUIRE(viewer.until([&](const json& now) { return now.at("pictures") > before.at("pictures").get<int>() + 1; }));
    viewer.strike("q");
    const int status = viewer.process().end(30);
    INFO(viewer.errors());
    REQUIRE(status == 0);
    REQUIRE(viewer.errors().empty());
    const json recorded = json::parse(place.read("edited.json"));
    for (const char* act : {"add", "remove", "join"}) {
        CAPTURE(act);
        REQUIRE(std::count_if(recorded.at("acts").begin(), recorded.at("acts").end(),
                              [&](const json& one) { return one.contains(act); }) == 1);
    }
    for (const std::string other : {"cpu", "vulkan"}) {
        const Outcome outcome = run_scree("run --input '" + recording + "' --backend " + other);
        INFO(outcome.output << outcome.errors);
        REQUIRE(outcome.status == 0);
        REQUIRE(says(outcome.output, "as recorded"));
    }
}

TEST_CASE("in the window keys drive a car and put it on its wheels, and a recording of it leads to the same state") {
    if (!can_show()) return;
    const Screen screen;
    const Place place;
    const std::string recording = (place / "driven.json").string();
    Viewer viewer(screen, place, "drive", {"drive", "--backend", "cpu", "--size", "640x360", "--record", recording});
    viewer.find_window();
    REQUIRE(viewer.until([](const json& now) { return now.at("vehicle").at("by_route") == true && now.at("steps") > 5; }));
    viewer.hand("keydown w");
    REQUIRE(viewer.until(
        [](const json& now) { return now.at("vehicle").at("by_route") == false && now.at("vehicle").at("speed") > 2; }));
    viewer.hand("keydown Left");
    REQUIRE(viewer.until([](const json& now) { return now.at("vehicle").at("steer") == 1; }));
    viewer.shoot("driving");
    viewer.hand("keyup Left");
    viewer.hand("keyup w");
    viewer.hand("keydown space");
    REQUIRE(viewer.until([](const json& now) { return std::abs(now.at("vehicle").at("speed").get<double>()) < 0.1; }));
    viewer.hand("keyup space");
    viewer.strike("BackSpace");
    wait_for(0.5);
    viewer.strike("q");
    REQUIRE(viewer.process().end(30) == 0);
    const json recorded = json::parse(place.read("driven.json"));
    REQUIRE(recorded.at("acts").size() >= 5);
    const json& acts = recorded.at("acts");
    REQUIRE(std::any_of(acts.begin(), acts.end(), [](const json& act) { return act.contains("righten"); }));
    const Outcome outcome = run_scree("run --input '" + recording + "' --backend cpu");
    INFO(outcome.output << outcome.errors);
    REQUIRE(outcome.status != 2);  // promises do not matter here
    REQUIRE(says(outcome.output, "as recorded"));
}

TEST_CASE("the window goes through the demos, closes at a signal, and leaves its recording") {
    if (!can_show()) return;
    const Screen screen;
    const Place place;
    const std::string recording = (place / "played.json").string();
    Viewer viewer(screen, place, "demos", {"stack", "--size", "640x400", "--record", recording});
    viewer.find_window();
    viewer.strike("Tab");
    REQUIRE(viewer.until([](const json& now) { return now.at("demo") != "stack"; }));
    const json before = viewer.report();
    const std::string second = before.at("demo");
    viewer.strike("r");
    viewer.strike("3");
    // Reports without the new body may be from before the restart.
    const int bodies = before.at("bodies").get<int>() + 1;
    REQUIRE(viewer.until([&](const json& now) { return now.at("bodies") == bodies && now.at("steps") > 10; }));
    viewer.shoot("second");
    viewer.process().signal(SIGTERM);
    REQUIRE(viewer.process().end(30) == 130);
    const json recorded = json::parse(place.read("played.json"));
    REQUIRE(recorded.at("scene") == second);
    REQUIRE(recorded.at("steps") > 10);
    REQUIRE(recorded.at("acts").size() == 1);
}

TEST_CASE("in the window the open dialog has the keyboard, and each restart and scene in which something is done its recording") {
    if (!can_show()) return;
    const Screen screen;
    const Place place;
    const std::string file = place.write("qpb3x.json", scene), recording = (place / "played.json").string();
    Viewer viewer(screen, place, "open", {"stack", "--backend", "cpu", "--size", "640x400", "--record", recording});
    viewer.find_window();
    viewer.strike("3");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 12; }));
    viewer.strike("r");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 11; }));
    viewer.strike("3");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 12; }));
    // All of this may come between two pictures.
    viewer.strike("o");
    viewer.hand("type --delay 1 '/nowhere/qpb3x.json'");
    viewer.strike("Return");
    viewer.next();
    viewer.next();
    viewer.shoot("1_refused");
    REQUIRE(viewer.report().at("demo") == "stack");
    REQUIRE(viewer.report().at("bodies") == 12);
    REQUIRE(viewer.report().at("paused") == false);
    viewer.hand("key ctrl+a");
    viewer.hand("type --delay 1 '" + file + "'");
    viewer.strike("Return");
    REQUIRE(viewer.until([&](const json& now) { return now.at("demo") == file; }));
    viewer.strike("3");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 5; }));
    viewer.hand("key ctrl+z");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 4; }));
    viewer.strike("3");
    REQUIRE(viewer.until([](const json& now) { return now.at("bodies") == 5; }));
    viewer.strike("q");
    REQUIRE(viewer.process().end(30) == 0);
    REQUIRE(says(viewer.errors(), "played-2.json"));
    for (const char* name : {"played.json", "played-2.json", "played-3.json"}) {
        CAPTURE(name);
        const json recorded = json::parse(place.read(name));
        REQUIRE(recorded.at("scene") == (name == std::string("played-3.json") ? file : "stack"));
        REQUIRE(recorded.at("acts").size() == 1);
        const Outcome outcome = run_scree("run --input '" + (place / name).string() + "' --backend cpu");
        INFO(outcome.output << outcome.errors);
        REQUIRE(says(outcome.output, "as recorded"));
    }
}

TEST_CASE("in a window that stands still more pictures are shown than could be drawn") {
    if (!can_show()) return;
    const Screen screen;
    const Place place;
    Viewer viewer(screen, place, "still", {"wall", "--backend", "cpu", "--size", "1200x700"});
    viewer.find_window();
    viewer.strike("p");
    REQUIRE(viewer.until([](const json& now) { return now.at("paused") == true && now.at("pictures_per_second") > 8; }));
    viewer.strike("q");
    REQUIRE(viewer.process().end(30) == 0);
}

namespace {

// Replacements of Vulkan functions that forward the call and return VK_ERROR_SURFACE_LOST_KHR.
PFN_vkQueuePresentKHR present = nullptr;
PFN_vkAcquireNextImageKHR acquire = nullptr;
int losses = 0;

VKAPI_ATTR VkResult VKAPI_CALL present_and_lose(VkQueue queue, const VkPresentInfoKHR* info) {
    const VkResult result = present(queue, info);
    return losses-- > 0 ? VK_ERROR_SURFACE_LOST_KHR : result;
}
VKAPI_ATTR VkResult VKAPI_CALL lose_instead(VkDevice device, VkSwapchainKHR swapchain, std::uint64_t timeout,
                                            VkSemaphore semaphore, VkFence fence, std::uint32_t* index) {
    if (losses-- > 0) return VK_ERROR_SURFACE_LOST_KHR;
    return acquire(device, swapchain, timeout, semaphore, fence, index);
}

}  // namespace

TEST_CASE("a window whose surface is lost makes another and shows on") {
    if (!can_show()) return;
    using namespace scree::host;
    const Screen screen;
    ::setenv("DISPLAY", screen.name().c_str(), 1);
    const Display display;
    std::vector<std::string> messages;
    const auto device = Device::open({.validation = true,
                                      .window_extensions = display.extensions(),
                                      .on_message = [&](const std::string& message) { messages.push_back(message); }});
    {
        Window window(display, device, "lost", 320, 200);
        CanvasOptions options;
        options.width = window.width();
        options.height = window.height();
        const auto canvas = make_vulkan_canvas(device, {}, options);
        const std::vector<scree::physics::BodyProperties> properties(1);
        const std::vector<scree::physics::Pose> poses(1);
        const std::vector<scree::physics::Velocity> velocities(1);
        canvas->set_tables({properties, poses, velocities});
        const auto shown = [&] {
            window.poll(0);
            window.begin_panel();
            window.end_panel();
            return window.show(*canvas, {});
        };
        REQUIRE(shown());
        auto& vulkan = const_cast<VulkanFunctions&>(device->vk());
        present = std::exchange(vulkan.vkQueuePresentKHR, present_and_lose);
        losses = 1;
        REQUIRE(shown());  // as far as the window knows
        for (int i = 0; i < 5; ++i) REQUIRE(shown());
        acquire = std::exchange(vulkan.vkAcquireNextImageKHR, lose_instead);
        losses = 1;
        REQUIRE_FALSE(shown());
        for (int i = 0; i < 5; ++i) REQUIRE(shown());
    }
    for (const std::string& message : messages) FAIL_CHECK(message);
}

TEST_CASE("without a display view says how to make pictures") {
    for (const char* display : {"env -u DISPLAY -u WAYLAND_DISPLAY", "env -u WAYLAND_DISPLAY DISPLAY=:4711"}) {
        const Outcome outcome = run_scree("view wall", display);
        INFO(outcome.errors);
        REQUIRE(outcome.status == 2);
        REQUIRE(says(outcome.errors, "no display"));
        REQUIRE(says(outcome.errors, "scree run wall --frames"));
        REQUIRE(says(run_scree("view wal", display).errors, "unknown demo \"wal\", nearest: \"wall\""));
    }
}
