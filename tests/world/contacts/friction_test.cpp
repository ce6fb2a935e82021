// Sliding, spinning and riding along: worlds against closed forms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"

using namespace scree;

namespace {

Body plane(float friction) {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Plane{{0, 1, 0}, 0};
    body.friction = friction;
    return body;
}
vec4 yawed(double yaw) {
    return {0, static_cast<float>(std::sin(yaw / 2)), 0, static_cast<float>(std::cos(yaw / 2))};
}
Settings awake(float rate = 60) {
    Settings settings;
    settings.sleeping = false;
    settings.rate = rate;
    return settings;
}

// The way of a body of speed v and spin w until it rests, m: quadrature of uniform pressure on a disc.
double way_of_disc(double radius, double mu, double v, double w) {
    const double step = 1e-3, gravity = 9.81;
    double way = 0;
    while (v > 1e-3 || w * radius > 1e-3) {
        double force = 0, moment = 0, area = 0;
        for (int ring = 0; ring < 20; ++ring) {
            const double r = (ring + 0.5) / 20 * radius;
            for (int k = 0; k < 20; ++k) {
                const double at = 6.283185307179586 * (k + 0.5) / 20, x = v - w * r * std::sin(at), z = w * r * std::cos(at);
                const double speed = std::hypot(x, z) + 1e-6;
                force += r * x / speed;
                moment += r * r * (std::cos(at) * z - std::sin(at) * x) / speed;
                area += r;
            }
        }
        v -= step * mu * gravity * force / area;
        w -= step * mu * gravity * moment / area / (radius * radius / 2);
        way += v * step;
    }
    return way;
}

}  // namespace

TEST_CASE("a box slides straight down at any yaw, as far as the formula says") {
    for (const vec3 half : {vec3(1, 0.3f, 0.2f), vec3(0.1f, 0.05f, 0.25f)}) {
        for (const double yaw : {0.0, 0.4, 0.8, 1.2}) {
            Scene scene;
            const double slope = 0.5235987755982988, mu = 0.3, seconds = 1.5;
            scene.gravity = vec3(static_cast<float>(9.81 * std::sin(slope)), static_cast<float>(-9.81 * std::cos(slope)), 0);
            scene.bodies.push_back(plane(0.3f));
            Body box;
            box.shape = Box{half};
            box.position.y = half.y;
            box.orientation = yawed(yaw);
            box.friction = 0.3f;
            scene.bodies.push_back(box);
            World world(scene, awake(), 1);
            world.step(90);
            const vec3 end = world.body(1).position;
            const double way = 0.5 * 9.81 * (std::sin(slope) - mu * std::cos(slope)) * seconds * seconds;
            INFO("yaw " << yaw << ", off course by " << end.z << " of " << end.x << " m");
            CHECK(std::abs(static_cast<double>(end.z)) < 0.003 * way);
            CHECK(std::abs(static_cast<double>(end.x) / way - 1) < 0.005);
        }
    }
}

TEST_CASE("a disc that spins slides as far as uniform pressure says, and spins as long") {
    for (const float spin : {2.0f, 10.0f, 20.0f}) {
        for (const float speed : {0.0f, 2.0f}) {
            Scene scene;
            scene.bodies.push_back(plane(0.3f));
            Body disc;
            disc.shape = Cylinder{0.5f, 0.05f};
            disc.position.y = 0.05f;
            disc.velocity.x = speed;
            disc.angular_velocity.y = spin;
            disc.friction = 0.3f;
            scene.bodies.push_back(disc);
            World world(scene, awake(), 1);
            double time = 0;
            while (world.time() < 5) {
                world.step();
                if (std::abs(world.body(1).angular_velocity.y) > 0.01f) time = world.time();
            }
            INFO("spin " << spin << " rad/s, speed " << speed << " m/s");
            if (speed > 0)
                CHECK(world.body(1).position.x == Approx(way_of_disc(0.5, 0.3, 2, static_cast<double>(spin))).epsilon(0.05));
            // The torque of a disc is 2/3 mu m g R; the moment of inertia, m R^2 / 2.
            if (speed == 0) CHECK(time == Approx(static_cast<double>(spin) * 0.5 * 3 / (4 * 0.3 * 9.81)).margin(0.04));
        }
    }
}

