// UsdPhysics in .usda: bodies, shapes, masses, joints, filters, units, against values worked out by hand.
#include <cmath>
#include <numbers>

#include "compute/scene/double_quaternion.h"
#include "compute/world.h"
#include "tests/imports/import_case.h"
#include "tests/imports/usd_text.h"

using namespace scree;
using scree::imported::at;
using scree::imported::Case;
using scree::imported::rigid;
using scree::imported::solid;
using scree::imported::usda;

namespace {

const Body& usd_body(const Scene& scene, const std::string& name) {
    for (const Body& body : scene.bodies)
        if (body.name == name) return body;
    FAIL("no body " << name);
    return scene.bodies[0];
}

const float pi = std::numbers::pi_v<float>;

}  // namespace

TEST_CASE("imports: a USD scene in centimetres, z up, comes in metres, y up") {
    Case file;
    const Scene scene = file.load("a.usda", imported::everything_usda).scene;
    CHECK(scene.gravity.y == Approx(-9.81));
    REQUIRE(scene.bodies.size() == 3);
    REQUIRE(scene.joints.size() == 1);
    const Body& ground = usd_body(scene, "/World/ground");
    CHECK(ground.friction == Approx(0.7));
    CHECK(ground.static_friction == Approx(0.9));
    CHECK(ground.restitution == Approx(0.25));
    const auto& plane = std::get<Plane>(ground.shape);
    CHECK(plane.normal.y == Approx(1));
    // Of the samples at -2 and 2 in the stage's time, behind the reference's shift of 2: at 1 they are a quarter of the way back.
    const Body& lid = usd_body(scene, "/World/set/lid");
    CHECK(glm::length(lid.position - vec3(-0.0f, 1.0f, 0.0f)) < 0.4f);
    CHECK(lid.inertial->mass == Approx(2));
    CHECK(lid.inertial->inertia.x == Approx(2 * 0.2 * 0.2 / 6));
    CHECK(lid.velocity.z == Approx(-1));  // along x of a parent that is turned by 90 degrees about z, which is up
    CHECK(lid.angular_velocity.y == Approx(pi / 2));
    CHECK(lid.color->x == Approx(1));
    CHECK(lid.color->z == 0);
    CHECK(lid.filter);
    const Body& wedge = usd_body(scene, "/World/set/wedge");
    CHECK(wedge.inertial->mass == Approx(1000 * 0.3 * 0.3 / 2 * 0.4));
    const auto& hinge = std::get<Hinge>(scene.joints[0].kind);
    CHECK(hinge.turn.limits->lower == Approx(-pi / 4));
    CHECK(hinge.turn.limits->upper == Approx(pi / 2));
    // 1000 kg cm^2/s^2 a degree
    CHECK(hinge.turn.spring->stiffness == Approx(1000 * 1e-4 * 180 / pi));
    CHECK(hinge.turn.spring->damping == Approx(20 * 1e-4 * 180 / pi));
    CHECK(hinge.turn.spring->rest == Approx(pi / 6));
    CHECK(file.noted("/World/set/lid: timeSamples: of transforms are left out but for the start"));
}

TEST_CASE("imports: axes of USD stay as they are with --axes file") {
    Case file;
    ImportOptions options;
    options.axes = ImportedAxes::file;
    const Scene scene = file.load("a.usda", imported::everything_usda, options).scene;
    CHECK(scene.gravity.z == Approx(-9.81));
    CHECK(usd_body(scene, "/World/set/wedge").position.y == Approx(2));
}

