// Ranges, starts and targets of angles beyond half a turn, as files say them.
#include <fstream>
#include <iterator>
#include <numbers>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

constexpr float pi = std::numbers::pi_v<float>;
const Settings awake{.sleeping = false};

std::string arm(const std::string& joint, const std::string& rest = "") {
    return "<mujoco><compiler angle='radian'/><option gravity='0 0 0'/><worldbody><body><joint name='j' axis='0 0 1' " + joint +
           "/><geom type='box' size='0.1 0.05 0.05' pos='0.1 0 0' mass='1.6'/></body></worldbody>" + rest + "</mujoco>";
}
ImportOptions with_keyframe() {
    ImportOptions options{.axes = ImportedAxes::file};
    options.keyframe = "0";
    return options;
}

// Pressed with 0.2 N m either way for five seconds each.
void holds(const Scene& scene, const Limits& limits) {
    World world(scene, awake);
    for (const float torque : {0.2f, -0.2f}) {
        for (int i = 0; i < 300; ++i) {
            const JointForce force{0, JointAxis::twist, torque};
            world.apply_joint_forces({&force, 1});
            world.step();
        }
        CHECK(world.joint(0).coordinates[3] == Approx(torque > 0 ? limits.upper : limits.lower).margin(2e-3));
    }
}

}  // namespace

TEST_CASE("imports: ranges of MJCF beyond half a turn hold and are not cut") {
    for (const auto& [range, limits] :
         {std::pair{"-0.0175 3.7525", Limits{-0.0175f, 3.7525f}}, std::pair{"0 3.141592653589793", Limits{0, pi}},
          std::pair{"-3.141592653589793 0", Limits{-pi, 0}}, std::pair{"-3.49 0.785", Limits{-3.49f, 0.785f}},
          std::pair{"-6.2831853 6.2831853", Limits{-2 * pi, 2 * pi}}}) {
        INFO(range);
        Case file;
        const Scene scene = file.load("a.xml", arm("range='" + std::string(range) + "'")).scene;
        CHECK(file.notes.empty());
        holds(scene, limits);
    }
}

TEST_CASE("imports: limits of URDF at half a turn and beyond hold") {
    for (const auto& [text, limits] : {std::pair{"lower='0' upper='3.14159265'", Limits{0, pi}},
                                       std::pair{"lower='-6.2831853' upper='6.2831853'", Limits{-2 * pi, 2 * pi}}}) {
        INFO(text);
        Case file;
        const std::string robot =
            "<robot name='r'><link name='world'/><link name='a'><inertial><mass value='2'/><inertia ixx='0.01' iyy='0.01' "
            "izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' type='revolute'><axis xyz='0 0 1'/>"
            "<limit " +
            std::string(text) + " effort='0' velocity='100'/><parent link='world'/><child link='a'/></joint></robot>";
        holds(file.load("r.urdf", robot).scene, limits);
    }
}

TEST_CASE("imports: a position actuator of MJCF reaches a target of three quarters of a turn, and stays") {
    Case file;
    const std::string model =
        arm("damping='1'", "<actuator><position joint='j' kp='20'/></actuator><keyframe><key ctrl='4.71'/></keyframe>");
    World world(file.load("a.xml", model, with_keyframe()).scene, awake);
    world.step(300);
    CHECK(world.joint(0).coordinates[3] == Approx(4.71).margin(1e-3));
    CHECK(glm::length(world.body(0).angular_velocity) < 1e-3f);
}

TEST_CASE("imports: a keyframe, and a reference, of MJCF tell the turns at the start") {
    const auto begins_at = [](const std::string& joint, const std::string& place) {
        Case file;
        const std::string key = place.empty() ? "" : "<keyframe><key qpos='" + place + "'/></keyframe>";
        const Scene scene = file.load("a.xml", arm(joint, key), place.empty() ? ImportOptions{} : with_keyframe()).scene;
        return World(scene, awake).joint(0).coordinates[3];
    };
    CHECK(begins_at("range='-1 7.5'", "7") == Approx(7));
    CHECK(begins_at("range='-20 20'", "-15") == Approx(-15));
    CHECK(begins_at("", "9") == Approx(9));
    CHECK(begins_at("range='0 7.5'", "-0.3") == Approx(-0.3));
    CHECK(begins_at("ref='5' range='0 10'", "") == Approx(0).margin(1e-6));  // where the file calls it 5
    CHECK(begins_at("ref='5' range='0 10'", "9.5") == Approx(4.5));
}

TEST_CASE("imports: angular limits and targets of glTF beyond half a turn are kept") {
    std::ifstream file(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports/physics.gltf");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const auto& [was, now] :
         {std::pair{"\"max\": 1.5", "\"max\": 4.25"}, std::pair{"0.5, \"maxForce\"", "3.75, \"maxForce\""}})
        text.replace(text.find(was), std::string(was).size(), now);
    Case written;
    const Scene scene = written.load("a.gltf", text).scene;
    const Axis& turn = std::get<Hinge>(scene.joints.at(0).kind).turn;
    CHECK(turn.limits->lower == -1);
    CHECK(turn.limits->upper == 4.25f);
    CHECK(turn.spring->rest == 3.75f);
}
