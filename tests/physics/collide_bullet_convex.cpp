// Narrowphase of cylinders, cones, hulls and triangles against Bullet: distance and normal in thousands of random
// poses.
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <random>

#include "compute/scene/meshes/mesh.h"
#include "compute/tables/state.h"
#include "shaders/physics/collide/collide_triangle.h"
#include "tests/physics/chance.h"

using namespace scree;
using tests::any_turn;
using tests::between;

namespace {

using Chance = std::mt19937;

vec3 any_point(Chance& chance, float reach) {
    return {between(chance, -reach, reach), between(chance, -reach, reach), between(chance, -reach, reach)};
}

enum Kind { sphere, capsule, box, cylinder, cone, hull, triangle };
const char* const names[] = {"sphere", "capsule", "box", "cylinder", "cone", "hull", "triangle"};

Shape any_shape(Kind kind, Chance& chance) {
    if (kind == sphere) return Sphere{between(chance, 0.2f, 0.6f)};
    if (kind == capsule) return Capsule{between(chance, 0.1f, 0.4f), between(chance, 0.1f, 0.6f)};
    if (kind == box) return Box{{between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f)}};
    if (kind == cylinder) return Cylinder{between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f)};
    if (kind == cone) return Cone{between(chance, 0.3f, 0.6f), between(chance, 0.5f, 1.2f)};
    if (kind == triangle)
        return Mesh{.vertices = {{-1, 0, -0.8f}, {between(chance, -1, 1), between(chance, -0.5f, 0.5f), 1}, {1, 0.2f, -0.7f}},
                    .triangles = {{0, 1, 2}}};
    Hull made;
    for (int k = 0; k < 14; ++k) made.points.push_back(any_point(chance, 0.6f));
    return made;
}

// Bullet's shape; `shift` (m, along y) is the offset from the centre of mass to Bullet's origin.
std::unique_ptr<btConvexShape> bullet_shape(const Shape& shape, float& shift) {
    shift = 0;
    std::unique_ptr<btConvexShape> made;
    if (const auto* s = std::get_if<Sphere>(&shape)) return std::make_unique<btSphereShape>(s->radius);
    if (const auto* s = std::get_if<Capsule>(&shape)) return std::make_unique<btCapsuleShape>(s->radius, 2 * s->half_height);
    if (const auto* s = std::get_if<Box>(&shape))
        made = std::make_unique<btBoxShape>(btVector3(s->half_extents.x, s->half_extents.y, s->half_extents.z));
    if (const auto* s = std::get_if<Cylinder>(&shape))
        made = std::make_unique<btCylinderShape>(btVector3(s->radius, s->half_height, s->radius));
    if (const auto* s = std::get_if<Cone>(&shape)) {
        made = std::make_unique<btConeShape>(s->radius, s->height);
        shift = 0.25f * s->height;
    }
    if (const auto* s = std::get_if<Hull>(&shape)) {
        auto points = std::make_unique<btConvexHullShape>();
        for (const vec3& p : s->points) points->addPoint(btVector3(p.x, p.y, p.z));
        made = std::move(points);
    }
    if (const auto* s = std::get_if<Mesh>(&shape)) {
        const auto corner = [&](std::size_t k) { return btVector3(s->vertices[k].x, s->vertices[k].y, s->vertices[k].z); };
        made = std::make_unique<btTriangleShape>(corner(0), corner(1), corner(2));
    }
    made->setMargin(0);
    return made;
}

struct Verdict {
    bool found = false;
    float separation = 0;  // m
    vec3 normal{0};        // from A to B
};
Verdict judge(const Body& a, const Body& b) {
    btTransform poses[2];
    std::unique_ptr<btConvexShape> shapes[2];
    for (int k = 0; k < 2; ++k) {
        const Body& body = k == 0 ? a : b;
        float shift = 0;
        shapes[k] = bullet_shape(body.shape, shift);
        const vec3 at = body.position + physics::rotate(body.orientation, vec3(0, shift, 0));
        poses[k] = btTransform(btQuaternion(body.orientation.x, body.orientation.y, body.orientation.z, body.orientation.w),
                               btVector3(at.x, at.y, at.z));
    }
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(shapes[0].get(), shapes[1].get(), &simplex, &penetration);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = poses[0];
    input.m_transformB = poses[1];
    btPointCollector collector;
    detector.getClosestPoints(input, collector, nullptr);
    const btVector3 n = collector.m_normalOnBInWorld;
    return {collector.m_hasResult, float(collector.m_distance), vec3(-n.x(), -n.y(), -n.z())};
}