TEST_CASE("imports: each shape of USD, along each axis, has the size and mass that its numbers say") {
    Case file;
    const auto mass_of = [&](const std::string& type, const std::string& inside) {
        const Scene scene = checked(file.load("a.usda", usda(rigid(type, "a", inside))).scene);
        return mass_properties(scene.bodies[0]);
    };
    const double ball = 4.0 / 3 * std::numbers::pi;
    CHECK(mass_of("Sphere", "double radius = 0.5").mass == Approx(1000 * ball / 8));
    CHECK(mass_of("Cube", "double size = 0.5").mass == Approx(125));
    CHECK(mass_of("Cube", "").mass == Approx(8000));
    CHECK(mass_of("Capsule", "").mass == Approx(1000 * (ball / 8 + std::numbers::pi / 4)));
    CHECK(mass_of("Cylinder", "").mass == Approx(2000 * std::numbers::pi));
    CHECK(mass_of("Cone", "").mass == Approx(2000 * std::numbers::pi / 3));
    CHECK(mass_of("Sphere", "float3 xformOp:scale = (1, 2, 3)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]").mass ==
          Approx(6000 * ball));
    for (const auto& [axis, along] :
         {std::pair{"X", vec3(1, 0, 0)}, std::pair{"Y", vec3(0, 1, 0)}, std::pair{"Z", vec3(0, 0, 1)}}) {
        const Scene scene =
            file.load("a.usda",
                      usda(rigid("Cone", "a",
                                 "double height = 1\ndouble radius = 0.2\nuniform token axis = \"" + std::string(axis) + "\"")))
                .scene;
        const Body& cone = scene.bodies[0];
        const glm::dquat turn = double_quaternion(cone.orientation);
        INFO(axis);
        CHECK(glm::length(vec3(turn * glm::dvec3(0, 1, 0)) - along) < 1e-6f);
        CHECK(glm::length(cone.position - along * -0.25f) < 1e-6f);  // a quarter of its height below its middle
    }
}

TEST_CASE("imports: masses of USD add up, and those of a body count over those of its parts") {
    Case file;
    const std::string inside =
        "def Cube \"a\" (prepend apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMassAPI\"]) { float "
        "physics:mass = 3\n" +
        at("(-2, 0, 0)") +
        "}\ndef Cube \"b\" (prepend apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMassAPI\"]) { float "
        "physics:density = 1\n" +
        at("(2, 0, 0)") + "}\n";
    const auto body = [&](const std::string& schema, const std::string& says) {
        return file
            .load("a.usda", usda("def Xform \"w\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"" + schema + "]) {\n" + says +
                                 inside + "}"))
            .scene.bodies[0];
    };
    const Body sum = body("", "");
    CHECK(sum.inertial->mass == Approx(11));
    CHECK(sum.inertial->centre.x == Approx((3 * -2 + 8 * 2) / 11.0));
    const Body scaled = body(", \"PhysicsMassAPI\"", "float physics:mass = 22\n");
    CHECK(scaled.inertial->mass == Approx(22));
    CHECK(scaled.inertial->inertia.y == Approx(2 * sum.inertial->inertia.y));
    const Body given =
        body(", \"PhysicsMassAPI\"",
             "float physics:mass = 22\npoint3f physics:centerOfMass = (0, 1, 0)\nfloat3 physics:diagonalInertia = (1, 2, 3)\n"
             "quatf physics:principalAxes = (0.70710678, 0, 0, 0.70710678)\n");
    CHECK(glm::length(given.inertial->centre - vec3(0, 1, 0)) < 1e-6f);
    const Scene whole = checked(Scene{.bodies = {given}});
    CHECK(glm::length(whole.bodies[0].position - vec3(0, 1, 0)) < 1e-6f);
}

