// Allowed includes and forbidden words of each room; see the table of rooms in demos/docs/inside/architecture.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/tree.h"

namespace {

using scree::house::at;
using scree::house::code_files;
using scree::house::Include;
using scree::house::SourceFile;

bool begins(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

// The only folder of compute that may use Vulkan.
bool knows_the_device(const SourceFile& file) {
    return file.in("compute/device/");
}

// Path prefixes that the files of a folder may include. The first matching folder counts.
struct Room {
    std::string folder;
    std::vector<std::string> may_include;
};
const std::vector<Room> rooms = {
    {"shaders/physics/", {"shaders/physics/"}},
    {"shaders/stages/", {"shaders/physics/", "shaders/stages/"}},
    {"shaders/render/", {"shaders/physics/", "shaders/render/"}},
    {"shaders/", {"shaders/"}},
    {"host/tools/", {"host/", "shaders/stages/lib/tables.h"}},
    {"host/", {"host/", "shaders/embedded.h", "shaders/render/"}},
    {"compute/device/", {"compute/", "host/", "shaders/"}},
    // Scene files reference mesh files: this is the only file of the library that reads them.
    {"compute/scene_file/load_scene.cpp", {"compute/", "host/files/"}},
    // Files of other programs name files, too.
    {"compute/scene_file/import/", {"compute/", "host/files/"}},
    // Convex parts of meshes are kept in files.
    {"compute/scene/meshes/decomposition_cache.cpp", {"compute/", "host/files/"}},
    // And checkpoints are files: this is the only one that writes any.
    {"compute/scene_file/checkpoint_file.cpp", {"compute/", "host/files/"}},
    // Within compute, what a step is made of: each folder knows those above it in this list.
    {"compute/parallel/", {"compute/parallel/", "compute/timeline.h"}},
    {"compute/tables/",
     {"compute/tables/", "compute/parallel/", "compute/scene.h", "compute/settings.h", "shaders/physics/", "shaders/stages/"}},
    {"compute/plan/",
     {"compute/plan/", "compute/tables/", "compute/parallel/", "compute/runner.h", "compute/timeline.h", "shaders/physics/"}},
    {"compute/compile/",
     {"compute/compile/", "compute/tables/", "compute/scene/", "compute/scene.h", "compute/settings.h", "shaders/physics/"}},
    {"compute/", {"compute/", "shaders/physics/", "shaders/stages/"}},
    {"demos/", {"demos/", "compute/", "host/", "shaders/physics/"}},
    {"tests/", {"tests/", "demos/", "compute/", "host/", "shaders/"}},
};

// The folders of a room in order: each knows those before it, so that no two know each other.
struct Order {
    std::string room;
    std::vector<std::string> folders;
    bool has_files;  // of its own beside them: the public API of compute, whose world.h counts as one of world

    // Behind the last folder for what is in none of them.
    std::size_t place_of(const std::string& path) const {
        if (path == "compute/world.h") return place_of("compute/world/");
        const std::string folder = path.substr(room.size(), path.find('/', room.size()) - room.size());
        return static_cast<std::size_t>(std::find(folders.begin(), folders.end(), folder) - folders.begin());
    }
    bool is_free(const std::string& path) const {
        return has_files && path != "compute/world.h" && path.find('/', room.size()) == std::string::npos;
    }
};
const std::vector<Order> orders = {
    {"shaders/physics/",
     {"base", "body", "collide", "constraint", "impact", "contact", "joint", "sleep", "continuous", "fracture", "bond",
      "vehicle"},
     false},
    {"compute/",
     {"parallel", "tables", "plan", "schema", "scene", "compile", "cpu", "distributed", "world", "measures", "device",
      "scene_file", "replay"},
     true},
};

std::string upwards(const SourceFile& file, const Include& include) {
    for (const Order& order : orders) {
        if (!file.in(order.room) || !begins(include.path, order.room)) continue;
        if (order.is_free(file.path) || order.is_free(include.path)) continue;
        const std::size_t from = order.place_of(file.path), to = order.place_of(include.path);
        if (from == order.folders.size()) return "in no known folder of " + order.room + ": name it in tests/house/rooms.cpp";
        if (to <= from) continue;
        std::string all;
        for (const std::string& folder : order.folders) all += (all.empty() ? "" : ", ") + folder;
        return order.room + " has an order, in which " + order.folders[from] + " comes before " + include.path +
               ": a file includes its own folder and those before it (" + all + ")";
    }
    return "";
}

std::string wrong_way(const SourceFile& file, const Include& include) {
    if (const std::string wrong = upwards(file, include); !wrong.empty()) return wrong;
    if (file.in("tests/consumer/")) return include.quoted ? "the installed headers are included with <>" : "";
    const bool outside =
        !include.quoted && (include.path.find("vulkan") != std::string::npos || include.path.find("GLFW") != std::string::npos);
    if (outside && !file.in("host/") && !knows_the_device(file) && !file.in("tests/")) return "only host knows Vulkan";
    if (!include.quoted) return "";
    for (const Room& room : rooms) {
        if (!file.in(room.folder)) continue;
        for (const std::string& allowed : room.may_include) {
            if (begins(include.path, allowed)) return "";
        }
        return room.folder + " may not include \"" + include.path + "\"";
    }
    return "belongs to no room";
}

// Words forbidden in a room; some are allowed in comments.
struct Silence {
    std::string folder;
    std::regex word;
    bool even_in_comments;
    std::string why;
};

const std::vector<Silence>& silences() {
    static const std::regex of_libm(
        "std::(a?(sin|cos|tan)h?|atan2|exp2?|log(2|10|1p)?|pow|cbrt|hypot)\\(|glm::(angleAxis|rotate|slerp)\\(");
    static const std::string why_not_libm = "C libraries differ in the last bit, so worlds would (compute/scene/portable_math.h)";
    static const std::vector<Silence> list = {
        {"compute/", of_libm, false, why_not_libm},
        {"demos/scenes/", of_libm, false, why_not_libm},
        {"demos/suite/", of_libm, false, why_not_libm},
        {"shaders/physics/", of_libm, false, why_not_libm},
        {"shaders/physics/", std::regex("\\bgl_"), true, "the laws know no threads"},
        {"shaders/physics/", std::regex("\\bVk[A-Z]"), true, "the laws know no machine"},
        {"compute/", std::regex("\\bVk[A-Z]|\\bVK_|\\bvk[A-Z]"), false, "only the device runner says Vk"},
        {"compute/", std::regex("[Pp]ixel|\\bEGL"), true, "compute draws nothing"},
        {"demos/", std::regex("\\bVk[A-Z]|\\bVK_|\\bvk[A-Z]"), false, "host says Vk"},
        {"host/", std::regex("[Gg]ravity|[Mm]anifold|[Rr]estitution|[Nn]arrowphase"), true, "host knows no physics"},
    };
    return list;
}

}  // namespace

TEST_CASE("house: every include points the right way and is written from the root", "[house]") {
    REQUIRE(code_files().size() > 20);
    for (const SourceFile& file : code_files()) {
        for (const Include& include : scree::house::includes_of(file.text)) {
            const std::string wrong = wrong_way(file, include);
            if (!wrong.empty()) FAIL_CHECK(at(file, include.line, wrong));
        }
    }
    SUCCEED();
}

TEST_CASE("house: no room says what it does not know", "[house]") {
    for (const SourceFile& file : code_files()) {
        for (const Silence& silence : silences()) {
            if (!file.in(silence.folder) || knows_the_device(file)) continue;
            std::istringstream lines(silence.even_in_comments ? file.text
                                                              : scree::house::without_comments_and_strings(file.text));
            std::size_t number = 0;
            for (std::string line; std::getline(lines, line);) {
                ++number;
                if (std::regex_search(line, silence.word)) FAIL_CHECK(at(file, number, silence.why + ": " + line));
            }
        }
    }
    SUCCEED();
}

TEST_CASE("house: every file opens with a sentence that says what it is", "[house]") {
    for (const SourceFile& file : scree::house::source_files()) {
        std::istringstream lines(file.text);
        std::string line, comment;
        const bool hash = file.ends_with(".txt") || file.ends_with(".py") || file.ends_with(".sh");
        std::getline(lines, line);
        if (begins(line, "#!")) std::getline(lines, line);
        const bool c = begins(line, "/* ");  // of headers and programs in C
        for (; begins(line, hash ? "# " : c ? "/* " : "// "); std::getline(lines, line)) comment += line + " ";
        if (comment.find_first_of(".:") == std::string::npos) FAIL_CHECK(at(file, 1, "opens with no sentence"));
    }
    SUCCEED();
}

TEST_CASE("house: the rules themselves tell right from wrong", "[house]") {
    const auto verdict = [](const std::string& path, const std::string& include) {
        return wrong_way({path, ""}, scree::house::includes_of("#include " + include + "\n").at(0)).empty();
    };
    CHECK(verdict("compute/world/world.cpp", "\"shaders/physics/base/records.h\""));
    CHECK(verdict("compute/device/device_runner.cpp", "\"host/vulkan/buffer.h\""));
    CHECK(verdict("demos/main.cpp", "\"host/canvas/canvas.h\""));
    CHECK_FALSE(verdict("compute/world/world.cpp", "\"host/vulkan/buffer.h\""));
    CHECK_FALSE(verdict("compute/tables/state.cpp", "\"compute/compile/scene_compiler.h\""));
    CHECK_FALSE(verdict("compute/plan/plan.cpp", "\"compute/cpu/stages.h\""));
    CHECK_FALSE(verdict("compute/world/world.cpp", "\"world.h\""));
    CHECK_FALSE(verdict("compute/world/world.cpp", "<vulkan/vulkan.h>"));
    CHECK_FALSE(verdict("host/canvas.cpp", "\"compute/world.h\""));
    CHECK_FALSE(verdict("shaders/physics/contact/contact.h", "\"compute/scene.h\""));
    CHECK(verdict("shaders/physics/contact/contact_solver.h", "\"shaders/physics/impact/restitution.h\""));
    CHECK_FALSE(verdict("shaders/physics/impact/restitution.h", "\"shaders/physics/contact/contact_solver.h\""));
    CHECK_FALSE(verdict("shaders/physics/collide/grid.h", "\"shaders/physics/sleep/sleep.h\""));
    CHECK_FALSE(verdict("shaders/physics/extra/wind.h", "\"shaders/physics/base/records.h\""));
    CHECK(verdict("compute/scene_file/scene_json.cpp", "\"compute/schema/scene.h\""));
    CHECK_FALSE(verdict("compute/schema/scene.h", "\"compute/scene_file/scene_json.h\""));
    CHECK_FALSE(verdict("compute/cpu/joints.cpp", "\"compute/world/states/state_bytes.h\""));
    CHECK_FALSE(verdict("compute/cpu/joints.cpp", "\"compute/world.h\""));
    CHECK_FALSE(verdict("compute/fields/body.h", "\"compute/world/states/state_bytes.h\""));
    CHECK(upwards({"compute/cpu/joints.cpp", ""}, {"compute/world.h", true, 1}).find("cpu comes before compute/world.h") !=
          std::string::npos);
    CHECK_FALSE(verdict("demos/main.cpp", "\"tests/house/tree.h\""));
    CHECK(scree::house::without_comments("a /* b\n */ c // d") == "a     \n    c     ");
    CHECK(scree::house::without_comments_and_strings("a \"//\" '\"' b") == "a \"  \" ' ' b");
}
