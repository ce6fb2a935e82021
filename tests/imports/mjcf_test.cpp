// MJCF: masses against closed forms, poses, joints, motors, filters; what is noted and what is refused.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;
using scree::imported::mjcf;

namespace {

const ImportOptions as_in_file{.axes = ImportedAxes::file};
constexpr double pi = std::numbers::pi;

// Mass, centre in the world, and inertia tensor in world axes, of a checked body.
struct Measured {
    double mass;
    glm::dvec3 centre;
    glm::dmat3 inertia;
};
Measured measured(const Body& body) {
    const MassProperties of = mass_properties(body);
    const glm::dquat turn(body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z);
    const glm::dmat3 axes = glm::mat3_cast(turn);
    glm::dmat3 own(0);
    for (int k = 0; k < 3; ++k) own[k][k] = static_cast<double>(of.inertia[k]);
    return {static_cast<double>(of.mass), glm::dvec3(body.position), axes * own * glm::transpose(axes)};
}

void require_mass(const std::string& body, double mass, glm::dvec3 centre, glm::dvec3 diagonal, glm::dvec3 products = {}) {
    Case file;
    const Scene scene = checked(file.load("a.xml", mjcf(body), as_in_file).scene);
    INFO(body);
    REQUIRE(scene.bodies.size() == 1);
    const Measured of = measured(scene.bodies[0]);
    CHECK(of.mass == Approx(mass).epsilon(1e-5));
    for (int k = 0; k < 3; ++k) {
        CHECK(of.centre[k] == Approx(centre[k]).margin(1e-5));
        CHECK(of.inertia[k][k] == Approx(diagonal[k]).epsilon(1e-5));
    }
    CHECK(of.inertia[0][1] == Approx(products.x).margin(1e-5 * diagonal.x));
    CHECK(of.inertia[0][2] == Approx(products.y).margin(1e-5 * diagonal.x));
    CHECK(of.inertia[1][2] == Approx(products.z).margin(1e-5 * diagonal.x));
}

}  // namespace

TEST_CASE("imports: masses, centres and inertias of MJCF geoms are those of closed forms") {
    const auto body = [](const std::string& geom) { return "<body pos='1 2 3'><freejoint/>" + geom + "</body>"; };
    const double ball = 4.0 / 3 * pi * 0.027 * 500;
    require_mass(body("<geom size='0.3' density='500'/>"), ball, {1, 2, 3}, glm::dvec3(0.4 * ball * 0.09));
    const double m = 2;
    require_mass(body("<geom type='box' size='0.1 0.2 0.3' mass='2' pos='0 0 1'/>"), m, {1, 2, 4},
                 {m / 3 * 0.13, m / 3 * 0.10, m / 3 * 0.05});
    require_mass(body("<geom type='ellipsoid' size='0.1 0.2 0.3' mass='2'/>"), m, {1, 2, 3},
                 {m / 5 * 0.13, m / 5 * 0.10, m / 5 * 0.05});
    const double across = m * (0.04 / 4 + 0.25 / 3), along = m * 0.04 / 2;
    require_mass(body("<geom type='cylinder' size='0.2 0.5' mass='2'/>"), m, {1, 2, 3}, {across, across, along});
    require_mass(body("<geom type='cylinder' size='0.2 0.5' mass='2' euler='0 90 0'/>"), m, {1, 2, 3}, {along, across, across});
    require_mass(body("<geom type='cylinder' size='0.2' fromto='0 -0.5 0 0 0.5 0' mass='2'/>"), m, {1, 2, 3},
                 {across, along, across});
    const double side = pi * 0.04 * 1.0, caps = 4.0 / 3 * pi * 0.008, total = (side + caps) * 1000;
    require_mass(
        body("<geom type='capsule' size='0.2 0.5'/>"), total, {1, 2, 3},
        {1000 * (side * (0.01 + 0.25 / 3) + caps * (0.4 * 0.04 + 0.25 + 0.75 * 0.5 * 0.2)),
         1000 * (side * (0.01 + 0.25 / 3) + caps * (0.4 * 0.04 + 0.25 + 0.75 * 0.5 * 0.2)), 1000 * (side * 0.02 + caps * 0.016)});
    // A tetrahedron's corners; two boxes with a product of inertia; an explicit inertia, turned by 90 degrees about z.
    require_mass(body("<geom size='0.1' mass='1' pos='1 1 0'/><geom size='0.1' mass='1' pos='-1 -1 0'/>"), 2, {1, 2, 3},
                 {2.008, 2.008, 4.008}, {-2, 0, 0});
    require_mass(body("<inertial pos='0 0 0.5' mass='3' diaginertia='1 2 2.5' quat='1 0 0 1'/><geom size='0.1'/>"), 3,
                 {1, 2, 3.5}, {2, 1, 2.5});
    require_mass(body("<inertial pos='0 0 0' mass='3' fullinertia='1 1.2 1.4 0.1 -0.05 0.02'/>"), 3, {1, 2, 3}, {1, 1.2, 1.4},
                 {0.1, -0.05, 0.02});
}

