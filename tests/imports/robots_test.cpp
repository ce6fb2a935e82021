// Robots of files against closed forms: a pendulum's period, a gripper's ratio under load, the weight on four feet, a steering
// linkage.
#include <cmath>
#include <numbers>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

std::filesystem::path file_of(const std::string& name) {
    return std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports" / name;
}
double coordinate(const World& world, std::size_t joint, JointAxis axis) {
    return static_cast<double>(world.joint(joint).coordinates[static_cast<std::size_t>(axis)]);
}
std::size_t named(const Scene& scene, const std::string& name) {
    for (std::size_t j = 0; j < scene.joints.size(); ++j)
        if (scene.joints[j].name == name) return j;
    FAIL("no joint " << name);
    return 0;
}

}  // namespace

TEST_CASE("imports: a free link of a URDF swings with the period of a compound pendulum") {
    Case file;
    // 2 kg, its centre 0.3 m below the axis, 0.05 kg m^2 about it; 0.1 rad off.
    const SceneDocument document = file.load("p.urdf", R"(<robot name="p"><link name="world"/>
<link name="bob"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
  <inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="pivot" type="continuous"><parent link="world"/><child link="bob"/><origin xyz="0 0 1" rpy="0 0.1 0"/>
  <axis xyz="0 1 0"/></joint></robot>)");
    World world(document.scene, {.rate = 240, .sleeping = false});
    std::vector<double> crossings;  // s, of the middle
    double before = coordinate(world, 0, JointAxis::twist);
    const double middle = before - 0.1;
    while (crossings.size() < 9 && world.time() < 20) {
        const double time = world.time();
        world.step();
        const double now = coordinate(world, 0, JointAxis::twist);
        if ((before - middle) * (now - middle) < 0)
            crossings.push_back(time + (world.time() - time) * (middle - before) / (now - before));
        before = now;
    }
    REQUIRE(crossings.size() == 9);
    const double period = 2 * std::numbers::pi * std::sqrt((0.05 + 2 * 0.3 * 0.3) / (2 * 9.81 * 0.3));
    CHECK((crossings[8] - crossings[0]) / 4 == Approx(period * (1 + 0.01 / 16)).epsilon(0.01));
}

TEST_CASE("imports: the fingers of an arm's gripper keep their ratio under load") {
    SceneDocument document = load_scene(file_of("arm.urdf"));
    for (Joint& joint : document.scene.joints)
        if (auto* coupling = std::get_if<Coupling>(&joint.kind)) coupling->joints.at(0).factor *= 2;  // a ratio of its own
    const auto* coupling = std::get_if<Coupling>(&document.scene.joints[6].kind);
    REQUIRE(coupling != nullptr);
    REQUIRE(coupling->joints.size() == 2);
    World arm(document.scene, {.sleeping = false});
    for (std::size_t j = 0; j < 5; ++j) {
        const JointDrive hold{.joint = j,
                              .axis = main_axis(document.scene.joints[j].kind),
                              .stiffness = 1e5f,
                              .damping = 1e3f,
                              .target = j == 4 ? 0.01f : 0.0f};
        arm.set_drives({&hold, 1});
    }
    const auto sum = [&] {
        double all = 0;
        for (const CoupledAxis& one : coupling->joints)
            all += static_cast<double>(one.factor) * coordinate(arm, one.joint, JointAxis::x);
        return all;
    };
    for (int i = 0; i < 300; ++i) {
        const JointForce load{5, JointAxis::x, i % 100 < 50 ? 12.0f : -12.0f};
        arm.apply_joint_forces({&load, 1});
        arm.step();
        if (i > 60) CHECK(sum() == Approx(static_cast<double>(coupling->offset.value_or(0))).margin(1e-5));
    }
    CHECK(std::abs(coordinate(arm, 4, JointAxis::x)) > 1e-3);
}

TEST_CASE("imports: a quadruped's weight stands on its four feet") {
    const SceneDocument document = load_scene(file_of("quadruped.xml"), {.keyframe = "home"});
    const Settings settings = document.settings.value_or(Settings{});
    World world(document.scene, settings);
    world.step(static_cast<int>(3 * settings.rate));
    std::size_t floor = no_body;
    double mass = 0;
    for (std::size_t i = 0; i < world.scene().bodies.size(); ++i) {
        if (std::holds_alternative<Plane>(world.scene().bodies[i].shape)) floor = i;
        if (world.scene().bodies[i].motion == Motion::dynamic)
            mass += static_cast<double>(mass_properties(world.scene().bodies[i]).mass);
    }
    REQUIRE(floor != no_body);
    CHECK(world.contacts_of(floor).size() == 4);
    const double down = -static_cast<double>(world.touch_forces(std::span(&floor, 1)).front().y);
    CHECK(down == Approx(mass * 9.81).epsilon(0.01));
}

TEST_CASE("imports: a steering linkage turns the wheels as its four bars say, and nearly as Ackermann's rule") {
    const SceneDocument document = load_scene(file_of("steering.xml"));
    const Scene& scene = document.scene;
    const std::size_t left = named(scene, "left_kingpin"), right = named(scene, "right_kingpin");
    World world(scene, {.rate = 240, .sleeping = false});
    // Arms of 0.2 m, and the tie rod.
    const double track = 1.2, wheelbase = 2.4, inward = std::atan(0.5 * track / wheelbase), arm = 0.2;
    const double rod = track - 2 * arm * std::sin(inward);
    const auto stretch = [&](double of_left, double of_right) {
        const double ax = -arm * std::cos(of_left + inward), ay = 0.5 * track - arm * std::sin(of_left + inward);
        const double bx = -arm * std::cos(of_right - inward), by = -0.5 * track - arm * std::sin(of_right - inward);
        return std::hypot(ax - bx, ay - by) - rod;
    };
    for (const double asked : {0.2, 0.4, -0.4}) {
        world.set_spring(left, JointAxis::twist, {400, 40, static_cast<float>(asked)});
        world.step(480);
        const double of_left = coordinate(world, left, JointAxis::twist), of_right = coordinate(world, right, JointAxis::twist);
        INFO(asked << ": " << of_left << " " << of_right);
        CHECK(of_left == Approx(asked).margin(0.01));
        double low = of_left - 0.3, high = of_left + 0.3;  // of the right wheel
        const bool rising = stretch(of_left, low) < 0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            ((stretch(of_left, middle) < 0) == rising ? low : high) = middle;
        }
        CHECK(of_right == Approx(low).margin(1e-3));
        // Ackermann: 1 / tan of the outer wheel is that of the inner one and track / wheelbase.
        const double ackermann = std::atan(1 / (1 / std::tan(of_left) + track / wheelbase));
        CHECK(std::abs(of_right - ackermann) < 0.5 * std::abs(of_left - ackermann));
        CHECK(std::abs(of_right - of_left) > 0.01);
    }
}
