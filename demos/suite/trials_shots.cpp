// Trials of continuous collision: thousands of projectiles at walls thinner than the motion per step, and at movable
// plates and bodies.
#include <algorithm>
#include <cmath>

#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float fastest = 300, slowest = 5;  // m/s
constexpr float wall_friction = 0.3f;
constexpr float half_size = 0.05f;  // m, of projectiles: spheres and boxes 0.1 m wide
constexpr float cell = 1.5f;        // m, width of one lane

// A projectile: spheres and randomly oriented, spinning boxes alternate; half of the speeds are above 100 m/s.
Body some_shot(std::size_t index, Random& random) {
    Body body;
    if (index % 2 == 0) {
        body.shape = Sphere{half_size};
    } else {
        body.shape = Box{vec3(half_size)};
        body.orientation = random.orientation();
    }
    body.angular_velocity = {random.between(-20, 20), random.between(-20, 20), random.between(-20, 20)};
    body.friction = 0.3f;
    body.restitution = index % 4 < 2 ? 0.5f : 0.0f;
    return body;
}
float some_speed(Random& random) {
    const float part = random.unit();
    return part < 0.5f ? slowest + (100 - slowest) * 2 * part : 100 + (fastest - 100) * (2 * part - 1);
}
// A random direction towards -z, whose lateral slopes are at most `sideways`.
vec3 some_aim(float sideways, Random& random) {
    const float y = random.between(-sideways, sideways), x = random.between(-sideways, sideways);
    return glm::normalize(vec3(x, y, -1));
}
vec3 some_place(float half, Random& random) {
    const float y = random.between(-half, half), x = random.between(-half, half);
    return vec3(x, y, 0);
}

struct Front {
    int columns, rows;
    std::size_t places() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
    vec3 middle(std::size_t index) const {
        const int column = static_cast<int>(index) % columns, row = static_cast<int>(index) / columns;
        return cell * vec3(static_cast<float>(column) - 0.5f * static_cast<float>(columns - 1),
                           static_cast<float>(row) - 0.5f * static_cast<float>(rows - 1), 0);
    }
    vec3 corner(float depth) const {
        return vec3(0.5f * cell * static_cast<float>(columns), 0.5f * cell * static_cast<float>(rows), depth);
    }
};
Front front_for(std::size_t count) {
    const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count) * 16 / 9))));
    return {columns, (static_cast<int>(count) + columns - 1) / columns};
}

DemoScene finish(Scene scene, const Front& front, const std::string& what, std::vector<Shot> shots, float seconds) {
    const vec3 high = front.corner(2);
    return {std::move(scene), view_of(-high, high, 30, 15), -high, high, seconds, Promise(none_through(what, std::move(shots)))};
}

// Extends the wall around its pieces by the range of the fastest projectile, since one without restitution slides
// along it.
void add_margin(Scene& scene, const Front& front, float half_thickness, float seconds) {
    const vec3 inner = front.corner(half_thickness);
    const float half = fastest * seconds / 2;
    for (const float side : {-1.0f, 1.0f}) {
        scene.bodies.push_back(
            fixed_box({side * (inner.x + half), 0, 0}, {half, inner.y + 2 * half, half_thickness}, wall_friction));
        scene.bodies.push_back(fixed_box({0, side * (inner.y + half), 0}, {inner.x, half, half_thickness}, wall_friction));
    }
}

constexpr float thin = 0.025f;  // half the wall's thickness, m
std::size_t add_piece(Scene& scene, const Front& front, std::size_t i) {
    scene.bodies.push_back(fixed_box(front.middle(i), {cell / 2, cell / 2, thin}, wall_friction));
    return scene.bodies.size() - 1;
}
Scene weightless() {
    Scene scene;
    scene.gravity = vec3(0);
    return scene;
}

}  // namespace

// A wall 0.05 m thick, in adjacent pieces with a projectile each; the slowest and most oblique one arrives after 0.2
// s.
DemoScene shots(const DemoOptions& options) {
    constexpr float seconds = 0.4f;
    const Front front = front_for(options.bodies);
    Random random(options.seed);
    Scene scene = weightless();
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < options.bodies; ++i) {
        const std::size_t piece = add_piece(scene, front, i);
        Body shot = some_shot(i, random);
        const vec3 aim = some_aim(1, random);
        const float before = random.between(0.12f, 0.45f) / -aim.z;
        shot.position = front.middle(i) + some_place(0.2f, random) - aim * before;
        shot.velocity = aim * some_speed(random);
        shots.push_back({scene.bodies.size(), piece, {0, 0, 1}, thin, false});
        scene.bodies.push_back(shot);
    }
    for (std::size_t i = options.bodies; i < front.places(); ++i) add_piece(scene, front, i);  // fill the last row
    add_margin(scene, front, thin, seconds);
    return finish(std::move(scene), front, "shots at a wall 5 cm thick", std::move(shots), seconds);
}

