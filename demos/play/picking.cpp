// Which body lies under the pointer: a ray against the bodies' shapes.
#include "demos/play/picking.h"

#include "compute/scene/shape_geometry.h"

namespace scree::demos {

std::optional<Hit> pick(const Scene& scene, const std::vector<BodyState>& states, const Ray& ray) {
    std::optional<Hit> best;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!states[i].there) continue;
        const std::optional<float> at =
            ray_distance(scene.bodies[i].shape, states[i].position, states[i].orientation, ray.from, ray.along);
        if (at && (!best || *at < best->distance)) best = Hit{i, *at, ray.from + ray.along * *at};
    }
    return best;
}

}  // namespace scree::demos
