// Time of impact of two bodies moving through a step, against closed forms.
#include "shaders/physics/continuous/time_of_impact.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shaders/physics/collide/grid.h"
#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

constexpr float touch = 0.002f;  // m

BodyProperties properties_of(uint shape, vec3 size) {
    BodyProperties properties{};
    properties.shape = shape;
    properties.size = size;
    return properties;
}
Pose pose_at(vec3 position, vec4 orientation = vec4(0, 0, 0, 1)) {
    return {position, 0, orientation};
}
vec4 turn_about_z(float angle) {
    return {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
}
MotionPath still(const BodyProperties& properties, const Pose& pose) {
    return path_of(properties, pose.position, pose.orientation, pose, 1);
}
MotionPath from_to(const BodyProperties& properties, const Pose& start, const Pose& end, float until = 1) {
    return path_of(properties, start.position, start.orientation, end, until);
}

Parameters parameters() {
    Parameters p{};
    p.speculative = 10 * touch;
    return p;
}
constexpr Nearing whole_step{0, 1};
Impact meet(const BodyProperties& a, const MotionPath& course_a, const BodyProperties& b, const MotionPath& course_b) {
    return impact_of(a, course_a, b, course_b, whole_step, NO_HIT, limits_of(a, b, NO_CONTACT, parameters()), false, Hulls{});
}

const BodyProperties ball = properties_of(SHAPE_SPHERE, vec3(0.1f, 0, 0));
const BodyProperties ground = properties_of(SHAPE_PLANE, vec3(0, 1, 0));
const BodyProperties wall = properties_of(SHAPE_BOX, vec3(0.025f, 2, 2));

}  // namespace

TEST_CASE("a ball meets a plane, a wall and a ball where the way to it ends") {
    const auto at = [](float way, float gap) { return Approx((gap - touch) / way).margin(0.1f * touch / way); };
    const MotionPath down = from_to(ball, pose_at({0, 1, 0}), pose_at({0, -4, 0}));
    REQUIRE(meet(ball, down, ground, still(ground, pose_at(vec3(0)))).fraction == at(5, 0.9f));
    const MotionPath across = from_to(ball, pose_at({-1, 0.3f, 0}), pose_at({4, 0.3f, 0}));
    const Impact front = meet(ball, across, wall, still(wall, pose_at(vec3(0))));
    REQUIRE(front.fraction == at(5, 1 - 0.125f));
    REQUIRE(front.normal.x == Approx(1));
    REQUIRE(meet(wall, still(wall, pose_at(vec3(0))), ball, across).normal.x == Approx(-1));
    const MotionPath towards = from_to(ball, pose_at({4, 0.3f, 0}), pose_at({-1, 0.3f, 0}));
    REQUIRE(meet(ball, across, ball, towards).fraction == at(10, 4.8f));
}

TEST_CASE("two balls that meet off centre touch when their centres are that near") {
    const MotionPath across = from_to(ball, pose_at({-2, 0.1f, 0}), pose_at({3, 0.1f, 0}));
    const Impact impact = meet(ball, across, ball, still(ball, pose_at(vec3(0))));
    const float reach = std::sqrt(0.202f * 0.202f - 0.1f * 0.1f);
    REQUIRE(impact.fraction == Approx((2 - reach) / 5).margin(1e-3));
    REQUIRE(impact.normal.y == Approx(-0.1f / 0.202f).margin(2e-3));
}

