// Vehicles: a course with ramps, a banked curve and loose obstacles, and any number of cars on a round track.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/driving.h"
#include "demos/scenes/scene_builder.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float gate_half = 2.6f;  // m, from the centre of a gate to its posts

struct Course {
    std::vector<WayPoint> route;
    std::vector<std::size_t> gates;  // way points between posts
    float bend = 20;                 // m, radius of the banked curve
    vec3 centre{24, 0, 118};         // centre of the curve, m
};

Course course() {
    Course c;
    const auto to = [&](float x, float z, float speed, bool gate = false) {
        if (gate) c.gates.push_back(c.route.size());
        c.route.push_back({vec3(x, 0, z), speed});
    };
    to(0, -2, 10);
    to(0, 16, 11, true);
    to(0, 33, 9);
    to(0, 52, 10, true);
    to(1.8f, 68, 9, true);
    to(-1.8f, 84, 9, true);
    to(2.5f, 100, 9, true);
    for (int i = 0; i <= 12; ++i) {
        const float angle = pi * static_cast<float>(i) / 12;
        to(c.centre.x - c.bend * portable::cos(angle), c.centre.z + c.bend * portable::sin(angle), 10.5f, i == 6);
    }
    to(44, 104, 11, true);
    to(44, 78, 10);
    to(44, 58, 9, true);
    to(42.4f, 42, 9, true);
    to(45.6f, 26, 9, true);
    to(44, 6, 6, true);
    to(44, -2, 2);
    return c;
}

// Adds a ramp along z: up, over a deck, down.
void add_ramp(Scene& scene, float from) {
    constexpr float rise = 0.9f, slope = 8, deck = 4, width = 5;
    scene.bodies.push_back(wedge({0, 0, from}, width, slope, rise, 0));
    scene.bodies.push_back(fixed_box({0, rise / 2 - 0.1f, from + slope + deck / 2}, {width / 2, rise / 2 + 0.1f, deck / 2}, 1));
    scene.bodies.push_back(wedge({0, 0, from + 2 * slope + deck}, width, slope, rise, pi));
}

// Adds the banked curve as a mesh whose outer edge rises at its beginning and falls at its end.
void add_bank(Scene& scene, const Course& c) {
    constexpr std::uint32_t sections = 48;
    constexpr float half_width = 3.5f, rise = 1;
    Mesh mesh;
    for (std::uint32_t i = 0; i <= sections; ++i) {
        const float angle = pi * static_cast<float>(i) / sections;
        const vec3 outward(-portable::cos(angle), 0, portable::sin(angle));
        const float part = std::min(1.0f, 4 * std::min(angle, pi - angle) / pi);
        mesh.vertices.push_back(c.centre + outward * (c.bend - half_width) + vec3(0, 0.005f, 0));
        mesh.vertices.push_back(c.centre + outward * (c.bend + half_width) +
                                vec3(0, 0.005f + rise * part * part * (3 - 2 * part), 0));
        if (i == 0) continue;
        const std::uint32_t k = 2 * i;
        mesh.triangles.emplace_back(k - 2, k - 1, k);
        mesh.triangles.emplace_back(k - 1, k + 1, k);
    }
    for (glm::uvec3& t : mesh.triangles) {
        const vec3 normal = glm::cross(mesh.vertices[t.y] - mesh.vertices[t.x], mesh.vertices[t.z] - mesh.vertices[t.x]);
        if (normal.y < 0) std::swap(t.y, t.z);  // faces up
    }
    Body road;
    road.name = "banked road";
    road.motion = Motion::fixed;
    road.friction = 1;
    road.shape = std::move(mesh);
    scene.bodies.push_back(std::move(road));
}

void add_gates(Scene& scene, const Course& c) {
    for (const std::size_t gate : c.gates) {
        const vec3 here = c.route[gate].position, way = c.route[gate + 1].position - c.route[gate - 1].position;
        const vec3 side = glm::normalize(glm::cross(vec3(0, 1, 0), way));
        for (const float s : {-1.0f, 1.0f}) {
            Body post;
            post.motion = Motion::fixed;
            post.shape = Cylinder{0.08f, 0.7f};
            post.position = here + side * (s * (here.z > c.centre.z ? gate_half + 1.2f : gate_half)) + vec3(0, 0.7f, 0);
            scene.bodies.push_back(post);
        }
    }
}

