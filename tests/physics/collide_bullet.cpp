// Narrowphase against Bullet, and against separating axes in double precision.
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include <catch2/catch.hpp>
#include <memory>

#include "tests/physics/collide_cases.h"

namespace {

using namespace scree::tests;

std::unique_ptr<btConvexShape> bullet_shape(const BodyProperties& properties) {
    if (properties.shape == scree::physics::SHAPE_SPHERE) return std::make_unique<btSphereShape>(properties.size.x);
    if (properties.shape == scree::physics::SHAPE_CAPSULE)
        return std::make_unique<btCapsuleShape>(properties.size.x, 2.0f * properties.size.y);
    auto shape = std::make_unique<btBoxShape>(btVector3(properties.size.x, properties.size.y, properties.size.z));
    shape->setMargin(0.0f);
    return shape;
}
btTransform bullet_pose(const Pose& pose) {
    return btTransform(btQuaternion(pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w),
                       btVector3(pose.position.x, pose.position.y, pose.position.z));
}

struct Verdict {
    bool found = false;
    float separation = 0;  // m
    vec3 normal{0};        // from A to B
};

// Bullet's GJK between the shapes without margins; EPA where they overlap.
Verdict judge_by_gjk(const BodyProperties& a, const Pose& pose_a, const BodyProperties& b, const Pose& pose_b) {
    const auto shape_a = bullet_shape(a);
    const auto shape_b = bullet_shape(b);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(shape_a.get(), shape_b.get(), &simplex, &penetration);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = bullet_pose(pose_a);
    input.m_transformB = bullet_pose(pose_b);
    btPointCollector collector;
    detector.getClosestPoints(input, collector, nullptr);
    const btVector3 n = collector.m_normalOnBInWorld;
    return {collector.m_hasResult, float(collector.m_distance), vec3(-n.x(), -n.y(), -n.z())};
}

struct Deepest : btCollisionWorld::ContactResultCallback {
    Verdict verdict;
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        if (!verdict.found || point.getDistance() < verdict.separation) {
            const float sign = first->getCollisionObject()->getUserIndex() == 0 ? -1.0f : 1.0f;
            const btVector3 n = point.m_normalWorldOnB * sign;
            verdict = {true, float(point.getDistance()), vec3(n.x(), n.y(), n.z())};
        }
        return 0;
    }
};

// Bullet's own algorithm for the pair of shapes, as its world calls it.
class BulletWorld {
public:
    Verdict judge(const BodyProperties& a, const Pose& pose_a, const BodyProperties& b, const Pose& pose_b) {
        const auto shape_a = bullet_shape(a);
        const auto shape_b = bullet_shape(b);
        btCollisionObject body_a, body_b;
        body_a.setCollisionShape(shape_a.get());
        body_b.setCollisionShape(shape_b.get());
        body_a.setWorldTransform(bullet_pose(pose_a));
        body_b.setWorldTransform(bullet_pose(pose_b));
        body_a.setUserIndex(0);
        body_b.setUserIndex(1);
        Deepest result;
        world_.contactPairTest(&body_a, &body_b, result);
        return result.verdict;
    }

private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
};

float degrees_between(vec3 a, vec3 b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

constexpr float margin = 0.05f;  // m

// Two bodies; the second has been moved along a random line until the distance is `gap` (m; negative: penetration).
struct Meeting {
    BodyProperties a, b;
    Pose pose_a, pose_b;
};
bool meet(Chance& chance, const ShapePair& pair, float gap, Meeting& meeting) {
    const vec3 way = chance.direction();
    meeting.a = chance.body(pair.a);
    meeting.b = chance.body(pair.b);
    meeting.pose_a = Pose{{chance.between(-2, 2), chance.between(-2, 2), chance.between(-2, 2)}, 0, chance.orientation()};
    meeting.pose_b = Pose{meeting.pose_a.position + 5.0f * way + 0.5f * chance.direction(), 0, chance.orientation()};
    const float remaining = std::max(gap, 0.001f);
    for (int k = 0; k < 100; ++k) {
        const Verdict apart = judge_by_gjk(meeting.a, meeting.pose_a, meeting.b, meeting.pose_b);
        if (!apart.found || apart.separation < 0.5f * remaining || glm::dot(apart.normal, way) < 0.01f) return false;
        const float step = (apart.separation - remaining) / glm::dot(apart.normal, way);
        meeting.pose_b.position -= way * step;
        if (step < 1e-5f) break;
    }
    meeting.pose_b.position -= way * std::max(-gap, 0.0f);
    return true;
}

// Counts of disagreements between law and judge: distances by more than 1 mm; normals by more than two degrees where
// distances agree.
struct Tally {
    int cases = 0, missed = 0, nearer = 0, farther = 0, askew = 0;
    float worst = 0;  // m
    void count(const ManifoldBuffer& touch, float separation, vec3 normal) {
        ++cases;
        if (touch.count == 0) {
            ++missed;
            return;
        }
        const float excess = deepest_of(touch) - separation;
        worst = std::max(worst, std::abs(excess));
        if (excess < -1e-3f) ++nearer;
        if (excess > 1e-3f) ++farther;
        if (std::abs(excess) <= 1e-3f && degrees_between(touch.manifold.normal, normal) > 2.0f) ++askew;
    }
};

bool has_box_pair(const ShapePair& pair) {
    return pair.a == scree::physics::SHAPE_BOX;
}
bool has_plane(const ShapePair& pair) {
    return pair.b == scree::physics::SHAPE_PLANE;
}

}  // namespace