TEST_CASE("what flies past or away is not stopped, and what already touches goes on") {
    const MotionPath past = from_to(ball, pose_at({-2, 0.105f, 0}), pose_at({3, 0.105f, 0}));
    const BodyProperties small = properties_of(SHAPE_BOX, vec3(0.2f, 0.001f, 0.2f));
    REQUIRE(meet(ball, past, small, still(small, pose_at(vec3(0)))).fraction == NO_HIT);
    const MotionPath away = from_to(ball, pose_at({-0.2f, 0, 0}), pose_at({-5, 0, 0}));
    REQUIRE(meet(ball, away, wall, still(wall, pose_at(vec3(0)))).fraction == NO_HIT);
    const MotionPath along = from_to(ball, pose_at({-3, 0.1005f, 0}), pose_at({3, 0.0995f, 0}));
    REQUIRE(meet(ball, along, ground, still(ground, pose_at(vec3(0)))).fraction == NO_HIT);
    const MotionPath into = from_to(ball, pose_at({0, 0.1f, 0}), pose_at({0, -3, 0}));
    REQUIRE(meet(ball, into, ground, still(ground, pose_at(vec3(0)))).fraction < 0.01f);
}

TEST_CASE("a long box that turns strikes the ground with its end") {
    const BodyProperties rod = properties_of(SHAPE_BOX, vec3(1, 0.05f, 0.05f));
    // The centre is fixed at 0.6 m; the lower vertex is at 0.6 - sin a - 0.05 cos a.
    for (const float whole : {0.8f, 1.2f}) {
        const MotionPath turning = from_to(rod, pose_at({0, 0.6f, 0}), pose_at({0, 0.6f, 0}, turn_about_z(whole)));
        const Impact impact = meet(rod, turning, ground, still(ground, pose_at(vec3(0))));
        REQUIRE(impact.fraction < 1);
        const Pose at = pose_along_path(turning, impact.fraction);
        const float angle = 2 * std::atan2(at.orientation.z, at.orientation.w);
        REQUIRE(0.6f - std::sin(angle) - 0.05f * std::cos(angle) == Approx(touch).margin(0.12f * touch));
    }
    const MotionPath not_far = from_to(rod, pose_at({0, 0.6f, 0}), pose_at({0, 0.6f, 0}, turn_about_z(0.5f)));
    REQUIRE(meet(rod, not_far, ground, still(ground, pose_at(vec3(0)))).fraction == NO_HIT);
}

TEST_CASE("who follows a stopped body is stopped behind it") {
    const MotionPath ahead = from_to(ball, pose_at({1, 0, 0}), pose_at({6, 0, 0}), 0.1f);  // path ends at 1.5
    const MotionPath behind = from_to(ball, pose_at({0, 0, 0}), pose_at({5, 0, 0}));
    REQUIRE(meet(ball, behind, ball, ahead).fraction == Approx((1.3f - touch) / 5).margin(1e-4));
    const MotionPath free_ahead = from_to(ball, pose_at({1, 0, 0}), pose_at({6, 0, 0}));
    REQUIRE(meet(ball, behind, ball, free_ahead).fraction == NO_HIT);
}

TEST_CASE("no ways of random bodies through each other are missed, and none is stopped inside") {
    tests::Noise noise(5);
    const BodyProperties kinds[] = {ball, properties_of(SHAPE_CAPSULE, vec3(0.05f, 0.2f, 0)),
                                    properties_of(SHAPE_BOX, vec3(0.2f, 0.02f, 0.1f))};
    int met = 0, late = 0;
    for (int i = 0; i < 3000; ++i) {
        const BodyProperties &a = kinds[i % 3], &b = kinds[i / 3 % 3];
        const auto some = [&] {
            const vec3 place = noise.vector();
            return pose_at(place, unit_quaternion(vec4(noise.vector(), 1.1f)));
        };
        const Pose starts[2] = {some(), some()}, ends[2] = {some(), some()};
        if (distance_between_shapes(a, starts[0], b, starts[1], 1e30f, Hulls{}).distance < 2 * touch) continue;
        const MotionPath ca = from_to(a, starts[0], ends[0]), cb = from_to(b, starts[1], ends[1]);
        const float fraction = meet(a, ca, b, cb).fraction;
        met += fraction < 1;
        float least = 1e30f;
        const float last = smaller(fraction, 1.0f);
        for (int k = 0; k <= 200; ++k) {
            const float t = last * static_cast<float>(k) / 200;
            least = smaller(
                least, distance_between_shapes(a, pose_along_path(ca, t), b, pose_along_path(cb, t), 1e30f, Hulls{}).distance);
        }
        CAPTURE(i, fraction);
        REQUIRE(least > -1.1f * limits_of(a, b, NO_CONTACT, parameters()).slop);
        late += fraction < 1 && least < 0.9f * touch;  // out of iterations between touching and penetrating
    }
    REQUIRE(met > 100);
    REQUIRE(late < 0.03 * met);
}