// Two bodies separated or penetrating by a few centimetres: B is moved along the line of centres by Bullet's
// distance.
Scene any_pair(Kind kind_a, Kind kind_b, float apart, Chance& chance) {
    Scene scene;
    scene.bodies.resize(2);
    scene.bodies[0].shape = any_shape(kind_a, chance);
    scene.bodies[1].shape = any_shape(kind_b, chance);
    if (kind_b == triangle) scene.bodies[1].motion = Motion::fixed;
    for (Body& body : scene.bodies) body.orientation = any_turn(chance);
    scene.bodies[0].position = {0.3f, -0.2f, 0.1f};
    const vec3 way = glm::normalize(any_point(chance, 1) + vec3(0, 0, 1e-3f));
    scene.bodies[1].position = scene.bodies[0].position + way * 3.0f;
    scene = checked(scene);
    for (int k = 0; k < 8; ++k) {
        const Verdict now = judge(scene.bodies[0], scene.bodies[1]);
        const float along = glm::dot(now.normal, way);
        if (!now.found || now.separation < apart + 1e-3f || along < 0.1f) break;
        scene.bodies[1].position -= way * ((now.separation - apart) / along * (k < 6 ? 0.9f : 1.0f));
    }
    return scene;
}

// The manifold of the step, where the simpler shape is A.
physics::ManifoldBuffer found(const Scene& scene, float margin) {
    const State state(scene, {}, 128, true);
    const std::uint32_t b = state.properties[1].shape == physics::SHAPE_NONE ? 2 : 1;
    const auto law = b == 1                                               ? physics::collide_convex
                     : state.properties[0].shape == physics::SHAPE_SPHERE ? physics::collide_sphere_triangle
                                                                          : physics::collide_convex_triangle;
    return law(state.properties[0], state.poses[0], state.properties[b], state.poses[b], margin, state.hull_table());
}

struct Tally {
    int cases = 0, missed = 0, off = 0, askew = 0;
    float worst = 0;
};
// The step prefers a face to an edge that is better by up to a hundredth of the thinner body's half width, here 6 mm.
constexpr float preference = 0.006f;

Tally compare(Kind kind_a, Kind kind_b, float apart, int poses, unsigned seed) {
    Chance chance(seed);
    Tally tally;
    for (int k = 0; k < poses; ++k) {
        const Scene scene = any_pair(kind_a, kind_b, apart, chance);
        const Verdict judged = judge(scene.bodies[0], scene.bodies[1]);
        if (!judged.found || std::abs(judged.separation - apart) > 0.02f) continue;
        if (kind_b == triangle) {  // no contacts behind the face and beside the edges
            const auto& form = *std::get<Mesh>(scene.bodies[1].shape).form;
            const vec3 face = physics::rotate(scene.bodies[1].orientation, form.triangles[0].normal);
            const vec3 corner = scene.bodies[1].position +
                                physics::rotate(scene.bodies[1].orientation, std::get<Mesh>(scene.bodies[1].shape).vertices[0]);
            if (glm::dot(-judged.normal, face) < 0.05f || glm::dot(scene.bodies[0].position - corner, face) < 0) continue;
        }
        ++tally.cases;
        const physics::ManifoldBuffer touch = found(scene, 0.5f);
        if (touch.count == 0) {
            ++tally.missed;
            continue;
        }
        const float wrong = std::abs(physics::deepest_of(touch) - judged.separation);
        tally.worst = std::max(tally.worst, wrong);
        tally.off += wrong > preference + 0.001f;
        tally.askew += glm::dot(touch.manifold.normal, judged.normal) < 0.95f;
    }
    return tally;
}

constexpr std::pair<Kind, Kind> kinds[] = {
    {sphere, cylinder},   {sphere, cone},   {sphere, hull},  {capsule, cylinder},  {capsule, cone},     {capsule, hull},
    {box, cylinder},      {box, cone},      {box, hull},     {cylinder, cylinder}, {cylinder, cone},    {cylinder, hull},
    {cone, cone},         {cone, hull},     {hull, hull},    {sphere, triangle},   {capsule, triangle}, {box, triangle},
    {cylinder, triangle}, {cone, triangle}, {hull, triangle}};

}  // namespace

TEST_CASE("Bullet finds the same distance and normal where cylinders, cones, hulls and triangles are apart", "[collide]") {
    for (const auto& [a, b] : kinds) {
        const Tally tally = compare(a, b, 0.03f, 400, 11);
        INFO(names[a] << " and " << names[b] << ": " << tally.cases << " cases, " << tally.missed << " missed, " << tally.off
                      << " off, " << tally.askew << " askew, worst " << tally.worst << " m");
        CHECK(tally.cases > (b == triangle ? 120 : 350));
        CHECK(tally.missed == 0);
        CHECK(tally.off <= tally.cases / 100);
        CHECK(tally.askew <= tally.cases / 50);
    }
}

TEST_CASE("Bullet finds the same depth and normal where cylinders, cones, hulls and triangles overlap a little", "[collide]") {
    for (const auto& [a, b] : kinds) {
        const Tally tally = compare(a, b, -0.02f, 1600, 12);
        INFO(names[a] << " and " << names[b] << ": " << tally.cases << " cases, " << tally.missed << " missed, " << tally.off
                      << " off, " << tally.askew << " askew, worst " << tally.worst << " m");
        CHECK(tally.cases > (b == triangle ? 240 : 800));
        CHECK(tally.missed <= tally.cases / 50);  // beyond the triangle's boundary
        CHECK(tally.off <= tally.cases / 25);
        CHECK(tally.askew <= tally.cases / 25);
    }
}