TEST_CASE("Bullet finds the same distance and normal between round shapes that are apart", "[collide]") {
    for (const ShapePair& pair : all_pairs()) {
        if (has_plane(pair) || has_box_pair(pair)) continue;
        Chance chance(7);
        Tally tally;
        Meeting m;
        for (int k = 0; k < 4000; ++k) {
            if (!meet(chance, pair, chance.between(0.001f, 0.045f), m)) continue;
            const Verdict judge = judge_by_gjk(m.a, m.pose_a, m.b, m.pose_b);
            tally.count(collide(m.a, m.pose_a, m.b, m.pose_b, margin), judge.separation, judge.normal);
        }
        INFO(pair.name << ": " << tally.cases << " cases, worst " << tally.worst << " m");
        REQUIRE(tally.cases > 3500);
        CHECK(tally.missed == 0);
        CHECK(tally.nearer == 0);
        CHECK(tally.farther == 0);
        CHECK(tally.askew == 0);
    }
}

TEST_CASE("Bullet finds the same distance between boxes that are apart, save where edges and corners pass", "[collide]") {
    // Faces are preferred by up to 5 mm, and boxes whose nearest features are beside each other's faces may have no
    // contact yet.
    Chance chance(7);
    Tally tally;
    Meeting m;
    for (int k = 0; k < 10000; ++k) {
        if (!meet(chance, {scree::physics::SHAPE_BOX, scree::physics::SHAPE_BOX, ""}, chance.between(0.001f, 0.045f), m))
            continue;
        const Verdict judge = judge_by_gjk(m.a, m.pose_a, m.b, m.pose_b);
        tally.count(collide(m.a, m.pose_a, m.b, m.pose_b, margin), judge.separation, judge.normal);
    }
    INFO(tally.cases << " cases, missed " << tally.missed << ", farther " << tally.farther << ", askew " << tally.askew);
    REQUIRE(tally.cases > 9000);
    CHECK(tally.nearer == 0);
    CHECK(tally.missed < 0.006 * tally.cases);
    CHECK(tally.farther < 0.005 * tally.cases);
    CHECK(tally.askew < 0.02 * tally.cases);
}

TEST_CASE("Bullet's world finds the same depth and normal where spheres and capsules overlap", "[collide]") {
    BulletWorld world;
    for (const ShapePair& pair : all_pairs()) {
        if (has_plane(pair) || pair.a != scree::physics::SHAPE_SPHERE) continue;
        Chance chance(11);
        Tally tally;
        Meeting m;
        for (int k = 0; k < 4000; ++k) {
            if (!meet(chance, pair, -chance.between(0.001f, 0.3f), m)) continue;
            const Verdict judge = world.judge(m.a, m.pose_a, m.b, m.pose_b);
            // EPA, used when the sphere's centre is inside the box, is not accurate to 1 mm.
            if (!judge.found || judge.separation < -0.95f * m.a.size.x) continue;
            tally.count(collide(m.a, m.pose_a, m.b, m.pose_b, margin), judge.separation, judge.normal);
        }
        INFO(pair.name << ": " << tally.cases << " cases, worst " << tally.worst << " m");
        REQUIRE(tally.cases > 3000);
        CHECK(tally.missed + tally.nearer + tally.farther + tally.askew == 0);
    }
}