TEST_CASE("what was stopped is not stopped at the same place in the next step") {
    tests::Noise noise(6);
    const BodyProperties kinds[] = {ball, properties_of(SHAPE_CAPSULE, vec3(0.05f, 0.2f, 0)),
                                    properties_of(SHAPE_BOX, vec3(0.2f, 0.02f, 0.1f))};
    int met = 0;
    for (int i = 0; i < 3000; ++i) {
        const bool falls = i % 2 == 1;
        const BodyProperties &a = kinds[i % 3], &b = falls ? ground : kinds[i / 3 % 3];
        const auto some = [&] {
            const vec3 place = noise.vector();
            return pose_at(place, unit_quaternion(vec4(noise.vector(), 1.1f)));
        };
        const auto above = [&](Pose pose) { return pose_at(pose.position + vec3(0, falls ? 2 : 0, 0), pose.orientation); };
        const Pose a_from = above(some()), a_to = some(), b_from = some(), b_to = some();
        const MotionPath ca = from_to(a, a_from, a_to);
        const MotionPath cb = falls ? still(ground, pose_at(vec3(0))) : from_to(b, b_from, b_to);
        const float first = meet(a, ca, b, cb).fraction;
        if (first >= 1) continue;
        ++met;
        const auto on = [&](const BodyProperties& properties, const MotionPath& course) {
            const Pose at = pose_along_path(course, first);
            return from_to(properties, at, pose_at(at.position + course.way, unit_quaternion(at.orientation + course.turn)));
        };
        CAPTURE(i, first);
        for (const uint hold : {NO_CONTACT, IN_CONTACT, CONTACT_LOST})
            REQUIRE(impact_of(a, on(a, ca), b, on(b, cb), whole_step, NO_HIT, limits_of(a, b, hold, parameters()), false, Hulls{})
                        .fraction > 0);
    }
    REQUIRE(met > 300);
}

TEST_CASE("what is driven out of the bounds of its neighbours' search is stopped where it leaves them") {
    REQUIRE(part_within(1, 0, 0, 2) == 1);
    REQUIRE(part_within(-1, 0, 0.25f, 2) == Approx(0.25f));
    REQUIRE(part_within(4, 0, 0, 1) == Approx(0.25f));
    REQUIRE(part_within(3, 1, 0, 1) == Approx(0.25f));
    REQUIRE(part_within(0, 4, 0.5f, 1) == Approx(0.125f));
    REQUIRE(part_within(4, 0, 1, -1) == 0);
    Parameters p = parameters();
    p.dt = 1 / 60.0f;
    p.cell = p.inverse_cell = 1;
    const Velocity flying{vec3(60, 0, 0), 0, vec3(0), 0};
    const Pose start = pose_at(vec3(0));
    const Bounds bounds = bounds_of(ball, 0, start, flying, BodyForces{}, p);
    const auto part = [&](vec3 end) { return seen_part(ball, sweep_of(start), pose_at(end), bounds); };
    REQUIRE(part({1, 0, 0}) == 1);
    REQUIRE(part({-1, 0, 0}) == Approx(0.052f));  // half the speculative distance plus half the thickness
    REQUIRE(part({0.5f, 0.5f, 0}) == Approx(0.104f));
}