TEST_CASE("nothing creeps on a turntable at 0.9 of the limit") {
    for (const float rate : {60.0f, 120.0f}) {
        for (const float half : {0.05f, 0.2f}) {
            Scene scene;
            const double radius = 0.5, mu = 0.5, spin = std::sqrt(0.9 * mu * 9.81 / radius);
            Body table;
            table.motion = Motion::kinematic;
            table.shape = Cylinder{1, 0.1f};
            table.position.y = -0.1f;
            table.angular_velocity.y = static_cast<float>(spin);
            table.friction = static_cast<float>(mu);
            scene.bodies.push_back(table);
            Body box;
            box.shape = Box{{half, half / 2, half}};
            box.position = vec3(static_cast<float>(radius), half / 2, 0);
            box.velocity.z = static_cast<float>(-spin * radius);
            box.angular_velocity = table.angular_velocity;
            box.friction = table.friction;
            scene.bodies.push_back(box);
            World world(scene, awake(rate), 1);
            const auto distance = [&world] { return std::hypot(world.body(1).position.x, world.body(1).position.z); };
            world.step(static_cast<int>(rate));
            const float start = distance();
            world.step(static_cast<int>(10 * rate));
            INFO("rate " << rate << ", half extent " << half);
            CHECK(std::abs(distance() - start) < 5e-4f);
        }
    }
}

TEST_CASE("a contact that slides within a step by more than the half width of the face it slides over has no points left") {
    const auto points_after = [](float half_width, float speed) {
        Scene scene;
        Body table;
        table.motion = Motion::fixed;
        table.shape = Box{{half_width, 0.5f, half_width}};
        Body box;
        box.shape = Box{vec3(0.1f)};
        box.position.y = 0.5999f;
        table.friction = box.friction = 0;
        scene.bodies = {table, box};
        World world(scene, awake(), 1);
        world.step(3);
        world.set_velocity(1, vec3(speed, 0, 0), vec3(0));
        world.step();
        REQUIRE(world.statistics().manifolds == 1);
        return world.statistics().points;
    };
    REQUIRE(points_after(0.5f, 24) == 4);
    REQUIRE(points_after(0.5f, 36) == 0);
    REQUIRE(points_after(1.5f, 36) == 4);
}