TEST_CASE("imports: joints of USD have their kinds, limits, drives and break forces") {
    Case file;
    const std::string two = rigid("Cube", "a", "double size = 1") + rigid("Cube", "b", "double size = 1\n" + at("(2, 0, 0)"));
    const auto joint = [&](const std::string& type, const std::string& schemas, const std::string& inside) {
        const Scene scene = file.load("a.usda", usda(two + "def " + type + " \"j\" (prepend apiSchemas = [" + schemas +
                                                     "]) {\nrel physics:body0 = </a>\nrel physics:body1 = </b>\npoint3f "
                                                     "physics:localPos0 = (1, 0, 0)\npoint3f physics:localPos1 = (-1, 0, 0)\n" +
                                                     inside + "}"))
                                .scene;
        REQUIRE(scene.joints.size() == 1);
        return scene.joints[0];
    };
    const Joint fixed = joint("PhysicsFixedJoint", "", "float physics:breakForce = 50\nfloat physics:breakTorque = 7\n");
    CHECK(std::holds_alternative<Fixed>(fixed.kind));
    CHECK(fixed.break_force == 50);
    CHECK(fixed.break_torque == 7);
    CHECK(!fixed.collide);
    CHECK(fixed.a == 0);
    CHECK(fixed.b == 1);
    CHECK(fixed.anchor_b.x == Approx(-1));
    CHECK(std::holds_alternative<Ball>(joint("PhysicsSphericalJoint", "", "").kind));
    const Joint cone =
        joint("PhysicsSphericalJoint", "",
              "uniform token physics:axis = \"Y\"\nfloat physics:coneAngle0Limit = 30\nfloat physics:coneAngle1Limit = 30\n");
    CHECK(std::get<ConeTwist>(cone.kind).swing == Approx(pi / 6));
    CHECK(glm::length(vec3(double_quaternion(cone.frame_a) * glm::dvec3(1, 0, 0)) - vec3(0, 1, 0)) < 1e-6f);
    const auto rope = std::get<Distance>(joint("PhysicsDistanceJoint", "", "float physics:maxDistance = 3\n").kind);
    CHECK(rope.least == 0);
    CHECK(rope.greatest == 3);
    const Joint slider =
        joint("PhysicsPrismaticJoint", "\"PhysicsDriveAPI:linear\"",
              "uniform token physics:axis = \"Z\"\nfloat physics:lowerLimit = -1\nfloat drive:linear:physics:maxForce = 9\n"
              "float drive:linear:physics:damping = 5\nfloat drive:linear:physics:targetVelocity = 2\nbool "
              "physics:collisionEnabled = 1\n");
    const Axis& slide = std::get<Slider>(slider.kind).slide;
    CHECK(slide.limits->lower == -1);
    CHECK(slide.limits->upper == unlimited);
    CHECK(slide.spring->max_force == 9);
    CHECK(slide.spring->damping == 5);
    CHECK(slide.spring->speed == 2);
    CHECK(slider.collide);
    const auto six = std::get<SixDof>(
        joint("PhysicsJoint", "\"PhysicsLimitAPI:transX\", \"PhysicsLimitAPI:rotY\", \"PhysicsLimitAPI:transZ\"",
              "float limit:transX:physics:low = 1\nfloat limit:transX:physics:high = -1\nfloat limit:rotY:physics:low = -90\n"
              "float limit:rotY:physics:high = 90\nfloat limit:transZ:physics:high = 0.5\n")
            .kind);
    CHECK(six.x.locked);
    CHECK(!six.y.locked);
    CHECK(six.swing_y.limits->lower == Approx(-pi / 2));
    CHECK(six.z.limits->lower == -unlimited);
    // By acceleration: about x through both centres two cubes of 1000 kg move 83.3 kg m^2.
    const Joint driven =
        joint("PhysicsRevoluteJoint", "\"PhysicsDriveAPI:angular\"",
              "uniform token drive:angular:physics:type = \"acceleration\"\nfloat drive:angular:physics:stiffness = 12\n");
    CHECK(std::get<Hinge>(driven.kind).turn.spring->stiffness == Approx(12 * 1000 / 6.0 / 2 * 180 / pi));
    CHECK(file.noted("/j: drive: by acceleration"));
}

TEST_CASE("imports: a joint of USD to the world swings as a pendulum does") {
    Case file;
    const Scene scene =
        file.load("a.usda",
                  usda(rigid("Sphere", "bob", "double radius = 0.05\n" + at("(0.02, -1, 0)")) +
                       "def PhysicsRevoluteJoint \"j\" { rel physics:body1 = </bob>\nuniform token physics:axis = \"Z\"\n"
                       "point3f physics:localPos1 = (-0.02, 1, 0)\n}"))
            .scene;
    World world(scene);
    std::vector<double> crossings;
    for (float before = 1; crossings.size() < 3 && world.time() < 10;) {
        world.step();
        const float x = world.bodies()[0].position.x;
        if ((before > 0) != (x > 0)) crossings.push_back(world.time());
        before = x;
    }
    REQUIRE(crossings.size() == 3);
    const double arm = std::sqrt(1 + 0.0004), inertia = arm * arm + 0.4 * 0.0025;
    CHECK(crossings[2] - crossings[0] == Approx(2 * std::numbers::pi * std::sqrt(inertia / (9.81 * arm))).epsilon(0.02));
}

