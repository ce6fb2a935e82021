// Fracture trials: thresholds slightly above and below the impulse, and conservation of momentum.
#include <algorithm>
#include <cmath>

#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/common_checks.h"

namespace scree::demos {

namespace {

double length_of(const double (&v)[3]) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// The largest change of a total over the run, relative to `scale`.
Claim keeps(const char* what, const double (Statistics::*sum)[3], double limit, double scale) {
    return at_most(what, limit, "", "of the bodies' own at the start added up as lengths, 30 times a second",
                   [sum, scale](const Trace& trace) {
                       double most = 0;
                       for (const Trace::Sample& sample : trace.samples) {
                           double change[3];
                           for (int k = 0; k < 3; ++k)
                               change[k] = (sample.statistics.*sum)[k] - (trace.samples.front().statistics.*sum)[k];
                           most = std::max(most, length_of(change) / scale);
                       }
                       return trace.samples.empty() ? no_number : most;
                   });
}

}  // namespace

// Balls of several masses and speeds hit much heavier blocks. The impulse is twice the ball's momentum with
// restitution 1, and once with restitution 0.
DemoScene thresholds(const DemoOptions&) {
    Scene scene;
    scene.gravity = vec3(0);
    Indices weak, strong;
    float row = 0;
    for (const float radius : {0.05f, 0.2f, 0.5f, 1.0f}) {
        float column = 0;
        for (const float speed : {1.5f, 6.0f, 20.0f, 50.0f}) {
            for (const float part : {0.97f, 1.03f}) {
                Body ball;
                ball.shape = Sphere{radius};
                ball.position = {column, row, 0};
                ball.velocity = {0, 0, speed};
                const float momentum = mass_properties(ball.shape, ball.density).mass * speed;
                ball.fracture.emplace();
                ball.fracture->impulse = part * momentum;
                ball.fracture->pieces = 6;
                (part < 1 ? weak : strong).push_back(scene.bodies.size());
                scene.bodies.push_back(ball);
                scene.bodies.push_back(
                    fixed_box({column, row, radius + 0.31f * speed + 0.2f}, {0.9f * radius, 0.9f * radius, 0.2f}));
                column += 2.6f * radius;
            }
        }
        row += 2.4f + radius;
    }
    const auto broken = [](const Indices& balls) {
        return [balls](const Trace& trace) {
            return static_cast<double>(
                std::count_if(balls.begin(), balls.end(), [&](std::size_t i) { return !trace.end.at(i).exists; }));
        };
    };
    const vec3 low(-1, -1, -1), high(22, 12, 18);
    return {std::move(scene),
            view_of(low, high, 200, 20),
            low,
            high,
            1,
            Promise(at_most("balls broken by 3% less than their threshold", 0, "", "at the end", broken(strong)),
                    at_least("balls broken by 3% more", static_cast<double>(weak.size()), "", "at the end", broken(weak)))};
}

// The bodies are slow for their size, so that no fragment needs continuous collision (sweep.h): clamping to the time
// of impact changes the position and thus the angular momentum about the origin (by 6e-5 at twice the speed).
DemoScene fragments(const DemoOptions& options) {
    Scene scene;
    scene.gravity = vec3(0);
    Random random(options.seed);
    double momentum = 0, angular = 0;
    for (int i = 0; i < 64; ++i) {
        Body body;
        switch (i % 4) {
            case 0:
                body.shape = Box{{0.3f, 0.4f, 0.5f}};
                break;
            case 1:
                body.shape = Sphere{0.45f};
                break;
            case 2:
                body.shape = Cylinder{0.3f, 0.5f};
                break;
            default:
                body.shape = Capsule{0.3f, 0.3f};
        }
        const vec3 cell(static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
        body.position = (cell - 1.5f) * 2.0f;
        body.velocity = body.position * -0.25f + random.vector(-0.15f, 0.15f);
        body.angular_velocity = random.vector(-0.5f, 0.5f);
        body.orientation = random.orientation();
        body.friction = 0.4f;
        body.fracture.emplace();
        body.fracture->impulse = 30;
        body.fracture->pieces = 6;
        body.fracture->depth = i % 8 == 0 ? 2 : 1;
        const MassProperties mass = mass_properties(body.shape, body.density);
        momentum += static_cast<double>(mass.mass * glm::length(body.velocity));
        angular += static_cast<double>(mass.mass * glm::length(glm::cross(body.position, body.velocity)) +
                                       glm::length(mass.inertia * body.angular_velocity));
        scene.bodies.push_back(body);
    }
    const vec3 low(-5), high(5);
    Promise promise(because(keeps("greatest change of momentum", &Statistics::momentum, 2e-7, momentum), rounding),
                    because(keeps("greatest change of angular momentum", &Statistics::angular_momentum, 3e-6, angular), rounding),
                    at_least("bodies that broke", 70, "", "pieces that did included",
                             [](const Trace& trace) { return static_cast<double>(trace.statistics.broken); }));
    return {std::move(scene), view_of(low, high, 30, 20), low, high, 8, std::move(promise).sampling(30)};
}

}  // namespace scree::demos