TEST_CASE("a tumbling body that waits keeps its energy of rotation and the direction of its angular momentum") {
    BodyProperties body{};
    body.motion = MOTION_DYNAMIC;
    body.joints = NONE;
    body.inverse_inertia = vec3(8, 3, 2.5f);
    Pose there = pose_at({1, 0, 0});
    there.orientation = glm::normalize(vec4(0.3f, -0.2f, 0.5f, 0.7f));
    const Velocity end{vec3(60, 0, 0), 0, vec3(20, -30, 10), 0};
    const Velocity after = clamp_motion(sweep_of(pose_at(vec3(0))), there, end, body, BodyForces{}, 0.5f).velocity;
    const auto momentum = [&](vec3 angular, vec4 orientation) {
        return rotate(orientation, rotate_back(orientation, angular) / body.inverse_inertia);
    };
    const vec4 orientation = clamp_motion(sweep_of(pose_at(vec3(0))), there, end, body, BodyForces{}, 0.5f).pose.orientation;
    const vec3 was = momentum(end.angular, there.orientation), is = momentum(after.angular, orientation);
    REQUIRE(after.angular != end.angular);
    REQUIRE(glm::dot(is, after.angular) == Approx(glm::dot(was, end.angular)).epsilon(1e-5));
    REQUIRE(glm::dot(is, was) == Approx(glm::length(is) * glm::length(was)).epsilon(1e-5));
}

TEST_CASE("a body that waits keeps its energy") {
    BodyForces load{};
    load.acceleration = vec3(0, -9.81f, 0);
    const Sweep sweep = sweep_of(pose_at({0, 10, 0}));
    const Velocity end{vec3(20, -15, 0), 0.001f, vec3(1, 2, 3), 0.001f};
    const Pose there = pose_at({0.3f, 9.7f, 0});
    const ClampedMotion after = clamp_motion(sweep, there, end, BodyProperties{}, load, 0.25f);
    REQUIRE(after.pose.position.y == Approx(9.925f));
    REQUIRE(after.velocity.low_y == 0);
    const auto energy = [](vec3 v, float height) { return 0.5 * glm::dot(glm::dvec3(v), glm::dvec3(v)) + 9.81 * height; };
    REQUIRE(energy(after.velocity.linear, after.pose.position.y) == Approx(energy(end.linear, 9.7f)).epsilon(1e-6));
    REQUIRE(after.velocity.angular == end.angular);
    REQUIRE(clamp_motion(sweep, there, end, BodyProperties{}, BodyForces{}, 0.25f).velocity.linear == end.linear);
}

// Against many points of both ways.
TEST_CASE("ways pass each other where their spheres stay apart all along") {
    tests::Noise noise(4);
    int passing = 0, meeting = 0;
    for (int i = 0; i < 3000; ++i) {
        const float until[2] = {i % 3 == 0 ? std::abs(noise()) : 2, i % 4 == 0 ? std::abs(noise()) : 1};
        Way ways[2];
        for (int k = 0; k < 2; ++k)
            ways[k] = way_of(0.05f + 0.2f * std::abs(noise()), noise.vector(), noise.vector() * 2.0f, until[k]);
        const Nearing near = nearing_of(ways[0], ways[1], touch);
        float least = 1e30f;
        for (int step = 0; step <= 2000; ++step) {
            const float t = static_cast<float>(step) / 2000;
            const auto at = [&](const Way& way) { return way.start + way.way * std::min(t, way.until); };
            const float distance = length3(at(ways[1]) - at(ways[0]));
            least = std::min(least, distance);
            if (t <= std::max(ways[0].until, ways[1].until) && distance < ways[0].reach + ways[1].reach + touch) {
                CAPTURE(i, t, near.first, near.last);
                CHECK(near.first <= t);
                CHECK(t <= near.last);
            }
        }
        const float room = ways[0].reach + ways[1].reach;
        CAPTURE(i, least, room);
        if (least > 1.002f * room + 2 * touch + 0.003f) {
            CHECK(passes(near));
            ++passing;
        } else if (least < room + touch) {
            CHECK_FALSE(passes(near));
            for (const float t : {near.first, near.last}) {  // not searched where they are far
                const auto at = [&](const Way& way) { return way.start + way.way * std::min(t, way.until); };
                CHECK(length3(at(ways[1]) - at(ways[0])) < 1.002f * room + 2 * touch);
            }
            ++meeting;
        }
    }
    CHECK(passing > 500);
    CHECK(meeting > 100);
}

