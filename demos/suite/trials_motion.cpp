// Trials of free motion and impacts: bounces, tumbling, conservation in a swarm of colliding bodies.
#include "demos/scenes/demos.h"
#include "demos/scenes/random_bodies.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"

namespace scree::demos {

// Restitution: dropped from h, a body bounces to e^2 h, and a perfectly elastic one to h each time.
DemoScene bounce(const DemoOptions&) {
    const vec3 flat(0.3f, 0.15f, 0.3f);
    constexpr float radius = 0.3f;
    Scene scene;
    scene.bodies.push_back(ground());
    Indices watched;
    const auto dropped = [&](const Shape& shape, float under, float height, float restitution, int bounces) {
        Body body;
        body.shape = shape;
        const auto place = static_cast<float>(watched.size());
        body.position = {1.2f * place - 8.4f, under + height, 0};
        body.restitution = restitution;
        watched.push_back(scene.bodies.size());
        scene.bodies.push_back(body);
        return Dropped{watched.size() - 1, static_cast<double>(height), static_cast<double>(restitution), bounces};
    };
    std::vector<Dropped> dead, dead_boxes, half, half_boxes, full;
    for (const float height : {1.0f, 2.0f, 5.0f}) {
        dead.push_back(dropped(Sphere{radius}, radius, height, 0, 1));
        dead_boxes.push_back(dropped(Box{flat}, flat.y, height, 0, 1));
        half.push_back(dropped(Sphere{radius}, radius, height, 0.5f, 1));
        half_boxes.push_back(dropped(Box{flat}, flat.y, height, 0.5f, 1));
        full.push_back(dropped(Sphere{radius}, radius, height, 1, 5));
    }
    const vec3 low(-9, 0, -0.5f), high(9, 5.7f, 0.5f);
    Promise promise(all_bounce("bounces of spheres, e = 0, of the fall", dead, 0.004),
                    all_bounce("bounces of flat boxes, e = 0, of the fall", dead_boxes, 0.006),
                    all_bounce("bounces of spheres, e = 0.5", half, 0.0013),
                    all_bounce("bounces of flat boxes, e = 0.5", half_boxes, 0.0012),
                    all_bounce("five bounces of spheres, e = 1", full, 0.0009));
    // Five bounces from 5 m: 1 s down, four times 2 s, and 1 s up to the last apex.
    return {std::move(scene), view_of(low, high, 12, 10), low, high, 10.5f, std::move(promise).watching(watched, every_step)};
}

// Intermediate axis theorem: boxes that spin about the unstable middle axis of inertia flip repeatedly and conserve
// angular momentum and energy.
DemoScene tumbling(const DemoOptions&) {
    Scene scene;
    scene.gravity = vec3(0);
    Indices watched;
    float x = -3;
    for (const vec3 half : {vec3(0.2f, 0.5f, 0.9f), vec3(0.1f, 0.4f, 0.6f), vec3(0.5f, 0.6f, 0.8f)}) {
        Body body = box_at({x, 1.5f, 0}, half);
        body.angular_velocity = {0.05f, 6, 0.05f};
        watched.push_back(scene.bodies.size());
        scene.bodies.push_back(body);
        x += 3;
    }
    const vec3 low(-4.2f, 0.3f, -1.2f), high(4.2f, 2.7f, 1.2f);
    Promise promise(each_turns_over(watched, {0, 1, 0}, 120), each_keeps_angular_momentum(watched, 1.4e-5),
                    each_keeps_energy(watched, 3e-5));
    return {std::move(scene), view_of(low, high, 20, 20), low, high, 30, std::move(promise).watching(watched)};
}

// Bodies of every shape collide in empty space, with friction and some restitution, and fly apart: 1,000 steps.
DemoScene swarm(const DemoOptions& options) {
    constexpr int side = 4;
    constexpr float cell = 1.5f;
    Random random(options.seed);
    Scene scene;
    scene.gravity = vec3(0);
    Indices watched;
    for (int i = 0; i < side * side * side; ++i) {
        Body body = random_mixed(random.between(0.5f, 0.74f), random);
        const vec3 place = vec3(i % side, i / side % side, i / (side * side)) - vec3(0.5f * (side - 1));
        const auto chance = [&](float most) { return random.vector(-most, most); };
        body.position = place * cell;
        body.velocity = place * -0.8f + chance(2);
        body.angular_velocity = chance(3);
        body.restitution = i % 3 == 0 ? 0.6f : 0.0f;
        watched.push_back(scene.bodies.size());
        scene.bodies.push_back(body);
    }
    const vec3 corner(4.5f);
    Promise promise(because(together_keep_momentum(watched, 1e-7), rounding),
                    because(together_keep_angular_momentum(watched, 3e-7), rounding), energy_left_below(watched, 0.4));
    return {std::move(scene), view_of(-corner, corner, 35, 25),    -corner, corner,
            1000 / 60.0f,     std::move(promise).watching(watched)};
}

}  // namespace scree::demos