TEST_CASE("imports: groups and filtered pairs of USD do not meet") {
    Case file;
    const std::string cubes =
        rigid("Cube", "a", "double size = 1") + rigid("Cube", "b", "double size = 1") +
        rigid("Cube", "c", "double size = 1\nrel physics:filteredPairs = [</ground>, </a>]\n", ", \"PhysicsFilteredPairsAPI\"") +
        solid("Plane", "ground", "uniform token axis = \"Y\"");
    const Scene scene =
        file.load("a.usda", usda(cubes + "def PhysicsCollisionGroup \"one\" { rel collection:colliders:includes = </a>\nrel "
                                         "physics:filteredGroups = </two> }\ndef PhysicsCollisionGroup \"two\" { rel "
                                         "collection:colliders:includes = </b> }"))
            .scene;
    const auto meet = [&](const std::string& a, const std::string& b) {
        const Filter x = usd_body(scene, a).filter.value_or(Filter{}), y = usd_body(scene, b).filter.value_or(Filter{});
        return (x.category & y.mask) != 0 && (y.category & x.mask) != 0;
    };
    CHECK(!meet("/a", "/b"));
    CHECK(meet("/a", "/c"));
    CHECK(meet("/b", "/ground"));
    REQUIRE(scene.exclusions.size() == 2);
    for (const Exclusion& one : scene.exclusions) CHECK((scene.bodies[one.a].name == "/c" || scene.bodies[one.b].name == "/c"));
}

TEST_CASE("imports: meshes of USD that stand still stay meshes, and approximations are kept") {
    Case file;
    const auto mesh = [](const std::string& how) {
        return "uniform token physics:approximation = \"" + how +
               "\"\nint[] faceVertexCounts = [3, 3, 3, 3]\nint[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]\n"
               "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]\n";
    };
    const auto shape = [&](const std::string& prim) { return file.load("a.usda", usda(prim)).scene.bodies[0].shape; };
    CHECK(std::holds_alternative<Mesh>(shape(solid("Mesh", "m", mesh("none")))));
    CHECK(std::holds_alternative<Hull>(shape(solid("Mesh", "m", mesh("convexHull")))));
    const Shape box = shape(rigid("Mesh", "m", mesh("boundingCube")));
    REQUIRE(std::holds_alternative<Box>(box));
    CHECK(std::get<Box>(box).half_extents == vec3(0.5f));
    CHECK(std::get<Sphere>(shape(rigid("Mesh", "m", mesh("boundingSphere")))).radius == Approx(std::sqrt(0.75)));
    CHECK(std::holds_alternative<Hull>(shape(rigid("Mesh", "m", mesh("convexHull")))));
    CHECK(file.notes.empty());
    CHECK(std::holds_alternative<Hull>(shape(rigid("Mesh", "m", mesh("meshSimplification")))));
    CHECK(file.noted("/m: approximation: \"meshSimplification\""));
}

TEST_CASE("imports: a concave mesh of USD that moves becomes convex parts") {
    Case file;
    // An L, 1 m thick.
    const auto mesh = [](const std::string& how) {
        return "uniform token physics:approximation = \"" + how +
               "\"\nint[] faceVertexCounts = [6, 6, 4, 4, 4, 4, 4, 4]\nint[] faceVertexIndices = [6, 7, 8, 9, 10, 11, 0, 5, 4, "
               "3, 2, 1, "
               "0, 1, 7, 6, 1, 2, 8, 7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]\n"
               "point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0), "
               "(0, 0, 1), (2, 0, 1), (2, 1, 1), (1, 1, 1), (1, 2, 1), (0, 2, 1)]\n";
    };
    const Body body = file.load("a.usda", usda(rigid("Mesh", "m", mesh("convexDecomposition")))).scene.bodies[0];
    REQUIRE(std::holds_alternative<Compound>(body.shape));
    CHECK(std::get<Compound>(body.shape).parts.size() == 2);
    CHECK(std::get<Compound>(body.shape).skins.size() == 1);
    REQUIRE(body.inertial);
    CHECK(body.inertial->mass == Approx(3 * body.density));
    CHECK(file.noted("/m: approximation: is 2 convex parts"));
    CHECK(std::holds_alternative<Hull>(file.load("a.usda", usda(rigid("Mesh", "m", mesh("convexHull")))).scene.bodies[0].shape));
}

TEST_CASE("imports: a point instancer of USD makes its prototypes' bodies") {
    Case file;
    const Scene scene = file.load("a.usda", usda("def PointInstancer \"rocks\" {\nint[] protoIndices = [0, 1, 0]\npoint3f[] "
                                                 "positions = [(0, 1, 0), (3, 1, 0), (6, 1, 0)]\n"
                                                 "quath[] orientations = [(1, 0, 0, 0), (0.7071, 0, 0, 0.7071), (1, 0, 0, "
                                                 "0)]\nfloat3[] scales = [(1, 1, 1), (1, 1, 1), (2, 2, 2)]\n"
                                                 "int64[] invisibleIds = []\nrel prototypes = [</rocks/ball>, </rocks/brick>]\n" +
                                                 rigid("Sphere", "ball", "double radius = 0.5") +
                                                 rigid("Cube", "brick", "double size = 1") + "}"))
                            .scene;
    REQUIRE(scene.bodies.size() == 3);
    CHECK(scene.bodies[0].name == "/rocks[0]");
    CHECK(std::get<Sphere>(scene.bodies[2].shape).radius == Approx(1));
    CHECK(scene.bodies[1].position == vec3(3, 1, 0));
    CHECK(std::abs(scene.bodies[1].orientation.z) == Approx(std::sqrt(0.5)).epsilon(1e-3));
}

