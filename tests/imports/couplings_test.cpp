// Couplings of files: mimics of URDF; tendons, equalities of joints and of tendons, and actuators on tendons of MJCF.
#include <cmath>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

double angle(const World& world, std::size_t joint) {
    return static_cast<double>(world.joint(joint).coordinates[3]);
}

std::string link(const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>";
}
std::string revolute(const std::string& name, const std::string& child, const std::string& inside) {
    return "<joint name='" + name + "' type='continuous'><parent link='world'/><child link='" + child + "'/>" +
           "<axis xyz='0 0 1'/>\n" + inside + "</joint>";
}
std::string robot(const std::string& mimic) {
    return "<robot name='r'><link name='world'/>" + link("a") + link("b") + revolute("first", "a", "") +
           revolute("second", "b", mimic) + "</robot>";
}

// Two bodies of unit inertia on hinges about z to the world, 1 m apart.
std::string mjcf(const std::string& rest, const std::string& first = "", const std::string& second = "") {
    const auto body = [](const std::string& name, const std::string& pos, const std::string& more) {
        return "<body pos='" + pos + "'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint name='" + name +
               "' axis='0 0 1' " + more + "/></body>";
    };
    return "<mujoco><compiler angle='radian'/><worldbody>" + body("x", "0 0 0", first) + body("y", "1 0 0", second) +
           "</worldbody>\n" + rest + "</mujoco>";
}

const Settings awake{.sleeping = false};

}  // namespace

TEST_CASE("imports: a joint of a URDF that mimics another follows it, by its multiplier and offset") {
    Case file;
    const SceneDocument document = file.load("r.urdf", robot("<mimic joint='first' multiplier='-2.5' offset='0.3'/>"));
    REQUIRE(document.scene.joints.size() == 3);
    CHECK_FALSE(file.noted("mimic"));
    CHECK(document.scene.joints[2].name == "second mimics first");
    World world(document.scene, awake);
    world.set_spring(0, JointAxis::twist, {50, 10, 2});
    world.step(600);
    CHECK(angle(world, 0) == Approx(2).margin(1e-3));
    CHECK(angle(world, 1) == Approx(-2.5 * angle(world, 0) + 0.3).margin(1e-5));
    const auto says = [&](const std::string& mimic, const std::string& words) {
        const std::string why = file.refusal("r.urdf", robot(mimic));
        INFO(why);
        CHECK(why.find(words) != std::string::npos);
    };
    says("<mimic joint='third'/>", "r.urdf:3: mimic: \"joint\" there is no joint \"third\" with one axis");
    says("<mimic joint='second'/>", "is the joint itself");
    says("<mimic/>", "names no \"joint\"");
    says("<mimic joint='first' multiplier='x'/>", "multiplier");
}

TEST_CASE("imports: an equality of joints in MJCF holds, linear or of the fourth degree, from where each is described") {
    Case file;
    const auto world_of = [&](const std::string& equality, const std::string& first = "", const std::string& second = "") {
        return World(file.load("m.xml", mjcf("<equality>" + equality + "</equality>", first, second)).scene, awake);
    };
    World linear = world_of("<joint joint1='y' joint2='x' polycoef='0.2 -3 0 0 0' solref='0.01 1'/>");
    linear.set_spring(0, JointAxis::twist, {50, 10, 1.5f});
    linear.step(600);
    CHECK(angle(linear, 1) == Approx(0.2 - 3 * angle(linear, 0)).margin(1e-5));
    World curved = world_of("<joint joint1='y' joint2='x' polycoef='0.1 0.5 -1 0.25 0.125'/>", "ref='0.7'", "ref='-0.4'");
    curved.set_spring(0, JointAxis::twist, {50, 10, 0.9f});
    curved.step(600);
    const double q = angle(curved, 0);
    CHECK(q == Approx(0.9).margin(0.02));
    CHECK(angle(curved, 1) == Approx(0.1 + q * (0.5 + q * (-1 + q * (0.25 + q * 0.125)))).margin(1e-5));
    World held = world_of("<joint joint1='y' polycoef='0.6'/>");
    held.step(240);
    CHECK(angle(held, 1) == Approx(0.6).margin(1e-4));
    const auto says = [&](const std::string& equality, const std::string& words) {
        const std::string why = file.refusal("m.xml", mjcf("<equality>" + equality + "</equality>"));
        INFO(why);
        CHECK(why.find(words) != std::string::npos);
    };
    says("<joint joint1='z'/>", "there is no joint \"z\"");
    says("<joint joint2='x'/>", "needs \"joint1\"");
    says("<tendon tendon1='t'/>", "there is no tendon \"t\"");
    says("<distance geom1='x' geom2='y'/>", "scree has no such equality");
}

