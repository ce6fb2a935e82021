// URDF: an arm that holds its pose, joints of every type, packages, and what is refused.
#include <cmath>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

const std::string mass = "<inertial><mass value='2'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial>";

std::string robot(const std::string& joint) {
    return "<robot name='r'><link name='world'/>\n<link name='a'>" + mass + "</link>\n<joint name='j' " + joint +
           "<parent link='world'/><child link='a'/></joint></robot>";
}

// A cube of 2 m, binary.
std::string cube_stl() {
    std::string bytes(80, ' ');
    const std::uint32_t count = 12;
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    const int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& face : faces) {
        bytes.append(12, '\0');
        for (const int corner : face)
            for (int k = 0; k < 3; ++k) {
                const float at = (corner >> k & 1) != 0 ? 1.0f : -1.0f;
                bytes.append(reinterpret_cast<const char*>(&at), 4);
            }
        bytes.append(2, '\0');
    }
    return bytes;
}

}  // namespace

TEST_CASE("imports: drives hold an arm of a URDF by its efforts, and it sags beyond them") {
    const auto path = std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports/arm.urdf";
    SceneDocument document = load_scene(path);
    REQUIRE(document.scene.joints.size() == 7);  // with the coupling of the fingers
    const auto axis_of = [&](std::size_t j) { return main_axis(document.scene.joints[j].kind); };
    const auto coordinate = [&](const World& arm, std::size_t j) {
        return std::abs(arm.joint(j).coordinates[static_cast<std::size_t>(axis_of(j))]);
    };
    const auto drive = [&](World& arm) {
        for (std::size_t j = 0; j < 6; ++j) {
            const JointDrive hold{.joint = j, .axis = axis_of(j), .stiffness = 1e5f, .damping = 1e3f};
            arm.set_drives({&hold, 1});
        }
    };
    World arm(document.scene);
    drive(arm);
    arm.step(600);
    for (std::size_t j = 0; j < 6; ++j) {
        INFO(document.scene.joints[j].name);
        CHECK(coordinate(arm, j) < 0.002f);
    }
    CHECK(arm.joint_axis(1, axis_of(1)).spring->max_force == 120);
    for (Joint& joint : document.scene.joints)
        if (auto* hinge = std::get_if<Hinge>(&joint.kind)) hinge->turn.spring->max_force = 1;
    World weak(document.scene);
    drive(weak);
    weak.step(600);
    CHECK(coordinate(weak, 1) > 0.2f);
}

TEST_CASE("imports: a joint of a URDF moves freely until it is driven, then by no more than its effort") {
    Case file;
    const auto slide = [&](const std::string& inside) {
        Scene scene = file.load("r.urdf", robot("type='prismatic'><limit lower='-100' upper='100' effort='6'/>" + inside)).scene;
        scene.gravity = vec3(0);
        return scene;
    };
    const auto rate = [](const World& world) { return world.joint(0).rates[0]; };
    const auto axis = [](const World& world) { return world.joint_axis(0, JointAxis::x); };
    World pushed(slide(""), {.rate = 240});  // 2 kg
    for (int i = 0; i < 120; ++i) {
        const JointForce force{.joint = 0, .axis = JointAxis::x, .force = 10};
        pushed.apply_joint_forces({&force, 1});
        pushed.step();
    }
    CHECK(rate(pushed) == Approx(2.5f).epsilon(1e-3));

    const JointDrive far{.joint = 0, .axis = JointAxis::x, .stiffness = 1e5f, .target = 90};
    World driven(slide(""), {.rate = 240});
    driven.set_drives({&far, 1});
    driven.step(120);
    CHECK(rate(driven) == Approx(1.5f).epsilon(1e-3));

    // Its friction holds until a drive with a limit, or a motor, takes its place.
    World rubbed(slide("<dynamics friction='5'/>"), {.rate = 240});
    CHECK(axis(rubbed).friction == 5);
    CHECK(axis(rubbed).spring->max_force == 6);
    for (int i = 0; i < 120; ++i) {
        const JointForce force{.joint = 0, .axis = JointAxis::x, .force = 10};
        rubbed.apply_joint_forces({&force, 1});
        rubbed.step();
    }
    CHECK(rate(rubbed) == Approx(1.25f).epsilon(1e-3));
    rubbed.set_motor(0, JointAxis::x, {0.5f, 100});
    rubbed.step(60);
    CHECK(rate(rubbed) == Approx(0.5f).epsilon(1e-3));
    rubbed.set_drives({&far, 1});
    CHECK(axis(rubbed).friction == 0);
    CHECK(axis(rubbed).spring->max_force == 6);
    CHECK_FALSE(axis(rubbed).motor);
    CHECK_THROWS_WITH(rubbed.set_motor(0, JointAxis::x, {0.5f, 100}), Catch::Contains("set stiffness and damping to 0"));

    // Passive damping is no actuator: it has no bound, which is told.
    CHECK_FALSE(file.noted("effort or forcerange"));
    World damped(slide("<dynamics damping='40'/>"), {.rate = 240});
    CHECK(file.noted("effort or forcerange: is left out beside stiffness, damping or a motor"));
    CHECK(axis(damped).spring->max_force == unlimited);
    damped.set_velocity(damped.scene().joints[0].b, vec3(8, 0, 0), vec3(0));
    damped.step(12);  // 0.05 s; against 6 N alone it would have 7.85 m/s
    CHECK(rate(damped) == Approx(8 * std::exp(-1.0)).epsilon(0.02));
}