TEST_CASE("imports: balanceinertia and boundinertia are about the principal moments, however the body is turned") {
    Case file;
    const auto moments = [&](const std::string& compiler, const std::string& diagonal) {
        const std::string model = "<mujoco><compiler " + compiler + "/><worldbody><body><freejoint/><geom size='0.1'/>" +
                                  "<inertial pos='0 0 0' mass='3' quat='1 0 0.41421356 0' diaginertia='" + diagonal +
                                  "'/></body></worldbody></mujoco>";
        const vec3 found = file.load("a.xml", model, as_in_file).scene.bodies.at(0).inertial->inertia;
        std::vector<float> all{found.x, found.y, found.z};
        std::sort(all.begin(), all.end());
        return all;
    };
    for (const float moment : moments("balanceinertia='true'", "1 1 5")) CHECK(moment == Approx(7.0 / 3));
    CHECK(moments("balanceinertia='true'", "1 2 2.5")[0] == Approx(1));
    const std::vector<float> bounded = moments("boundinertia='1.5'", "1 2 2.5");
    CHECK(bounded[0] == Approx(1.5));
    CHECK(bounded[1] == Approx(2));
    CHECK(bounded[2] == Approx(2.5));
}

TEST_CASE("imports: a mesh's mass is of what it encloses, an unjointed body is one with its parent") {
    Case file;
    const std::string model =
        "<mujoco><asset><mesh name='wedge' vertex='0 0 0  1 0 0  0 1 0  0 0 1' face='0 2 1 0 1 3 0 3 2 1 2 3'/></asset>"
        "<worldbody><body><freejoint/><geom type='mesh' mesh='wedge' density='600'/>"
        "<body pos='0 0 3'><geom size='0.1' mass='100'/></body></body></worldbody></mujoco>";
    const Scene scene = checked(file.load("a.xml", model, as_in_file).scene);
    REQUIRE(scene.bodies.size() == 1);
    const Measured of = measured(scene.bodies[0]);
    CHECK(of.mass == Approx(200).epsilon(1e-5));
    CHECK(of.centre.x == Approx(0.125).margin(1e-5));
    CHECK(of.centre.z == Approx(0.5 * 0.25 + 0.5 * 3).margin(1e-5));
}