// Adds loose obstacles: a wall of cartons, a row of barrels, some balls.
// Painted bodies on dark tyres.
void paint(Scene& scene) {
    constexpr vec3 paints[] = {{0.74f, 0.16f, 0.12f}, {0.16f, 0.34f, 0.66f}};
    for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
        scene.bodies[scene.vehicles[i].chassis].color = paints[i % 2];
        for (const Wheel& wheel : scene.vehicles[i].wheels) {
            const Joint& axle = scene.joints[wheel.joint];
            scene.bodies[axle.a == scene.vehicles[i].chassis ? axle.b : axle.a].color = vec3(0.16f);
        }
    }
}

Indices add_loose(Scene& scene) {
    Indices loose;
    const auto add = [&](Shape shape, vec3 position, float density) {
        Body body;
        body.shape = std::move(shape);
        body.position = position;
        body.density = density;
        body.color = std::holds_alternative<Box>(body.shape)        ? vec3(0.86f, 0.62f, 0.22f)
                     : std::holds_alternative<Cylinder>(body.shape) ? vec3(0.20f, 0.52f, 0.50f)
                                                                    : vec3(0.90f, 0.88f, 0.84f);
        scene.bodies.push_back(body);
        loose.push_back(scene.bodies.size() - 1);
    };
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 6; ++k)
            add(Box{vec3(0.3f)}, {44 + 0.62f * (static_cast<float>(k) - 2.5f), 0.3f + 0.6f * static_cast<float>(row), 88}, 40);
    for (int k = 0; k < 4; ++k) add(Cylinder{0.4f, 0.55f}, {42.6f + 0.9f * static_cast<float>(k), 0.55f, 66}, 40);
    for (int k = 0; k < 5; ++k) add(Sphere{0.35f}, {42.4f + 0.8f * static_cast<float>(k), 0.35f, 16}, 40);
    return loose;
}

// Times at which the car passed each gate, s; no_number from the first missed gate on.
std::vector<double> passages(const Trace& trace, const Course& c) {
    std::vector<double> times;
    std::size_t next = 0;
    for (std::size_t i = 1; i < trace.moments.size() && next < c.gates.size(); ++i) {
        const std::size_t gate = c.gates[next];
        const vec3 here = c.route[gate].position;
        const vec3 way = glm::normalize(c.route[gate + 1].position - c.route[gate - 1].position);
        const auto along = [&](const Trace::Moment& moment) { return glm::dot(moment.bodies[0].position - here, way); };
        const vec3 away = trace.moments[i].bodies[0].position - here;
        if (along(trace.moments[i - 1]) >= 0 || along(trace.moments[i]) < 0) continue;
        const vec3 aside = away - way * glm::dot(away, way);
        if (glm::length(vec3(aside.x, 0, aside.z)) > gate_half + 1) continue;
        times.push_back(trace.moments[i].time);
        ++next;
    }
    return times;
}

Promise promise_of(const Course& c, std::size_t car, const Indices& loose, const Claim& upright) {
    const auto gates = static_cast<double>(c.gates.size());
    const Claim all_gates = at_least("gates driven through", gates, "", "in their order, between the posts",
                                     [c](const Trace& trace) { return static_cast<double>(passages(trace, c).size()); });
    const Claim in_time = at_most("time to the last gate", 40, "s", "from the start", [c](const Trace& trace) {
        const std::vector<double> times = passages(trace, c);
        return times.size() == c.gates.size() ? times.back() : no_number;
    });
    const Claim pushed =
        at_least("loose bodies pushed away", 12, "", "further than 0.5 m by the end", [loose](const Trace& trace) {
            return static_cast<double>(std::count_if(loose.begin(), loose.end(), [&](std::size_t body) {
                return glm::distance(trace.start[body].position, trace.end[body].position) > 0.5f;
            }));
        });
    const Claim parks =
        because(at_most("speed of the car at the end", rest_speed, "m/s", "it parks by itself",
                        [car](const Trace& trace) { return static_cast<double>(glm::length(trace.end[car].velocity)); }),
                at_rest);
    return Promise(all_gates, in_time, upright, pushed, parks).watching({car}, every_step);
}

}  // namespace