namespace {

Hull slab(vec3 half) {
    Hull hull;
    for (int k = 0; k < 8; ++k)
        hull.points.emplace_back(half * vec3((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1));
    return hull;
}
// A slab in two halves, side by side along z.
Compound halves(vec3 half) {
    const vec3 one(half.x, half.y, half.z / 2);
    return Compound{
        {Part{.shape = slab(one), .position = vec3(0, 0, -one.z)}, Part{.shape = slab(one), .position = vec3(0, 0, one.z)}}};
}

}  // namespace

TEST_CASE("thin plates slide over each other without sinking, as boxes, as hulls and in parts") {
    for (const int kind : {0, 1, 2}) {
        for (const float speed : {0.5f, 1.0f, 3.0f}) {
            const auto shape = [&](vec3 half) -> Shape {
                return kind == 0 ? Shape(Box{half}) : kind == 1 ? Shape(slab(half)) : Shape(halves(half));
            };
            Scene scene;
            Body table{.shape = shape({1, 0.002f, 0.2f})}, plate{.shape = shape({0.05f, 0.002f, 0.05f})};
            table.motion = Motion::fixed;
            table.friction = plate.friction = 0;
            plate.position = {-0.8f, 0.004f, 0.1f};
            plate.velocity = {speed, 0, 0};
            scene.bodies = {table, plate};
            World world(scene, awake(), 1);
            float lowest = 0.004f, sinking = 0;
            for (int k = 0; k < static_cast<int>(1.4f / speed * 60); ++k) {
                world.step();
                lowest = std::min(lowest, world.bodies()[1].position.y);
                sinking = std::max(sinking, std::abs(world.bodies()[1].velocity.y));
            }
            CAPTURE(kind, speed, lowest, sinking);
            CHECK(world.bodies()[1].position.x > 0.5f);
            CHECK(lowest > 0.0039f);
            CHECK(sinking < 0.02f);
        }
    }
}

namespace {

// A ball that slides and spins on a plane: its speed and spin after `seconds`, by the ellipsoidal law of friction.h in small
// steps. `arm`: of its spinning resistance, over the friction.
struct SlidingBall {
    double speed, rolling, spin;
};
SlidingBall slid_ball(SlidingBall ball, double mu, double arm, double radius, double seconds) {
    const int steps = 4000;
    const double dt = seconds / steps, gravity = 9.81, coupling = 0.6, inertia = 0.4 * radius * radius;
    for (int k = 0; k < steps; ++k) {
        const double slip = ball.speed - ball.rolling * radius, edge = ball.spin * arm;
        if (slip < 1e-9 && edge < 1e-9) break;
        double low = 0, high = 1, f = 0, t = 0;  // shares of the greatest force and moment: the gradient along (slip, edge)
        for (int halving = 0; halving < 50; ++halving) {
            t = 0.5 * (low + high);
            const double x = (1 - t * t) / (1 + coupling * t * t);
            f = std::sqrt(x);
            (t * (1 + coupling * x) * slip < f * (1 + coupling * t * t) * edge ? low : high) = t;
        }
        ball.speed -= mu * gravity * f * dt;
        ball.rolling += mu * gravity * f * radius / inertia * dt;
        ball.spin = std::max(0.0, ball.spin - mu * gravity * arm * t / inertia * dt);
    }
    return ball;
}
World ball_on_plane(double mu, double arm, double radius, int substeps, vec3 velocity, float spin) {
    Scene scene;
    scene.bodies.push_back(plane(static_cast<float>(mu)));
    Body ball{.shape = Sphere{static_cast<float>(radius)}, .position = {0, static_cast<float>(radius), 0}, .velocity = velocity};
    ball.angular_velocity = vec3(0, spin, 0);
    set_material(ball, {.friction = static_cast<float>(mu), .spinning_resistance = static_cast<float>(mu * arm)});
    scene.bodies.push_back(ball);
    Settings settings = awake();
    settings.substeps = substeps;
    return World(scene, settings, 1);
}

}  // namespace

TEST_CASE("a ball's spinning resistance is Coulomb's at any size: its spin falls evenly, and ends") {
    const double radius = 0.5, gravity = 9.81;
    for (const double part : {1.0, 0.1, 0.02, 0.002})  // arm over radius
        for (const double mu : {1.0, 0.2})
            for (const int substeps : {4, 8, 16})
                for (const double spin : {10.0, 0.5}) {
                    const double rate = 2.5 * mu * part * gravity / radius, stop = spin / rate;
                    const int half = static_cast<int>(std::min(5.0, stop / 2) * 60);
                    if (half < 12) continue;
                    CAPTURE(part, mu, substeps, spin);
                    World world = ball_on_plane(mu, part * radius, radius, substeps, vec3(0), static_cast<float>(spin));
                    world.step(half);
                    const double lost = spin - static_cast<double>(world.body(1).angular_velocity.y);
                    const double rounding = half * substeps * spin * 1e-7;
                    CHECK(lost == Approx(rate * half / 60).epsilon(0.01).margin(rounding));
                    if (stop > 10) continue;
                    world.step(static_cast<int>(stop * 60) + 6 - half);
                    CHECK(std::abs(world.body(1).angular_velocity.y) < 1e-3f);
                }
}

TEST_CASE("a ball that slides and spins loses both as the limit surface says, whatever its spinning resistance") {
    const double mu = 0.3, radius = 0.5, seconds = 0.4;
    for (const double part : {1.0, 0.3, 0.1, 0.02})
        for (const double spin : {20.0, 2.0})
            for (const int substeps : {4, 8, 16}) {
                CAPTURE(part, spin, substeps);
                const SlidingBall right = slid_ball({6, 0, spin}, mu, part * radius, radius, seconds);
                World world = ball_on_plane(mu, part * radius, radius, substeps, vec3(6, 0, 0), static_cast<float>(spin));
                world.step(static_cast<int>(seconds * 60 + 0.5));
                const BodyState ball = world.body(1);
                CHECK(ball.velocity.x == Approx(right.speed).epsilon(0.01));
                CHECK(spin - static_cast<double>(ball.angular_velocity.y) ==
                      Approx(spin - right.spin).epsilon(0.02).margin(2e-4));
            }
}