TEST_CASE("nothing passes a plane by its size") {
    const Way down = way_of(reach_of(ball), vec3(5, 3, 0), vec3(5, -3, 0), 1),
              lies = way_of(reach_of(ground), vec3(0), vec3(0), 1);
    CHECK_FALSE(passes(nearing_of(down, lies, touch)));
    CHECK_FALSE(passes(nearing_of(lies, lies, touch)));
}

TEST_CASE("an impact is found as in the whole step where spheres touch, and one at the bound or later is not") {
    tests::Noise noise(9);
    const BodyProperties kinds[] = {ball, properties_of(SHAPE_CAPSULE, vec3(0.05f, 0.2f, 0)),
                                    properties_of(SHAPE_BOX, vec3(0.2f, 0.02f, 0.1f)), ground};
    const auto turned = [&] { return glm::normalize(vec4(noise(), noise(), noise(), noise() + 0.01f)); };
    int found = 0;
    for (int i = 0; i < 4000; ++i) {
        const BodyProperties &a = kinds[i % 3], &b = kinds[i / 3 % 4];
        const Pose starts[2] = {pose_at(noise.vector(), turned()), pose_at(noise.vector(), turned())};
        const Pose ends[2] = {pose_at(noise.vector() * 2.0f, turned()), pose_at(noise.vector() * 2.0f, turned())};
        const MotionPath of_a = from_to(a, starts[0], ends[0]),
                         of_b = b.shape == SHAPE_PLANE ? still(b, starts[1]) : from_to(b, starts[1], ends[1]);
        const vec3 end_b = b.shape == SHAPE_PLANE ? starts[1].position : ends[1].position;
        const Nearing near = nearing_of(way_of(reach_of(a), starts[0].position, ends[0].position, 1),
                                        way_of(reach_of(b), starts[1].position, end_b, 1), touch);
        const physics::Limits limits = limits_of(a, b, NO_CONTACT, parameters());
        const float whole = meet(a, of_a, b, of_b).fraction;
        const auto within = [&](float bound) {
            return passes(near) ? NO_HIT : impact_of(a, of_a, b, of_b, near, bound, limits, false, Hulls{}).fraction;
        };
        CAPTURE(i, whole, near.first, near.last);
        if (whole > 1) {
            CHECK(within(NO_HIT) > 1);
            continue;
        }
        ++found;
        CHECK(within(NO_HIT) == Approx(whole).margin(0.004));
        CHECK(within(1) == within(NO_HIT));
        CHECK(within(0.9f * whole) >= 0.9f * whole);
    }
    CHECK(found > 300);
}

TEST_CASE("turning closes a gap by its arc, and by no more than the bounding sphere") {
    const BodyProperties rod = properties_of(SHAPE_BOX, vec3(1, 0.05f, 0.05f));
    Parameters p = parameters();
    p.dt = 0.01f;
    const float reach = bounding_radius(rod.shape, rod.size);
    const auto closed = [&](const BodyProperties& body, float spin) {
        return closed_by_turning(body, reach, {vec3(0), 0, vec3(0, spin, 0), 0}, p);
    };
    CHECK(closed(rod, 10) == Approx(0.1f * reach));
    CHECK(closed(rod, 1000) == reach);
    CHECK(closed(ball, 1000) == 0);
}