DemoScene drive(const DemoOptions&) {
    const Course c = course();
    Scene scene;
    scene.bodies.push_back(ground(1));
    const std::size_t vehicle = add_car(scene, {.position = {0, 0, 0}});
    scene.vehicles[vehicle].route = c.route;
    const std::size_t car = scene.vehicles[vehicle].chassis;
    const std::size_t plain = add_cart(scene, {.position = {26, 0, 30}});
    for (const auto& [x, z] : {std::pair(26, 30), {26, 42}, {20, 50}, {14, 42}, {14, 30}, {20, 22}})
        scene.vehicles[plain].route.push_back({vec3(x, 0, z), 3});
    scene.vehicles[plain].loops = true;
    add_ramp(scene, 22);
    add_bank(scene, c);
    add_gates(scene, c);
    const Indices loose = add_loose(scene);
    const std::size_t cart = scene.vehicles[plain].chassis;
    paint(scene);

    const vec3 low(-5, 0, -4), high(49, 4, 142);
    Viewpoint behind;  // of the car, which starts along z
    behind.eye = {-2.5f, 3.4f, -9};
    behind.target = {0, 0.9f, 2};
    behind.follow = car;
    behind.chase = true;
    return {std::move(scene), behind, low, high, 40, promise_of(c, car, loose, all_upright("the car and the cart", {car, cart}))};
}

DemoScene cars(const DemoOptions& options) {
    constexpr float first = 20, lane = 5, apart = 13;
    const std::size_t count = std::max<std::size_t>(1, options.bodies / 5);
    Scene scene;
    scene.bodies.push_back(ground(1));
    Indices chassis;
    std::vector<float> radii;
    float radius = first;
    for (std::size_t made = 0; made < count; radius += lane) {
        const auto places = static_cast<int>(2 * pi * radius / apart);
        const int points = std::max(24, static_cast<int>(radius));
        const float speed = std::min(std::sqrt(4 * radius), 20.0f);  // 4 m/s^2 of lateral acceleration
        std::vector<WayPoint> route;
        const auto at = [&](float angle) { return vec3(radius * portable::cos(angle), 0, -radius * portable::sin(angle)); };
        for (int i = 0; i < points; ++i)
            route.push_back({at(2 * pi * static_cast<float>(i) / static_cast<float>(points)), speed});
        for (int i = 0; i < places && made < count; ++i, ++made) {
            const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(places);
            const std::size_t vehicle = add_car(scene, {.position = at(angle), .heading = angle + pi});
            Vehicle& v = scene.vehicles[vehicle];
            v.route = route;
            v.loops = true;
            v.next =
                (static_cast<std::size_t>(angle / (2 * pi) * static_cast<float>(points)) + 1) % static_cast<std::size_t>(points);
            chassis.push_back(v.chassis);
            radii.push_back(radius);
        }
    }
    const Claim in_lane =
        at_most("farthest from the middle of its lane", 1.2, "m", "of any car, at the end", [=](const Trace& trace) {
            double farthest = 0;
            for (std::size_t k = 0; k < chassis.size(); ++k) {
                const vec3 place = trace.end[chassis[k]].position;
                farthest = std::max(farthest, std::abs(static_cast<double>(portable::hypot(place.x, place.z) - radii[k])));
            }
            return farthest;
        });
    const Claim at_speed =
        at_least("least speed, of what its lane is driven at", 0.9, "", "of any car, at the end", [=](const Trace& trace) {
            double least = 1e9;
            for (std::size_t k = 0; k < chassis.size(); ++k)
                least = std::min(least, static_cast<double>(glm::length(trace.end[chassis[k]].velocity) /
                                                            std::min(std::sqrt(4 * radii[k]), 20.0f)));
            return least;
        });
    const vec3 high(radius, 2, radius);
    return {std::move(scene),
            view_of(-high, high, 30, 35),
            -high,
            high,
            15,
            Promise(all_upright("all cars", chassis), because(in_lane, any_number), at_speed)};
}

}  // namespace scree::demos