TEST_CASE("imports: joints of every type of URDF become scree's") {
    Case file;
    const auto joint = [&](const std::string& text) { return file.load("r.urdf", robot(text)).scene; };
    CHECK(joint("type='fixed'>").joints.empty());
    CHECK(joint("type='floating'>").bodies[0].motion == Motion::dynamic);
    const Scene turns = joint("type='continuous'><axis xyz='0 0 1'/><dynamics damping='3' friction='2'/>");
    const Axis& turn = std::get<Hinge>(turns.joints[0].kind).turn;
    CHECK_FALSE(turn.limits);
    CHECK(turn.spring->damping == 3);
    CHECK(turn.friction == 2);
    const Scene slides = joint("type='prismatic'><axis xyz='0 0 2'/><limit lower='-1' upper='2' effort='0'/>");
    CHECK(std::get<Slider>(slides.joints[0].kind).slide.limits->upper == 2);
    const Scene plane = joint("type='planar'><axis xyz='0 0 1'/>");
    const auto& six = std::get<SixDof>(plane.joints[0].kind);
    CHECK(int(six.x.locked) + int(six.y.locked) + int(six.z.locked) == 1);
    const Scene held = joint("type='revolute'><limit lower='-1' upper='2' effort='7'/>");
    const Axis& effort = std::get<Hinge>(held.joints[0].kind).turn;
    CHECK_FALSE(effort.motor);
    CHECK(effort.spring->max_force == 7);
    CHECK(effort.spring->stiffness + effort.spring->damping == 0);
}

TEST_CASE("imports: links that are fixed merge, a root is fixed with a note or free, and ground is added below") {
    Case file;
    const std::string two = "<robot name='r'><link name='a'>" + mass +
                            "<collision><geometry><sphere radius='0.5'/></geometry></collision></link>"
                            "<link name='b'>" +
                            mass +
                            "</link><joint name='j' type='fixed'><parent link='a'/><child link='b'/>"
                            "<origin xyz='0 0 1'/></joint></robot>";
    const Scene fixed = file.load("r.urdf", two).scene;
    CHECK(fixed.bodies[0].motion == Motion::fixed);
    CHECK(file.noted("is the root and fixed to the world; --base free lets it move"));
    const Scene scene = checked(file.load("r.urdf", two, {.base = ImportedBase::free, .ground = true}).scene);
    CHECK(file.notes.empty());
    REQUIRE(scene.bodies.size() == 2);
    CHECK(mass_properties(scene.bodies[0]).mass == Approx(4));
    CHECK(scene.bodies[0].position.y == Approx(0.5));
    CHECK(std::get<Plane>(scene.bodies[1].shape).offset == Approx(-0.5));
}

