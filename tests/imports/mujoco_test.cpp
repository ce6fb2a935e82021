// MuJoCo as the judge of MJCF, where libmujoco-dev is installed: masses, centres, inertias, poses of geoms, the period of a
// hinge. The test reads the file by both.
#ifdef SCREE_JUDGE_MUJOCO
#include <mujoco/mujoco.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

struct Judge {
    explicit Judge(const std::string& path) {
        char error[1000] = "";
        model.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
        INFO(error);
        REQUIRE(model);
        data.reset(mj_makeData(model.get()));
        mj_forward(model.get(), data.get());
    }
    struct Free {
        void operator()(mjModel* of) const { mj_deleteModel(of); }
        void operator()(mjData* of) const { mj_deleteData(of); }
    };
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

glm::dvec3 vector_at(const mjtNum* numbers, int k) {
    return {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
}
glm::dmat3 matrix_at(const mjtNum* numbers, int k) {  // rows in MuJoCo
    glm::dmat3 m;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) m[c][r] = numbers[9 * k + 3 * r + c];
    return m;
}
glm::dmat3 turn_of(vec4 q) {
    return glm::mat3_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
}

void require_near(const glm::dvec3& a, const glm::dvec3& b, double most) {
    INFO(a.x << " " << a.y << " " << a.z << " and " << b.x << " " << b.y << " " << b.z);
    REQUIRE(glm::length(a - b) <= most);
}

struct Summed {
    double mass = 0;
    glm::dvec3 centre{0};
    glm::dmat3 inertia{0};  // about the centre, world axes
};

// Of a body of MuJoCo's and those that are fixed to it, which are one in scree.
Summed summed(const Judge& judge, int body) {
    const mjModel& m = *judge.model;
    Summed all;
    const auto is_of = [&](int other) {
        for (; other != body && other > 0 && m.body_dofnum[other] == 0;) other = m.body_parentid[other];
        return other == body;
    };
    for (int b = body; b < m.nbody; ++b)
        if (is_of(b)) {
            all.mass += m.body_mass[b];
            all.centre += m.body_mass[b] * vector_at(judge.data->xipos, b);
        }
    all.centre /= all.mass;
    for (int b = body; b < m.nbody; ++b) {
        if (!is_of(b)) continue;
        const glm::dmat3 axes = matrix_at(judge.data->ximat, b);
        glm::dmat3 own(0);
        for (int k = 0; k < 3; ++k) own[k][k] = m.body_inertia[3 * b + k];
        const glm::dvec3 d = vector_at(judge.data->xipos, b) - all.centre;
        all.inertia +=
            axes * own * glm::transpose(axes) + m.body_mass[b] * (glm::dmat3(glm::dot(d, d)) - glm::outerProduct(d, d));
    }
    return all;
}

// Compares all bodies that move and, where parts are in the same order, their geoms. Returns how many geoms.
int compare(const std::string& path) {
    const Judge judge(path);
    const Scene said = load_scene(path, ImportOptions{.axes = ImportedAxes::file}).scene;
    const Scene made = checked(said);
    std::map<std::string, std::size_t> named;
    for (std::size_t i = 0; i < made.bodies.size(); ++i) named[made.bodies[i].name] = i;
    int geoms = 0;
    const mjModel& m = *judge.model;
    for (int b = 1; b < m.nbody; ++b) {
        if (m.body_dofnum[b] == 0) continue;
        const std::string name = mj_id2name(&m, mjOBJ_BODY, b);
        INFO(name);
        REQUIRE(named.contains(name));
        const Body& body = made.bodies[named[name]];
        const Summed of = summed(judge, b);
        const MassProperties mass = mass_properties(body);
        REQUIRE(static_cast<double>(mass.mass) == Approx(of.mass).epsilon(1e-5));
        require_near(glm::dvec3(body.position), of.centre, 1e-5);
        glm::dmat3 own(0);
        for (int k = 0; k < 3; ++k) own[k][k] = static_cast<double>(mass.inertia[k]);
        const glm::dmat3 axes = turn_of(body.orientation), inertia = axes * own * glm::transpose(axes);
        const double scale = of.inertia[0][0] + of.inertia[1][1] + of.inertia[2][2];
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) REQUIRE(std::abs(inertia[c][r] - of.inertia[c][r]) <= 1e-5 * scale);
        // Poses of geoms, as the scene says them before its bodies' centres of mass are found.
        const Body& unchecked = said.bodies[named[name]];
        const auto* compound = std::get_if<Compound>(&unchecked.shape);
        std::size_t part = 0;
        for (int g = 0; g < m.ngeom; ++g) {
            if (m.geom_bodyid[g] != b) continue;
            glm::dvec3 at = glm::dvec3(unchecked.position);
            glm::dmat3 turn = turn_of(unchecked.orientation);
            if (compound) {
                REQUIRE(part < compound->parts.size());
                at += turn * glm::dvec3(compound->parts[part].position);
                turn = turn * turn_of(compound->parts[part].orientation);
            }
            ++part, ++geoms;
            INFO("geom " << g);
            if (m.geom_type[g] == mjGEOM_MESH) continue;  // MuJoCo moves them to their centres of mass
            require_near(at, vector_at(judge.data->geom_xpos, g), 1e-5);
            const glm::dmat3 theirs = matrix_at(judge.data->geom_xmat, g);
            const bool round = m.geom_type[g] == mjGEOM_CAPSULE || m.geom_type[g] == mjGEOM_CYLINDER;
            if (round) require_near(turn[1], theirs[2], 1e-5);  // scree's lie along y
            for (int k = 0; k < 3 && !round && m.geom_type[g] != mjGEOM_SPHERE; ++k) require_near(turn[k], theirs[k], 1e-5);
        }
    }
    return geoms;
}