TEST_CASE("a capsule that overlaps a capsule or a box is as deep as Bullet or the separating axes say", "[collide]") {
    using namespace scree::physics;
    BulletWorld world;
    for (const uint second : {SHAPE_CAPSULE, SHAPE_BOX}) {
        Chance chance(13);
        Tally shallow;
        int sunk = 0, too_far = 0, too_deep = 0, not_best = 0;
        Meeting m;
        for (int k = 0; k < 8000; ++k) {
            if (!meet(chance, {SHAPE_CAPSULE, second, ""}, -chance.between(0.001f, 0.6f), m)) continue;
            const ManifoldBuffer touch = collide(m.a, m.pose_a, m.b, m.pose_b, margin);
            const Verdict judge = world.judge(m.a, m.pose_a, m.b, m.pose_b);
            // A capsule is a box of zero width, inflated by its radius.
            const auto core = [](const BodyProperties& t) { return t.shape == SHAPE_CAPSULE ? box(0, t.size.y, 0) : t; };
            const float radii = m.a.size.x + (second == SHAPE_CAPSULE ? m.b.size.x : 0.0f);
            if (!judge.found || judge.separation > 0) continue;
            // Bullet's normal is the direction between the cores, which is undefined when they touch.
            if (judge.separation > -0.8f * radii) {
                shallow.count(touch, judge.separation, judge.normal);
            } else if (second == SHAPE_BOX) {
                const scree::tests::Separation truth = separation_by_axes(core(m.a), m.pose_a, m.b, m.pose_b);
                if (truth.greatest > -1e-3) continue;
                ++sunk;
                const double excess = deepest_of(touch) - (truth.greatest - radii);
                if (excess > 5.1e-3) ++too_far;
                if (excess < -5.1e-3) ++too_deep;
                if (std::abs(excess) > 1e-4) ++not_best;
            }
        }
        INFO(shallow.cases << " shallow cases, worst " << shallow.worst << " m; sunk " << sunk << ", not best " << not_best);
        REQUIRE(shallow.cases > 2000);
        CHECK(shallow.missed + shallow.nearer + shallow.farther + shallow.askew == 0);
        if (second == SHAPE_BOX) {
            CHECK(sunk > 500);
            CHECK(too_far + too_deep == 0);
            CHECK(not_best < 0.1 * sunk);
        }
    }
}

TEST_CASE("boxes that overlap are as deep as the separating axes say, to within the preference for faces", "[collide]") {
    BulletWorld world;
    Chance chance(17);
    Meeting m;
    int cases = 0, missed = 0, wrong = 0, not_best = 0, unlike_bullet = 0, clear = 0, askew = 0;
    for (int k = 0; k < 10000; ++k) {
        const float depth = k % 2 == 0 ? chance.between(0.001f, 0.05f) : chance.between(0.05f, 1.0f);
        if (!meet(chance, {scree::physics::SHAPE_BOX, scree::physics::SHAPE_BOX, ""}, -depth, m)) continue;
        const scree::tests::Separation truth = separation_by_axes(m.a, m.pose_a, m.b, m.pose_b);
        if (truth.greatest > 0) continue;
        ++cases;
        const ManifoldBuffer touch = collide(m.a, m.pose_a, m.b, m.pose_b, margin);
        if (touch.count == 0) {
            ++missed;
            continue;
        }
        const double excess = deepest_of(touch) - truth.greatest;
        if (std::abs(excess) > 5.1e-3) ++wrong;
        if (std::abs(excess) > 1e-3) ++not_best;
        const Verdict bullet = world.judge(m.a, m.pose_a, m.b, m.pose_b);
        if (!bullet.found || std::abs(deepest_of(touch) - bullet.separation) > 1e-3f) ++unlike_bullet;
        if (truth.greatest - truth.second > 6e-3) {
            ++clear;
            if (degrees_between(touch.manifold.normal, vec3(truth.axis)) > 2.0f) ++askew;
        }
    }
    INFO(cases << " cases, not best " << not_best << ", unlike Bullet " << unlike_bullet << ", clear " << clear);
    REQUIRE(cases > 8000);
    CHECK(missed == 0);
    CHECK(wrong == 0);
    CHECK(not_best < 0.02 * cases);
    CHECK(unlike_bullet < 0.02 * cases);
    CHECK(clear > 0.8 * cases);
    CHECK(askew == 0);
}