TEST_CASE("imports: meshes of MJCF lie where refpos, refquat and scale put them, in this order") {
    Case file;
    const std::string corners = "0 0 0  1 0 0  0 1 0  1 1 0  0 0 1  1 0 1  0 1 1  1 1 1";
    file.write(
        "cube.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\n"
        "f 1 5 7 3\nf 2 4 8 6\n");
    const std::string asset = "refpos='1 2 3' refquat='0.8 0 0.6 0' scale='0.5 0.25 -2'";
    const glm::dmat3 back = glm::transpose(glm::mat3_cast(glm::dquat(0.8, 0, 0.6, 0)));
    for (const std::string& mesh : {"<asset><mesh name='m' file='cube.obj' " + asset + "/></asset>",
                                    "<asset><mesh name='m' vertex='" + corners + "' " + asset + "/></asset>",
                                    "<default><mesh " + asset + "/></default><asset><mesh name='m' file='cube.obj'/></asset>",
                                    "<default><default class='c'><mesh " + asset +
                                        "/></default></default><asset><mesh name='m' "
                                        "class='c' file='cube.obj'/></asset>"}) {
        INFO(mesh);
        const Scene scene = file.load("a.xml",
                                      "<mujoco>" + mesh +
                                          "<worldbody><body pos='0 0 7'><freejoint/>"
                                          "<geom type='mesh' mesh='m' density='500'/></body></worldbody></mujoco>",
                                      as_in_file)
                                .scene;
        const Body& body = scene.bodies.at(0);
        CHECK(body.position == vec3(0, 0, 7));
        const auto& points = std::get<Hull>(body.shape).points;
        CHECK(points.size() == 8);
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 at =
                glm::dvec3(0.5, 0.25, -2) * (back * (glm::dvec3(k & 1, k >> 1 & 1, k >> 2) - glm::dvec3(1, 2, 3)));
            double nearest = 1;
            for (const vec3& point : points) nearest = std::min(nearest, glm::length(glm::dvec3(point) - at));
            CHECK(nearest < 1e-5);
        }
        CHECK(mass_properties(checked(scene).bodies[0]).mass == Approx(500 * 0.25));
        CHECK(file.notes.empty());
    }
}

TEST_CASE("imports: a hinge of an MJCF file swings with the period of theory, up turned or not, with armature and without") {
    Case file;
    for (const auto& [axes, armature] :
         {std::pair{ImportedAxes::file, 0.0}, {ImportedAxes::y_up, 0.0}, {ImportedAxes::y_up, 0.4}}) {
        const std::string model =
            "<mujoco><option timestep='0.005'/><worldbody><body pos='0 0 2'><joint axis='0 1 0' pos='0 0 0' armature='" +
            std::to_string(armature) + "'/>" +
            "<geom type='box' size='0.05 0.05 0.5' pos='0 0 -0.5' mass='2'/></body></worldbody>"
            "<keyframe><key name='out' qpos='0.1'/></keyframe></mujoco>";
        const SceneDocument document = file.load("a.xml", model, {.axes = axes, .keyframe = "out"});
        CHECK(file.notes.empty());
        CHECK(document.settings->rate == Approx(200));
        World world(document.scene, *document.settings);
        const double about = 2.0 / 3 * (0.25 + 0.0025) + 2 * 0.25 + armature;  // hinge at the top
        const double wanted = 2 * pi * std::sqrt(about / (2 * 9.81 * 0.5)) * (1 + 0.01 / 16);
        CHECK(world.joint(0).coordinates[3] == Approx(0.1).margin(1e-5));
        double first = -1, last = -1, before = 0.1;
        int crossings = 0;
        for (int i = 1; i < 2400; ++i) {
            world.step();
            const double now = static_cast<double>(world.joint(0).coordinates[3]);
            if ((now < 0) != (before < 0)) {
                last = (i - now / (now - before)) / 200;
                if (first < 0) first = last;
                ++crossings;
            }
            before = now;
        }
        CHECK(2 * (last - first) / (crossings - 1) == Approx(wanted).epsilon(0.005));
    }
}

TEST_CASE("imports: hinges and slides of one body become one joint where they share a frame, else get links between") {
    Case file;
    const auto joints = [&](const std::string& inside) {
        return file.load("a.xml", mjcf("<body>" + inside + "<geom size='0.1'/></body>"), as_in_file).scene;
    };
    const Scene planar =
        joints("<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 0 1'/><joint axis='0 -1 0' range='-10 50'/>");
    REQUIRE(planar.joints.size() == 1);
    const auto& six = std::get<SixDof>(planar.joints[0].kind);
    CHECK(six.twist.limits->lower == Approx(-10 * pi / 180));
    CHECK(int(six.x.locked) + int(six.y.locked) + int(six.z.locked) == 1);
    CHECK((six.swing_y.locked && six.swing_z.locked));
    const Scene universal = joints("<joint axis='0 0 1' range='-10 50'/><joint axis='0 1 0'/>");
    REQUIRE(universal.joints.size() == 1);
    CHECK(std::get<SixDof>(universal.joints[0].kind).swing_y.limits->upper == Approx(50 * pi / 180));
    CHECK(file.notes.empty());
    const Scene apart = joints("<joint axis='0 0 1'/><joint axis='0 1 0' pos='0.5 0 0'/>");
    CHECK(apart.joints.size() == 2);
    CHECK(apart.bodies.size() == 2);
    CHECK(file.noted("bodies of a hundredth of the mass between them"));
    CHECK(std::holds_alternative<Ball>(joints("<joint type='ball'/>").joints[0].kind));
    CHECK(std::holds_alternative<Slider>(joints("<joint type='slide'/>").joints[0].kind));
}