TEST_CASE("imports: a root moves freely if it and what fixed joints join to it have a mass, else it is told") {
    Case file;
    const std::string shape = "<collision><geometry><box size='0.6 0.3 0.2'/></geometry></collision>";
    const auto link = [](const std::string& name, const std::string& inside = "") {
        return "<link name='" + name + "'>" + inside + "</link>";
    };
    const auto joint = [](const std::string& a, const std::string& b, const std::string& type = "fixed") {
        return "<joint name='" + a + b + "' type='" + type + "'><parent link='" + a + "'/><child link='" + b +
               "'/><origin xyz='0 0 0.5'/></joint>";
    };
    struct Base {
        std::string links;
        double mass;
        std::string note;  // where it is free
    };
    const std::vector<Base> bases = {
        {link("a", mass), 2, ""},
        {link("a", shape) + link("b", mass) + joint("a", "b"), 2, ""},
        {link("a") + link("b", mass) + joint("a", "b"), 2, ""},
        {link("a") + link("b", mass) + link("c", mass) + joint("a", "b") + joint("a", "c"), 4, ""},
        {link("a") + link("b") + link("c") + link("d", mass + shape) + joint("a", "b") + joint("b", "c") + joint("c", "d"), 2,
         ""},
        {link("a") + link("b", mass) + joint("a", "b") + link("c", mass) + joint("a", "c", "continuous"), 2, ""},
        {link("a", shape), 36, "link \"a\": inertial: is missing or of 0 kg; its mass is that of its collision shapes"},
        {link("a") + link("b", shape) + joint("a", "b"), 36, "is missing or of 0 kg"},
        {link("a", shape + "<inertial><mass value='3'/></inertial>"), 3, "inertia: is missing or 0"}};
    for (const Base& base : bases) {
        INFO(base.links);
        const std::string text = "<robot name='r'>" + base.links + "</robot>";
        const Scene free = file.load("r.urdf", text, {.base = ImportedBase::free}).scene;
        CHECK(file.notes.size() == (base.note.empty() ? 0 : 1));
        CHECK((base.note.empty() || file.noted(base.note)));
        World world(free);
        const float before = world.body(0).position.y;
        world.step(30);
        CHECK(before - world.body(0).position.y == Approx(1.226).epsilon(0.03));
        CHECK(mass_properties(world.scene().bodies[0]).mass == Approx(base.mass).epsilon(1e-5));
        const Scene usual = file.load("r.urdf", text).scene;
        CHECK(file.noted("link \"a\": is the root and fixed to the world; --base free"));
        CHECK(usual.bodies.at(0).motion == Motion::fixed);
        file.load("r.urdf", text, {.base = ImportedBase::fixed});
        CHECK(file.notes.empty());
    }
    const std::string arm = link("a") + link("b", mass) + joint("a", "b", "continuous");
    CHECK(file.refusal("r.urdf", "<robot name='r'>" + arm + "</robot>", {.base = ImportedBase::free}).find("have no mass") !=
          std::string::npos);
    file.load("r.urdf", "<robot name='r'>" + link("world") + link("b", mass) + joint("world", "b") + "</robot>",
              {.base = ImportedBase::free});
    CHECK(file.noted("is the world by its name: it stays fixed"));
    const Scene afloat = file.load("r.urdf",
                                   "<robot name='r'>" + link("a") + link("b", mass) + link("c", mass) +
                                       joint("a", "b", "floating") + joint("b", "c", "floating") + "</robot>",
                                   {.base = ImportedBase::free})
                             .scene;
    REQUIRE(afloat.bodies.size() == 2);
    CHECK(afloat.bodies[1].position.y == Approx(1));
    CHECK(afloat.joints.empty());
}

TEST_CASE("imports: links of a URDF without inertial properties have those of their collision shapes") {
    Case file;
    const auto link = [&](const std::string& inside) {
        const std::string text = "<robot name='r'><link name='base'/><link name='a'>" + inside +
                                 "<collision><origin xyz='0 0 1'/><geometry><box size='0.6 0.4 0.2'/></geometry></collision>"
                                 "<visual><geometry><sphere radius='3'/></geometry></visual></link><joint name='j' "
                                 "type='continuous'><parent link='base'/><child link='a'/></joint></robot>";
        return *file.load("r.urdf", text, {.axes = ImportedAxes::file}).scene.bodies.at(0).inertial;
    };
    const Inertial shaped = link("");
    CHECK(shaped.mass == Approx(48));
    CHECK(shaped.centre.z == Approx(1));
    CHECK(glm::length(shaped.inertia - 4.0f * vec3(0.2f, 0.4f, 0.52f)) < 1e-4f);
    CHECK(file.noted("at 1000 kg/m^3"));
    const Inertial weighed = link("<inertial><origin xyz='0 0.1 0'/><mass value='12'/></inertial>");
    CHECK(weighed.mass == 12);
    CHECK(weighed.centre.y == Approx(0.1));
    CHECK(glm::length(weighed.inertia - vec3(0.2f, 0.4f, 0.52f)) < 1e-4f);
    CHECK(file.noted("link \"a\": inertia: is missing or 0; it is that of its collision shapes, for its mass"));
    const Inertial whole = link(mass);
    CHECK(whole.mass == 2);
    CHECK(file.notes.empty());
}

