// Bodies of random shape that fit into a given sphere.
#include "demos/mixture.h"

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

}  // namespace scree::demos