TEST_CASE("imports: a fixed tendon of MJCF has its limits, spring and friction, is driven by actuators, and equals another") {
    Case file;
    const std::string tendon = "<tendon><fixed name='t' ";
    const std::string of_both = "><joint joint='x' coef='1'/><joint joint='y' coef='-2'/></fixed></tendon>";
    const auto length = [](const World& world) { return angle(world, 0) - 2 * angle(world, 1); };
    const auto push = [](World& world, float torque) {
        for (int i = 0; i < 480; ++i) {
            const JointForce force{0, JointAxis::twist, torque};
            world.apply_joint_forces({&force, 1});
            world.step();
        }
    };
    World limited(file.load("m.xml", mjcf(tendon + "range='-0.25 0.75'" + of_both)).scene, awake);
    REQUIRE(limited.scene().joints.size() == 3);
    push(limited, 4);
    CHECK(length(limited) == Approx(0.75).margin(1e-4));
    CHECK(static_cast<double>(limited.joint(2).coordinates[0]) == Approx(0.75).margin(1e-4));
    push(limited, -4);
    CHECK(length(limited) == Approx(-0.25).margin(1e-4));

    // The length counts the references; at them nothing pulls.
    World sprung(file.load("m.xml", mjcf(tendon + "stiffness='30' damping='3'" + of_both, "ref='0.4'", "ref='0.1'")).scene,
                 awake);
    sprung.step(60);
    CHECK(static_cast<double>(sprung.joint(2).coordinates[0]) == Approx(0.2).margin(1e-5));
    CHECK(length(sprung) == Approx(0).margin(1e-5));
    World pulled(file.load("m.xml", mjcf(tendon + "stiffness='30' damping='3' springlength='1'" + of_both)).scene, awake);
    pulled.step(900);
    CHECK(length(pulled) == Approx(1).margin(1e-3));

    World driven(file.load("m.xml",
                           mjcf(tendon + of_both +
                                "<actuator><position tendon='t' kp='40' kv='6'/></actuator>"
                                "<keyframe><key name='k' ctrl='-0.7'/></keyframe>"),
                           {.keyframe = "k"})
                     .scene,
                 awake);
    driven.step(900);
    CHECK(length(driven) == Approx(-0.7).margin(1e-3));
    World motor(file.load("m.xml", mjcf(tendon + of_both + "<actuator><motor tendon='t' forcerange='-2 2'/></actuator>")).scene,
                awake);
    const JointForce pull{2, JointAxis::x, 1.5f};
    for (int i = 0; i < 60; ++i) {
        motor.apply_joint_forces({&pull, 1});
        motor.step();
    }
    CHECK(static_cast<double>(motor.joint(0).rates[3]) == Approx(1.5).epsilon(1e-3));
    CHECK(static_cast<double>(motor.joint(1).rates[3]) == Approx(-3).epsilon(1e-3));

    const Scene free = file.load("m.xml", mjcf(tendon + of_both)).scene;
    CHECK(free.joints.size() == 2);  // it does nothing

    const std::string two =
        "<tendon><fixed name='s'><joint joint='x' coef='2'/></fixed>"
        "<fixed name='t'><joint joint='y' coef='-1'/></fixed></tendon>";
    World equal(file.load("m.xml", mjcf(two + "<equality><tendon tendon1='s' tendon2='t' polycoef='0.5 3'/></equality>")).scene,
                awake);
    push(equal, 1);
    CHECK(2 * angle(equal, 0) == Approx(0.5 - 3 * angle(equal, 1)).margin(1e-4));
    World curved(file.load("m.xml", mjcf(two + "<equality><tendon tendon1='s' tendon2='t' polycoef='0 1 2'/></equality>")).scene,
                 awake);
    curved.set_spring(1, JointAxis::twist, {50, 10, 0.5f});
    curved.step(600);
    const double l = -angle(curved, 1);
    CHECK(2 * angle(curved, 0) == Approx(l + 2 * l * l).margin(1e-5));

    const auto says = [&](const std::string& rest, const std::string& words) {
        const std::string why = file.refusal("m.xml", mjcf(rest));
        INFO(why);
        CHECK(why.find(words) != std::string::npos);
    };
    says("<tendon><fixed name='t'/></tendon>", "has no joint with a coef other than 0");
    says("<tendon><fixed><joint joint='z' coef='1'/></fixed></tendon>", "there is no joint \"z\"");
    says("<tendon><spatial/></tendon>", "spatial: is not read; scree has fixed tendons");
    says("<actuator><motor tendon='t'/></actuator>", "there is no tendon \"t\"");
    says(
        "<tendon><fixed name='t'><joint joint='x' coef='1'/></fixed><fixed name='t'><joint joint='x' coef='1'/></fixed></tendon>",
        "there are two tendons of this name");
}

TEST_CASE("imports: couplings of axes that several joints of a body share keep their signs") {
    // The second hinge becomes the swing of a joint of six degrees, whose axis may point the other way.
    Case file;
    const std::string body =
        "<mujoco><compiler angle='radian'/><option gravity='0 0 0'/><worldbody><body><inertial pos='0 0 0' mass='1' "
        "diaginertia='1 1 1'/><joint name='pan' axis='0 0 -1'/><joint name='tilt' axis='0 1 0'/></body>"
        "<body pos='2 0 0'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint name='z' axis='0 0 1'/></body></worldbody>"
        "<equality><joint joint1='z' joint2='pan' polycoef='0 -1 0.5 0 0'/></equality></mujoco>";
    World world(file.load("m.xml", body).scene, awake);
    REQUIRE(world.scene().joints.size() == 3);
    world.apply_angular_impulse(0, {0, 0.4f, 0});  // about the file's z, by which pan goes to the negative
    world.step(60);
    const float pan = world.joint(0).coordinates[4], swing = world.joint(0).coordinates[5];
    const double turned = -static_cast<double>(std::abs(pan) > std::abs(swing) ? std::abs(pan) : std::abs(swing));
    CHECK(turned < -0.05);
    CHECK(angle(world, 1) == Approx(-turned + 0.5 * turned * turned).margin(1e-4));
}
