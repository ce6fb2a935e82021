// Bodies of random shape that fit into a given sphere.
#include "demos/mixture.h"

#include <cmath>

#include "shaders/physics/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float shrunk = 0.995f;  // keeps rounding from letting neighbours touch

}

Body random_box(float reach, Random& random) {
    vec3 half(random.between(0.5f, 1), random.between(0.5f, 1), random.between(0.5f, 1));
    half *= shrunk * reach / glm::length(half);
    Body body;
    body.shape = Box{half};
    body.orientation = random.orientation();
    return body;
}

Body random_mixed(float reach, Random& random) {
    const float kind = random.unit();
    if (kind < 0.5f) return random_box(reach, random);
    Body body;
    body.orientation = random.orientation();
    if (kind < 0.75f) {
        body.shape = Sphere{shrunk * reach * 0.85f};
    } else {
        const float radius = shrunk * reach * random.between(0.4f, 0.6f);
        body.shape = Capsule{radius, shrunk * reach - radius};
    }
    body.rolling_resistance = 0.05f * reach;  // round bodies come to rest as stones do
    return body;
}

namespace {

vec3 random_direction(Random& random) {
    const vec4 turn = random.orientation();
    return physics::upright(turn);
}

// Its first corners lie on all sides: of corners anywhere some stones would be flakes, pressed into the ground by what lies on
// them.
Hull stone(float reach, Random& random) {
    Hull hull;
    const auto corners = 6 + static_cast<int>(random.unit() * 9);
    for (int k = 0; k < corners; ++k) {
        vec3 way = random_direction(random);
        if (k < 6) {
            vec3 side(0);
            side[k / 2] = k % 2 == 0 ? 1.0f : -1.0f;
            way = glm::normalize(side + way * 0.5f);
        }
        hull.points.push_back(way * (reach * random.between(0.75f, 1)));
    }
    return hull;
}

}  // namespace

Body random_assorted(float reach, Random& random) {
    const float kind = random.unit() * 6;
    if (kind < 3) return random_mixed(reach, random);
    Body body;
    body.orientation = random.orientation();
    const float size = shrunk * reach;
    if (kind < 4) {
        const float radius = size * random.between(0.45f, 0.8f);
        body.shape = Cylinder{radius, std::sqrt(size * size - radius * radius)};
        body.rolling_resistance = 0.05f * reach;
    } else if (kind < 5) {
        const float height = size * random.between(0.8f, 1.3f);
        body.shape = Cone{std::sqrt(size * size - 0.0625f * height * height) * 0.8f, height};
        body.rolling_resistance = 0.05f * reach;
    } else {
        body.shape = stone(0.9f * size, random);
    }
    return body;
}

}  // namespace scree::demos