TEST_CASE("imports: two hinges turn as MuJoCo's, the outer first") {
    Case file;
    const std::string model =
        "<mujoco><worldbody><body><joint axis='0 0 1'/><joint axis='0 1 0'/>"
        "<geom type='box' size='0.3 0.2 0.1'/></body></worldbody>"
        "<keyframe><key qpos='0.4 0.7'/></keyframe></mujoco>";
    ImportOptions options = as_in_file;
    options.keyframe = "0";
    World world(file.load("a.xml", model, options).scene);
    const auto at = world.joint(0).coordinates;
    CHECK(at[3] == Approx(0.7).margin(1e-4));
    CHECK(at[4] == Approx(0.4).margin(1e-4));
    CHECK(world.joint(0).gap < 1e-5f);
}

TEST_CASE("imports: actuators become springs, dampers and motors") {
    Case file;
    const auto axis = [&](const std::string& actuator, const std::string& joint = "") {
        const std::string model = "<mujoco><worldbody><body><joint name='j' axis='0 0 1' " + joint +
                                  "/><geom size='0.1'/></body></worldbody><actuator>" + actuator +
                                  "</actuator><keyframe><key ctrl='0.5'/></keyframe></mujoco>";
        ImportOptions options = as_in_file;
        options.keyframe = "0";
        return std::get<Hinge>(file.load("a.xml", model, options).scene.joints[0].kind).turn;
    };
    Axis turn = axis("<position joint='j' kp='50' kv='2' forcerange='-7 7'/>", "damping='1'");
    CHECK(turn.spring->stiffness == 50);
    CHECK(turn.spring->damping == 3);
    CHECK(turn.spring->rest == 0.5f);
    CHECK(turn.spring->max_force == 7);
    turn = axis("<general joint='j' biastype='affine' gainprm='50' biasprm='10 -50 -2' gear='2'/>");
    CHECK(turn.spring->stiffness == 200);
    CHECK(turn.spring->damping == 8);
    CHECK(turn.spring->rest == Approx((50 * 0.5 + 10) * 2 / 200.0));
    turn = axis("<velocity joint='j' kv='4' forcerange='-3 3'/>");
    CHECK(turn.motor->speed == 0.5f);
    CHECK(turn.motor->max_force == 3);
    turn = axis("<motor joint='j' ctrlrange='-1 1'/>");
    CHECK_FALSE(turn.motor);
    CHECK(file.noted("World::apply_joint_forces"));
    CHECK_FALSE(turn.spring);
    turn = axis("<motor joint='j' forcerange='-9 9' gear='2'/>");  // the effort of drives to come
    CHECK(turn.spring->max_force == 18);
    CHECK(turn.spring->stiffness + turn.spring->damping == 0);
    turn = axis("<position joint='j' kp='100' dampratio='1'/>");  // critically damped: 2 sqrt(k I)
    const double inertia = 0.4 * (4.0 / 3 * pi * 1e-3 * 1000) * 0.01;
    CHECK(turn.spring->damping == Approx(2 * std::sqrt(100 * inertia)).epsilon(1e-4));
    turn = axis("<position joint='j' kp='100' dampratio='1'/>", "armature='0.3'");
    CHECK(turn.armature == 0.3f);
    CHECK(turn.spring->damping == Approx(2 * std::sqrt(100 * (inertia + 0.3))).epsilon(1e-4));
    turn = axis("<position joint='j' kp='50' forcerange='-7 7'/>", "frictionloss='1'");
    CHECK(turn.friction == 0);
    CHECK(file.noted("friction: is left out beside a motor of limited force"));
}

