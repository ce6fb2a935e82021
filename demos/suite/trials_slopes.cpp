// Trials of friction and rolling: onset of sliding, sliding acceleration, rolling, and rolling resistance.
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/incline.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"

namespace scree::demos {

namespace {

const vec3 flat(0.3f, 0.1f, 0.3f), cube(0.25f, 0.25f, 0.25f);

// Boxes of several friction coefficients, each on an incline at the fraction `part` of the angle atan(mu) at which it
// slides. From mu = 1 on a cube would tip first (at 45 degrees).
class OnsetLanes {
public:
    explicit OnsetLanes(float half_length) : half_length_(half_length) { scene.bodies.push_back(ground()); }

    void add(float part) {
        for (const float mu : {0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
            for (const vec3 half : {flat, cube}) {
                if (mu >= 1 && half == cube) continue;
                const Incline incline{part * portable::atan(mu), half_length_};
                const std::size_t body = add_lane(scene, incline, next_, box_at({}, half), half.y, mu);
                next_ += 1.3f;
                if (part < 1) {
                    sticking.push_back(body);
                } else {
                    sliding.push_back(
                        {watched.size(), incline.down(), incline.along() - static_cast<double>(mu) * incline.across()});
                    watched.push_back(body);
                }
            }
        }
    }
    // Centres the scene over the origin. Sleep is off, so that only friction holds resting bodies.
    DemoScene finish(Promise promise, float seconds) && {
        const float middle = (next_ - 1.3f) / 2, width = middle + 0.7f;
        for (Body& body : scene.bodies) body.position.z -= middle;
        const vec3 low(-half_length_, 0, -width), high(half_length_, 1.6f * half_length_, width);
        return awake({std::move(scene), view_of(low, high, 55, 25), low, high, seconds, std::move(promise).watching(watched)});
    }

    Scene scene;
    Indices watched, sticking;
    std::vector<Accelerating> sliding;

private:
    float half_length_, next_ = 0;
};

constexpr const char* far_away = "10 km from the origin, where tests run it too, positions are coarse";

Body lying_capsule(float radius, float half_height) {
    Body body;
    body.shape = Capsule{radius, half_height};
    body.orientation = turned({1, 0, 0}, 90 * degrees);  // along z
    return body;
}
Body sphere_of(float radius) {
    Body body;
    body.shape = Sphere{radius};
    return body;
}

std::vector<Body> round_bodies() {
    return {sphere_of(0.1f),           sphere_of(0.35f),          sphere_of(0.8f),
            lying_capsule(0.1f, 0.2f), lying_capsule(0.3f, 0.3f), lying_capsule(0.6f, 0.1f)};
}

}  // namespace

// At 0.99 of the angle nothing moves, at 1.01 everything slides with the expected acceleration.
DemoScene onset(const DemoOptions&) {
    OnsetLanes lanes(2);
    lanes.add(0.99f);
    lanes.add(1.01f);
    Promise promise(because(all_stay("boxes at 0.99 of the angle atan(mu), 5 s", lanes.sticking, 0.0005), far_away),
                    because(all_accelerate("boxes at 1.01 of it", lanes.sliding, 0.5, 0.6), far_away));
    return std::move(lanes).finish(std::move(promise), 5);
}

// At 0.9 of the angle nothing creeps.
DemoScene hold(const DemoOptions&) {
    OnsetLanes lanes(1.2f);
    lanes.add(0.9f);
    Promise promise(all_stay("boxes at 0.9 of the angle atan(mu), 20 s", lanes.sticking, 0.0002), end_speed_below());
    return std::move(lanes).finish(std::move(promise), 20);
}

// A steep incline: boxes slide at g (sin a - mu cos a), round bodies of several sizes roll at g sin a / (1 + I / (m R^2)).
DemoScene steep(const DemoOptions&) {
    const Incline incline{40 * degrees, 8, 0.9f};
    Scene scene;
    scene.bodies.push_back(ground());
    Indices watched;
    std::vector<Accelerating> sliding, rolling;
    float z = -7.6f;
    const auto add = [&](std::vector<Accelerating>& group, const Body& body, float height, float mu, double expected) {
        group.push_back({watched.size(), incline.down(), expected});
        watched.push_back(add_lane(scene, incline, z, body, height, mu));
        z += 1.9f;
    };
    for (const float mu : {0.2f, 0.5f, 0.75f})
        add(sliding, box_at({}, flat), flat.y, mu, incline.along() - static_cast<double>(mu) * incline.across());
    for (const Body& body : round_bodies()) add(rolling, body, radius_of(body), 0.9f, incline.along() * going_part(body));
    const vec3 low(-7, 0, -8.6f), high(7, 11, 8.6f);
    Promise promise(all_accelerate("sliding boxes at 40 degrees", sliding, 0.3, 0.0002),
                    all_accelerate("what rolls down 40 degrees", rolling, 0.3, 0.16));
    return {std::move(scene), view_of(low, high, 50, 20), low, high, 2, std::move(promise).watching(watched)};
}

// Rolling resistance is a torque c N against rotation: about the contact point (I + m R^2) w' = -c m g, so a rolling
// body decelerates by a = (c / R) g / (1 + I / (m R^2)) and stops after v^2 / 2a.
DemoScene rolling(const DemoOptions&) {
    const float speed = 1, start = -2;
    Scene scene;
    scene.bodies.push_back(ground(0.8f));
    std::vector<Rolling> bodies;
    float z = -8;
    for (const float arm : {0.02f, 0.05f}) {  // as a fraction of the radius
        for (Body body : round_bodies()) {
            const float radius = radius_of(body);
            body.position = {start, radius, z};
            body.velocity = {speed, 0, 0};
            body.angular_velocity = {0, 0, -speed / radius};
            body.friction = 0.8f;
            body.rolling_resistance = arm * radius;
            const double slowing = static_cast<double>(arm) * earth_gravity * going_part(body);
            bodies.push_back({scene.bodies.size(), speed * speed / (2 * slowing)});
            scene.bodies.push_back(body);
            z += 1.8f;
        }
    }
    for (Body& body : scene.bodies) body.position.z -= (z - 1.8f - 8) / 2;
    const vec3 low(-2.6f, 0, -11), high(2.6f, 1.6f, 11);
    Promise promise(all_roll_to_rest("round bodies", bodies, 0.1));
    return awake({std::move(scene), view_of(low, high, 60, 30), low, high, 11, std::move(promise)});
}

}  // namespace scree::demos
