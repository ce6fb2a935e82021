// Random bodies within a given bounding sphere.
#include "demos/scenes/random_bodies.h"

#include <cmath>

#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float shrunk = 0.995f;  // margin against contacts between neighbours by rounding

}

Body random_box(float reach, Random& random) {
    vec3 half = random.vector(0.5f, 1);
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
    body.rolling_resistance = 0.05f * reach;  // lets round bodies come to rest
    return body;
}

namespace {

vec3 random_direction(Random& random) {
    const vec4 turn = random.orientation();
    return physics::upright(turn);
}

// The first vertices are on all sides: entirely random ones would give flat flakes, which are pressed into the ground
// by those above.
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

namespace {

// A hammer, a dumbbell, a jack, or two boxes at an angle.
Compound random_compound(float reach, Random& random) {
    const vec4 along_x(0, 0, -0.70710678f, 0.70710678f), along_z(0.70710678f, 0, 0, 0.70710678f);
    const float r = reach * random.between(0.16f, 0.24f), arm = reach - r;
    Compound compound;
    const auto add = [&](SimpleShape shape, vec3 place, vec4 turn = vec4(0, 0, 0, 1)) {
        compound.parts.push_back({std::move(shape), place, turn});
    };
    const float kind = random.unit() * 4;
    if (kind < 1) {
        add(Capsule{0.5f * r, 0.6f * arm}, vec3(0));
        add(Box{vec3(1.6f * r, r, r)}, vec3(0, 0.6f * arm, 0));
    } else if (kind < 2) {
        add(Capsule{0.6f * r, 0.55f * arm}, vec3(0));
        for (const float side : {-1.0f, 1.0f}) add(Sphere{1.6f * r}, vec3(0, side * 0.55f * arm, 0));
    } else if (kind < 3) {
        add(Capsule{r, 0.9f * arm}, vec3(0));
        add(Capsule{r, 0.9f * arm}, vec3(0), along_x);
        add(Capsule{r, 0.9f * arm}, vec3(0), along_z);
    } else {
        add(Box{vec3(0.6f * arm, r, r)}, vec3(0.2f * arm, 0, 0));
        add(Box{vec3(r, 0.4f * arm, r)}, vec3(0.2f * arm - 0.6f * arm + r, 0.4f * arm + r, 0));
        add(Cylinder{r, 0.3f * arm}, vec3(0.2f * arm + 0.6f * arm - r, 0, 0.3f * arm + r), along_z);
    }
    return compound;
}

}  // namespace

Body random_assorted(float reach, Random& random) {
    const float kind = random.unit() * 7;
    if (kind < 3) return random_mixed(reach, random);
    Body body;
    body.orientation = random.orientation();
    const float size = shrunk * reach;
    if (kind < 4) {
        const float radius = size * random.between(0.45f, 0.8f);
        body.shape = Cylinder{radius, std::sqrt(size * size - radius * radius)};
    } else if (kind < 5) {
        const float height = size * random.between(0.8f, 1.3f);
        body.shape = Cone{std::sqrt(size * size - 0.0625f * height * height) * 0.8f, height};
    } else if (kind < 6) {
        body.shape = stone(0.9f * size, random);
    } else {
        body.shape = random_compound(0.8f * size, random);
    }
    body.rolling_resistance = 0.05f * reach;  // a stone that touches in two points swings about them without
    return body;
}

Body random_stone(float reach, Random& random) {
    Body body;
    body.orientation = random.orientation();
    body.shape = stone(shrunk * reach, random);
    return body;
}

}  // namespace scree::demos