TEST_CASE("imports: contype, conaffinity, pairs and exclusions say who collides") {
    Case file;
    const std::string model =
        "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1' contype='1' conaffinity='1'/>"
        "<body name='a'><freejoint/><geom size='0.1' contype='2' conaffinity='1'/></body>"
        "<body name='b' pos='1 0 0'><freejoint/><geom size='0.1' contype='2' conaffinity='1'/></body>"
        "<body name='c' pos='2 0 0'><freejoint/><geom name='c' size='0.1' contype='0' conaffinity='4'/></body>"
        "<body name='d' pos='3 0 0'><freejoint/><geom size='0.1' contype='0' conaffinity='0'/></body></worldbody>"
        "<contact><pair geom1='c' geom2='floor'/><exclude body1='a' body2='b'/></contact></mujoco>";
    const Scene scene = file.load("a.xml", model).scene;
    REQUIRE(scene.bodies.size() == 5);
    const auto meet = [&](std::size_t i, std::size_t j) {
        const Filter a = scene.bodies[i].filter.value_or(Filter{}), b = scene.bodies[j].filter.value_or(Filter{});
        return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
    };
    CHECK(meet(0, 1));
    CHECK_FALSE(meet(1, 2));
    CHECK(meet(0, 3));
    CHECK_FALSE(meet(1, 3));
    CHECK(scene.bodies[4].role == Role::drawn);
    CHECK(scene.exclusions.size() == 1);
    const Filter other;  // what a user adds meets all of them
    for (std::size_t i = 0; i < 4; ++i) CHECK((scene.bodies[i].filter->mask & other.category) != 0);
}

TEST_CASE("imports: defaults, frames, replicas, includes and degrees are as MuJoCo reads them") {
    Case file;
    file.write("part.xml",
               "<mujocoinclude><body name='ball' pos='0 0 5'><freejoint/><geom class='small'/></body></mujocoinclude>");
    const std::string model =
        "<mujoco><compiler angle='degree' eulerseq='zyx'/><default><geom density='2000'/>"
        "<default class='small'><geom size='0.05' type='sphere'/></default></default>"
        "<worldbody><include file='part.xml'/>"
        "<frame pos='1 0 0' euler='90 0 0'><body pos='1 0 0'><freejoint/><geom size='0.1'/></body></frame>"
        "<replicate count='3' offset='0 2 0'><body name='r' pos='0 0 9'><freejoint/><geom size='0.1'/></body></replicate>"
        "</worldbody></mujoco>";
    const Scene scene = file.load("a.xml", model, as_in_file).scene;
    REQUIRE(scene.bodies.size() == 5);
    CHECK(scene.bodies[0].inertial->mass == Approx(4.0 / 3 * pi * 0.05 * 0.05 * 0.05 * 2000));
    CHECK(scene.bodies[1].position.x == Approx(1).margin(1e-6));
    CHECK(scene.bodies[1].position.y == Approx(1).margin(1e-6));
    CHECK(scene.bodies[4].name == "r2");
    CHECK(scene.bodies[4].position.y == 4);
    const Scene turned = file.load("a.xml", model).scene;  // y up
    CHECK(turned.bodies[4].position.y == Approx(9));
    CHECK(turned.bodies[4].position.z == Approx(-4));
    CHECK(turned.gravity.y == Approx(-9.81));
}