TEST_CASE("imports: links of a URDF have the colours of their materials, by name or in place") {
    Case file;
    const std::string box = "<geometry><box size='1 1 1'/></geometry>";
    const std::string text =
        "<robot name='r'><link name='a'><inertial><mass value='1'/></inertial><visual>" + box +
        "<material name='blue'/></visual><collision>" + box + "</collision></link><link name='b'><visual>" + box +
        "<material name='m'><color rgba='1 0.5 0 0.3'/><texture filename='t.png'/></material></visual><collision>" + box +
        "</collision></link><link name='c'><visual>" + box + "<material name='none'/></visual><collision>" + box +
        "</collision></link><material name='blue'><color rgba='0 0 1 1'/></material>" +
        "<joint name='j' type='floating'><parent link='a'/><child link='b'/></joint>" +
        "<joint name='k' type='floating'><parent link='a'/><child link='c'/></joint></robot>";
    const Scene scene = file.load("a.urdf", text, {.base = ImportedBase::free}).scene;
    REQUIRE(scene.bodies.size() == 3);
    CHECK(scene.bodies[0].color == vec3(0, 0, 1));
    CHECK(scene.bodies[1].color == vec3(1, 0.5f, 0));
    CHECK_FALSE(scene.bodies[2].color);
    CHECK(file.noted("no material of this name"));
    CHECK(file.noted("texture"));
    // What stands still are bodies of their own: what is drawn and what collides, both in its colour.
    for (const Body& body : file.load("a.urdf", text).scene.bodies)
        if (body.motion == Motion::fixed) CHECK(body.color == vec3(0, 0, 1));
    CHECK(file.refusal("a.urdf", "<robot name='r'><link name='a'/><material name='x'><color/></material></robot>").find("rgba") !=
          std::string::npos);
}

TEST_CASE("imports: meshes of packages are found beside the file, and nowhere else") {
    Case file;
    const auto with = [](const std::string& mesh) {
        return "<robot name='r'><link name='a'>" + mass + "<collision><geometry><mesh filename='" + mesh +
               "' scale='0.5 0.5 0.5'/></geometry></collision></link></robot>";
    };
    file.write("robot/meshes/cube.stl", cube_stl());
    for (const std::string mesh : {"package://robot/meshes/cube.stl", "meshes/cube.stl"}) {
        const Scene scene = file.load("robot/r.urdf", with(mesh), {.base = ImportedBase::free}).scene;
        CHECK(mass_properties(checked(scene).bodies[0]).mass == Approx(2));
        CHECK(std::get<Hull>(scene.bodies[0].shape).points.size() == 8);
    }
    file.load("robot/urdf/r.urdf", with("package://robot/meshes/cube.stl"));  // the package is the folder above
    CHECK(file.refusal("robot/urdf/r.urdf", with("../meshes/cube.stl")).find("lies outside of the file's folder") !=
          std::string::npos);
    const std::string outside = file.refusal("robot/urdf/r.urdf", with("../meshes/cube.stl"));
    for (const char* way : {"--allow-outside", "allow_outside=True", "--package NAME=DIR", "packages="})
        CHECK(outside.find(way) != std::string::npos);
    file.load("robot/urdf/r.urdf", with("../meshes/cube.stl"), {.allow_outside = true});
    file.load("robot/urdf/r.urdf", with("../meshes/cube.stl"), {.packages = {{"any", (file.folder() / "robot").string()}}});
    for (const std::string scheme : {"package", "model"}) {
        const std::string unknown = file.refusal("robot/r.urdf", with(scheme + "://other/meshes/none.stl"));
        CHECK(unknown.find("the folder of the package \"other\" is not known; give it with --package other=DIR, in Python with "
                           "packages={\"other\": \"DIR\"}") != std::string::npos);
        file.load("robot/r.urdf", with(scheme + "://other/meshes/cube.stl"),
                  {.packages = {{"other", (file.folder() / "robot").string()}}});
    }
    CHECK(file.refusal("robot/r.urdf", with("package://robot/../../../etc/passwd")).find("lies outside") != std::string::npos);
    CHECK(file.refusal("robot/r.urdf", with("none.stl")).find("cannot read") != std::string::npos);
    file.write("robot/r.dae", "<COLLADA/>");
    CHECK(file.refusal("robot/r.urdf", with("r.dae")).find("meshes are read from") != std::string::npos);
    file.write("robot/meshes/cut.stl", cube_stl().substr(0, 300));
    CHECK(file.refusal("robot/r.urdf", with("meshes/cut.stl")).find("it says 12 triangles in 300 bytes") != std::string::npos);
}