TEST_CASE("imports: what is wrong in a USD file is refused with its place") {
    Case file;
    const auto why = [&](const std::string& prims, const std::string& metadata = "metersPerUnit = 1") {
        return file.refusal("a.usda", usda(prims, metadata));
    };
    const std::string ball = rigid("Sphere", "s", "");
    CHECK(why("def Xform \"x\" {}").find("has neither bodies nor colliders") != std::string::npos);
    CHECK(why(ball, "metersPerUnit = 0").find("metersPerUnit must be") != std::string::npos);
    CHECK(why(ball, "upAxis = \"X\"").find("upAxis must be") != std::string::npos);
    CHECK(why(rigid("Sphere", "s", "double radius = -1")) == "a.usda: /s: radius: must be above 0");
    CHECK(why(rigid("Sphere", "s", "double radius = (1, 2)")) == "a.usda: /s: radius: must be a number");
    CHECK(why(rigid("Plane", "s", "")) == "a.usda: /s: a plane is infinite and cannot move");
    CHECK(why("def Sphere \"s\" {\n  double radius = \n}") == "a.usda:7: expected a value before \"}\"");
    CHECK(why("def Sphere \"s\" {").find("the file ends where a name is due") != std::string::npos);
    CHECK(why(ball + ball) == "a.usda:8: the prim /s is there twice");
    CHECK(why(rigid("Mesh", "m",
                    "point3f[] points = [(0, 0, 0)]\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 0, 7]\n")) ==
          "a.usda: /m: faceVertexIndices: names a point that is not there");
    CHECK(why(rigid("Sphere", "s", "float3 xformOp:scale = (0, 1, 1)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]")) ==
          "a.usda: /s: its transform is flat");
    CHECK(why(rigid("Sphere", "s", "uniform token[] xformOpOrder = [\"xformOp:twirl\"]\nfloat xformOp:twirl = 1"))
              .find("of no kind that is known") != std::string::npos);
    CHECK(why(ball + "def PhysicsFixedJoint \"j\" { rel physics:body0 = </nobody> }") ==
          "a.usda: /j: physics:body0: /nobody is not there");
    std::string deep = ball;
    for (int i = 0; i < 300; ++i) deep = "def \"x\" {" + deep + "}";
    CHECK(why(deep).find("deeper than 100") != std::string::npos);
    CHECK(file.refusal("a.usda", "PK\x03\x04").find("is no USD file") != std::string::npos);
}

TEST_CASE("imports: what USD has and scree has not is noted once, with the first prim's path") {
    Case file;
    file.load("a.usda",
              usda(rigid("Sphere", "s", "", ", \"PhysxParticleAPI\"") + rigid("Sphere", "t", "", ", \"PhysxParticleAPI\"") +
                   "def DistantLight \"sun\" {}\ndef Cube \"prop\" {}\n"));
    CHECK(file.noted("a.usda: /s: PhysxParticleAPI: is left out (and 1 more)"));
    CHECK(file.noted("a.usda: /sun: DistantLight: is left out"));
    CHECK(file.noted("a.usda: /prop: geometry: without PhysicsCollisionAPI is left out"));
    file.load("a.usda",
              usda(rigid("Sphere", "s", "float physxRigidBody:linearDamping = 2\nfloat physxRigidBody:sleepThreshold = 1\n",
                         ", \"PhysxRigidBodyAPI\"")));
    CHECK(file.notes.size() == 1);
    CHECK(file.noted("a.usda: /s: physxRigidBody:sleepThreshold: is left out"));
    ImportOptions strict;
    strict.strict = true;
    CHECK(file.refusal("a.usda", usda(rigid("Sphere", "s", "") + "def DistantLight \"sun\" {}"), strict).find("a.usda: /sun") ==
          0);
}
