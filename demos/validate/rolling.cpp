// Rolling: round bodies against the equations of rolling without slip.
#include <cmath>

#include "compute/scene/portable_math.h"

#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

constexpr double ball_radius = 0.3;

Body round_body(const Shape& shape, double friction) {
    Body body;
    body.shape = shape;
    body.friction = static_cast<float>(friction);
    return body;
}

// Distance rolled down an incline in the time, m. A cylinder's axis is across the slope.
double roll_down(const Lab& lab, double slope, Body body, double seconds) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(slope, 1));
    body.position = uphill_normal(slope) * static_cast<float>(ball_radius);
    body.orientation = turned({1, 0, 0}, 90 * degrees);  // a cylinder's y axis to z
    scene.bodies.push_back(body);
    World world = lab.world(scene);
    world.step(lab.steps(seconds));
    return static_cast<double>(glm::dot(world.body(1).position - body.position, downhill(slope)));
}

Body ball_on_plane(Scene& scene, double friction, double speed) {
    scene.bodies.push_back(inclined_plane(0, static_cast<float>(friction)));
    Body ball = round_body(Sphere{static_cast<float>(ball_radius)}, friction);
    ball.position = {0, static_cast<float>(ball_radius), 0};
    ball.velocity = {static_cast<float>(speed), 0, 0};
    return ball;
}

}  // namespace

std::vector<Experiment> rolling_experiments() {
    std::vector<Experiment> all;
    const auto rolls = [&](const char* name, const char* title, const char* law, const Shape& shape, double part) {
        all.push_back({name,
                       title,
                       law,
                       "rigid body dynamics, rolling without slip",
                       "slope s, degrees",
                       "acceleration, m/s^2",
                       0.005,
                       0.01,
                       {2, 5, 10, 20, 30},
                       [part](double s) { return part * earth_gravity * portable::sin(s * degree); },
                       [shape](const Lab& lab, double s) { return 0.5 * roll_down(lab, s * degree, round_body(shape, 1), 2); }});
    };
    rolls("roll-ball", "a ball rolls down an incline", "a = 5/7 g sin s", Sphere{static_cast<float>(ball_radius)}, 5.0 / 7);
    rolls("roll-cylinder", "a cylinder rolls down an incline", "a = 2/3 g sin s", Cylinder{static_cast<float>(ball_radius), 0.4f},
          2.0 / 3);
    all.push_back({"slide-to-roll",
                   "a ball that slides comes to roll",
                   "v = 5/7 v0, whatever the friction",
                   "Newton, Euler",
                   "friction",
                   "speed of 7 m/s, m/s",
                   0.002,
                   0,
                   {0.05, 0.1, 0.2, 0.4, 0.8},
                   [](double) { return 5.0; },
                   [](const Lab& lab, double friction) {
                       Scene scene;
                       scene.bodies.push_back(ball_on_plane(scene, friction, 7));
                       World world = lab.world(scene);
                       world.step(lab.steps(2.0 / 7 * 7 / (friction * earth_gravity) + 1));
                       return static_cast<double>(world.body(1).velocity.x);
                   }});
    all.push_back({"roll-to-rest",
                   "rolling resistance stops a ball",
                   "s = 7/10 v^2 R / (g c)",
                   "torque c N about the contact",
                   "speed v, m/s",
                   "way, m",
                   0.01,
                   0.005,
                   {0.5, 1, 2, 3},
                   [](double v) { return 0.7 * v * v * ball_radius / (earth_gravity * 0.02); },
                   [](const Lab& lab, double v) {
                       Scene scene;
                       Body ball = ball_on_plane(scene, 0.8, v);
                       ball.angular_velocity = {0, 0, static_cast<float>(-v / ball_radius)};
                       ball.rolling_resistance = 0.02f;
                       scene.bodies.push_back(ball);
                       World world = lab.world(scene);
                       world.step(lab.steps(1.4 * v * ball_radius / (earth_gravity * 0.02) + 1));
                       return static_cast<double>(world.body(1).position.x);
                   }});
    return all;
}

}  // namespace scree::demos