TEST_CASE("imports: what is wrong with a URDF is refused with its line") {
    Case file;
    const auto says = [&](const std::string& text, const std::string& words) {
        const std::string why = file.refusal("r.urdf", text);
        INFO(why);
        CHECK(why.find(words) != std::string::npos);
    };
    says(robot("type='revolute'>"), "r.urdf:3: joint \"j\": needs a <limit>");
    says(robot("type='screw'>"), "r.urdf:3: joint \"j\": \"type\" is \"screw\"; known: fixed, revolute");
    says("<robot name='r'/>", "r.urdf:1: robot: has no link");
    says("<robot name='r'><link name='a'/><link name='b'/></robot>", "link \"b\": hangs on no joint, and nor does \"a\"");
    says("<robot name='r'><link name='a'/><joint name='j' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
         "there is no link \"b\"");
    says("<robot name='r'><xacro:macro/></robot>", "is xacro");
    CHECK(file.refusal("r.xml", "<robot name='r'><link name='a'/></robot>").empty());
}

TEST_CASE("imports: a body takes the colour of its OBJ file's material, and does without if the library cannot be read") {
    Case file;
    const std::string corners = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
                      faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    file.write("a.mtl", "newmtl red\nKa 1 1 1\nKd 1 0.25 0 # sRGB\nnewmtl grey\nKd 0.5\nnewmtl other\nKd spectral x.rfl\n");
    const auto color = [&](const std::string& text) {
        const Scene scene = file.load("a.obj", text).scene;
        REQUIRE(scene.bodies.size() == 1);
        return scene.bodies[0].color;
    };
    CHECK(color(corners + "usemtl red\n" + faces) == vec3(1, 0.25f, 0));
    CHECK(color(corners + "usemtl grey\nf 1 2\ng a\nusemtl red\n" + faces) == vec3(1, 0.25f, 0));
    CHECK(color(corners + "g a\nusemtl grey\n" + faces) == vec3(0.5f));
    CHECK_FALSE(file.noted("colours"));
    for (const std::string none : {"", "usemtl other\n", "usemtl missing\n"}) CHECK_FALSE(color(corners + none + faces));
    CHECK_FALSE(color("mtllib none.mtl\n" + corners + "usemtl other\n" + faces));
    CHECK(file.noted("has no colours: "));
    CHECK(file.noted("none.mtl"));
    file.write("a.mtl", "newmtl red\nKd 1 x 0\n");
    CHECK_FALSE(color(corners + "usemtl red\n" + faces));
    CHECK(file.noted("a.mtl: line 2: \"Kd\" needs three finite numbers"));

    // Drawn meshes of a robot bring theirs, which what collides takes; its own material comes before.
    file.write("a.mtl", "newmtl red\nKd 1 0.25 0\n");
    file.write("part.obj", corners + "usemtl red\n" + faces);
    const auto link = [&](const std::string& material) {
        const std::string mesh = "<geometry><mesh filename='part.obj'/></geometry>";
        return file.load("r.urdf", "<robot name='r'><link name='a'><visual>" + mesh + material + "</visual><collision>" + mesh +
                                       "</collision></link></robot>");
    };
    for (const Body& body : link("").scene.bodies) CHECK(body.color == vec3(1, 0.25f, 0));
    for (const Body& body : link("<material name='m'><color rgba='0 0 1 1'/></material>").scene.bodies)
        CHECK(body.color == vec3(0, 0, 1));
}

TEST_CASE("imports: an OBJ file's groups are convex parts, an STL file one body") {
    Case file;
    const std::string faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", later = "f 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
    const std::string obj =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\ng one\n" + faces + "g two\n" + later;
    const Scene parts = checked(file.load("a.obj", obj).scene);
    REQUIRE(parts.bodies.size() == 1);
    CHECK(std::get<Compound>(parts.bodies[0].shape).parts.size() == 2);
    CHECK(mass_properties(parts.bodies[0]).mass == Approx(1000.0 / 3));
    const Scene cube = checked(file.load("cube.stl", cube_stl(), {.ground = true}).scene);
    CHECK(mass_properties(cube.bodies[0]).mass == Approx(8000));
    CHECK(std::get<Plane>(cube.bodies[1].shape).offset == Approx(-1));
    CHECK(
        file.refusal("b.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 z\n").find("b.stl: line 4: a vertex needs") !=
        std::string::npos);
}