double period_of(const std::vector<double>& times) {
    REQUIRE(times.size() >= 3);
    return (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

}  // namespace

TEST_CASE("imports: MuJoCo has the same masses, centres, inertias and poses of geoms") {
    Case file;
    CHECK(compare(std::string(SCREE_SOURCE_DIR) + "/tests/imports/quadruped.xml") >= 14);
    const std::string path = file.write("bodies.xml", R"(<mujoco>
      <compiler angle="degree" eulerseq="XYZ" exactmeshinertia="true"/>
      <default><default class="heavy"><geom density="7800"/></default></default>
      <asset><mesh name="wedge" scale="0.2 0.3 0.4" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/></asset>
      <worldbody>
        <body name="mixed" pos="1 2 3" euler="10 20 30"><freejoint/>
          <geom type="box" size="0.1 0.2 0.3" pos="0.1 0 0" quat="1 0.2 0.3 0.4"/>
          <geom type="sphere" size="0.2" pos="0 0.5 0" mass="3"/>
          <geom type="capsule" fromto="0 0 0 0.3 0.4 0.5" size="0.05" class="heavy"/>
          <geom type="cylinder" size="0.1 0.2" axisangle="1 1 0 40"/>
          <geom type="ellipsoid" size="0.1 0.2 0.3" xyaxes="0 1 0 -1 0 1"/></body>
        <body name="wedge" pos="-1 0 2" axisangle="0 1 1 70"><freejoint/><geom type="mesh" mesh="wedge" density="500"/></body>
        <body name="given" pos="0 -1 1"><freejoint/><geom size="0.1"/>
          <inertial pos="0.1 0.2 0.3" quat="1 0.5 0 0.2" mass="4" diaginertia="0.3 0.2 0.25"/></body>
        <body name="full" pos="0 -2 1" euler="0 0 45"><freejoint/><geom size="0.1"/>
          <inertial pos="0 0 0.1" mass="4" fullinertia="0.3 0.2 0.25 0.01 -0.02 0.03"/></body>
        <body name="upper" pos="3 0 2"><joint type="hinge" axis="0 1 0" pos="0 0 0.1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.04"/>
          <body name="lower" pos="0 0 -0.4" euler="0 20 0"><joint type="hinge" axis="1 0 0"/>
            <geom type="box" size="0.03 0.04 0.2" pos="0 0 -0.2"/>
            <body pos="0.1 0 -0.4" euler="90 0 0"><geom type="cylinder" size="0.05 0.02"/></body></body></body>
      </worldbody></mujoco>)")
                                 .string();
    CHECK(compare(path) >= 10);
}

TEST_CASE("imports: a hinge swings as long as in MuJoCo") {
    Case file;
    const std::string path = file.write("pendulum.xml", R"(<mujoco><option timestep="0.0005" integrator="RK4"/><worldbody>
      <body name="rod" pos="0 0 2" euler="0 60 0"><joint name="h" type="hinge" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.03"/><geom type="box" size="0.1 0.05 0.1" pos="0 0 -0.6"/></body>
      </worldbody></mujoco>)")
                                 .string();
    const Judge judge(path);
    std::vector<double> theirs, ours;
    for (double before = judge.data->qvel[0]; theirs.size() < 9; before = judge.data->qvel[0]) {
        mj_step(judge.model.get(), judge.data.get());
        const double now = judge.data->qvel[0];
        if (before > 0 && now <= 0) theirs.push_back(judge.data->time - 0.0005 * now / (now - before));
        REQUIRE(judge.data->time < 60);
    }
    SceneDocument document = load_scene(path, ImportOptions{.axes = ImportedAxes::file});
    Settings settings;
    settings.sleeping = false;
    World world(document.scene, settings, 1);
    const double dt = 1.0 / static_cast<double>(settings.rate);
    for (double before = 0; ours.size() < 9;) {
        world.step();
        const double now = static_cast<double>(world.body(0).angular_velocity.y);
        if (before > 0 && now <= 0) ours.push_back(world.time() - dt * now / (now - before));
        before = now;
        REQUIRE(world.time() < 60);
    }
    INFO(period_of(ours) << " s and " << period_of(theirs) << " s");
    CHECK(period_of(ours) == Approx(period_of(theirs)).epsilon(0.005));
}
#endif