// Pairs and chains of two to five bodies on joints, flying and spinning as one, at the same wall: balls, hinges and fixed
// joints in turn.
DemoScene joinedshots(const DemoOptions& options) {
    constexpr float seconds = 0.4f, apart = 0.11f;
    const std::size_t groups = std::max<std::size_t>(1, 2 * options.bodies / 7);
    const Front front = front_for(groups);
    Random random(options.seed);
    Scene scene = weightless();
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < groups; ++i) {
        const std::size_t piece = add_piece(scene, front, i);
        const vec3 aim = some_aim(0.5f, random);
        const vec3 velocity = aim * some_speed(random);
        const vec3 axis = physics::rotate(random.orientation(), vec3(1, 0, 0));
        const vec3 spin = random.between(-20, 20) * axis;
        const vec3 along = -some_aim(1, random);  // the first link is the nearest to the wall
        const float before = random.between(0.15f, 0.45f) / -aim.z;
        const vec3 start = front.middle(i) + some_place(0.05f, random) - aim * before;
        for (std::size_t k = 0; k < 2 + i % 4; ++k) {
            Body link = some_shot(i, random);
            link.orientation = vec4(0, 0, 0, 1);
            const vec3 from_first = along * (apart * static_cast<float>(k));
            link.position = start + from_first;
            link.velocity = velocity + glm::cross(spin, from_first);
            link.angular_velocity = spin;
            if (k > 0) {
                Joint joint;
                if (i % 3 == 1) joint.kind = Hinge{};
                if (i % 3 == 2) joint.kind = Fixed{};
                joint.a = scene.bodies.size() - 1;
                joint.b = scene.bodies.size();
                joint.anchor_a = along * (apart / 2);
                joint.anchor_b = -joint.anchor_a;
                scene.joints.push_back(joint);
            }
            shots.push_back({scene.bodies.size(), piece, {0, 0, 1}, thin, false});
            scene.bodies.push_back(link);
        }
    }
    for (std::size_t i = groups; i < front.places(); ++i) add_piece(scene, front, i);  // fill the last row
    add_margin(scene, front, thin, seconds);
    return finish(std::move(scene), front, "pairs and chains on joints at a wall 5 cm thick", std::move(shots), seconds);
}

// Movable targets: plates 0.04 m thick of 50 kg and 4 kg, a sphere and a box as large as the projectiles, of 0.5 and
// 1 kg. Projectiles with restitution move away from the target's centre, however it rotates; those without hit a
// plate straight and rotate with it.
DemoScene strikes(const DemoOptions& options) {
    constexpr float thin = 0.02f, gentlest = 20;
    const Front front = front_for(options.bodies);
    Random random(options.seed);
    Scene scene;
    scene.gravity = vec3(0);
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < options.bodies; ++i) {
        const bool plate = i % 4 < 2, heavy = i % 4 == 0, sticking = plate && i % 8 < 4;
        Body shot = some_shot(plate ? (sticking ? 0 : i / 8) : i, random);
        shot.restitution = sticking ? 0.0f : 0.5f;
        Body target = box_at(front.middle(i), {0.5f, 0.5f, thin});
        target.density = heavy ? 1250.0f : 100.0f;
        if (!plate) {  // equal shapes, face to face
            shot.orientation = vec4(0, 0, 0, 1);
            shot.angular_velocity = vec3(0);
            target.shape = shot.shape;
            target.density = shot.density;
        }
        const bool box = std::holds_alternative<Box>(shot.shape);
        const vec3 aim = some_aim(plate && !sticking && !box ? 0.5f : 0, random);
        const vec3 mark = target.position + some_place(heavy ? 0.1f : 0.01f, random);
        shot.position = mark - aim * random.between(0.2f, 0.5f);
        shot.velocity = aim * std::max(gentlest, some_speed(random));
        shots.push_back({scene.bodies.size() + 1, scene.bodies.size(), {0, 0, 1}, plate ? thin : 0, sticking});
        scene.bodies.push_back(target);
        scene.bodies.push_back(shot);
    }
    return finish(std::move(scene), front, "shots at thin plates and small bodies", std::move(shots), 0.1f);
}

}  // namespace scree::demos