TEST_CASE("imports: what an MJCF file has and scree has not is noted once with its line, or refused") {
    Case file;
    file.load("a.xml", mjcf("<light/>\n<body><freejoint/>\n<geom size='0.1' solref='0.1 1' rgba='1 0 0 1'/>\n"
                            "<geom size='0.1' solref='0.1 1' wings='2'/></body>"));
    CHECK(file.noted("a.xml:3: light: is left out"));
    CHECK(file.noted("a.xml:5: geom: solref: is of MuJoCo's contacts; scree has its own (and 1 more)"));
    CHECK(file.noted("a.xml:6: geom: wings: is unknown here and left out"));
    CHECK(file.refusal("a.xml", mjcf("<light/>"), {.strict = true}) ==
          "a.xml:3: light: is left out; no motion depends on it; without --strict it would be a note");
    const auto says = [&](const std::string& text, const std::string& words) {
        const std::string why = file.refusal("a.xml", text);
        INFO(text << " gives " << why);
        CHECK(why.find(words) != std::string::npos);
    };
    says(mjcf("<body>\n<joint/><geom size='0.1 x'/></body>"), "a.xml:4: geom: \"size\" must be 1 to 3 numbers");
    says(mjcf("<body name='b'><joint/></body>"), "a.xml:3: body \"b\": moves, and has no mass");
    says(mjcf("<body><joint axis='0 0 0'/><geom size='1'/></body>"), "\"axis\" has a vector of length 0");
    says(mjcf("<body><joint/><geom type='plane' size='1 1 1'/></body>"), "a plane is infinite and cannot move");
    says(mjcf("<body><geom type='mesh' mesh='m'/></body>"), "there is no mesh \"m\"");
    says(mjcf("<body><composite type='grid'/></body>"), "composite: is not read");
    says("<mujoco><tendon><spatial/></tendon></mujoco>", "spatial: is not read");
    says("<mujoco><option density='1.2'/></mujoco>", "has a fluid all around");
    says("<mujoco><worldbody><include file='../a.xml'/></worldbody></mujoco>", "lies outside of the file's folder");
    says("<mujoco><worldbody><include file='/etc/passwd'/></worldbody></mujoco>", "lies outside of the file's folder");
    says("<mujoco><worldbody></mujoco>", "a.xml:1: an element is closed by another's end tag");
    says("<sdf/>", "a.xml:1: begins with <sdf>; MJCF begins with <mujoco>, URDF with <robot>");
    says(mjcf("<replicate count='1000000'><replicate count='1000000'/></replicate>"), "more than 4000000 elements");
    says("<mujoco><equality><joint joint1='a'/></equality></mujoco>", "there is no joint \"a\"");
    says(mjcf("<body name='small'><freejoint/><geom size='1e-7'/></body>"), "a.xml:3: body \"small\": /shape/sphere/radius");
}

TEST_CASE("imports: a quadruped of an MJCF file stands on its motors") {
    std::vector<std::string> notes;
    const SceneDocument document =
        load_scene(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports/quadruped.xml", {.keyframe = "home"}, &notes);
    REQUIRE(document.scene.joints.size() == 12);
    World world(document.scene, *document.settings);
    std::size_t trunk = 0;
    while (document.scene.bodies[trunk].name != "trunk") ++trunk;
    world.step(250 * 5);
    const BodyState at = world.body(trunk);
    CHECK(at.position.y == Approx(0.312).margin(0.01));  // MuJoCo 2.2.2: 0.3123 m
    CHECK(std::abs(at.position.z) < 0.005f);
    CHECK(glm::length(at.velocity) < 0.01f);
    const float upright = 1 - 2 * (at.orientation.x * at.orientation.x + at.orientation.z * at.orientation.z);
    CHECK(std::abs(upright) < 0.2f);  // the trunk's own axes are those of its inertia; its z axis lies along
}

TEST_CASE("imports: geoms of MJCF have the colours of their materials, but where they have their own") {
    Case file;
    const std::string text =
        "<mujoco><default><material specular='1'/><default class='c'><geom material='red'/></default></default>"
        "<asset><material name='red' rgba='1 0 0 1' texture='t'/><material name='plain'/></asset><worldbody>"
        "<geom size='1' material='red'/><geom size='1' class='c' rgba='0 1 0 1'/><geom size='1' class='c'/>"
        "<geom size='1' material='plain'/></worldbody></mujoco>";
    const Scene scene = file.load("a.xml", text).scene;
    REQUIRE(scene.bodies.size() == 4);
    CHECK(scene.bodies[0].color == vec3(1, 0, 0));
    CHECK(scene.bodies[1].color == vec3(0, 1, 0));
    CHECK(scene.bodies[2].color == vec3(1, 0, 0));
    CHECK_FALSE(scene.bodies[3].color);
    CHECK(file.noted("texture"));
    CHECK(file.refusal("a.xml", mjcf("<geom size='1' material='gold'/>")).find("gold") != std::string::npos);
}
