// World: ray casts against all bodies at their present poses.
#include <cmath>
#include <stdexcept>

#include "compute/scene/shape_geometry.h"
#include "compute/scene/surface_normal.h"
#include "compute/world/world_impl.h"

namespace scree {

std::optional<RayHit> World::cast_ray(const Ray& ray) const {
    const float length = glm::length(ray.along);
    if (!std::isfinite(glm::dot(ray.from, ray.from)) || !std::isfinite(length) || !(std::abs(length - 1) < 1e-3f))
        throw std::invalid_argument("ray: it must be finite, and its direction of length 1");
    interior_->bring(body_ranges);
    std::optional<RayHit> best;
    for (std::size_t i = 0; i < interior_->scene.bodies.size(); ++i) {
        const BodyState now = interior_->body_state(i);
        if (!now.exists) continue;
        const std::optional<float> at =
            ray_distance(interior_->scene.bodies[i].shape, now.position, now.orientation, ray.from, ray.along);
        if (at && (!best || *at < best->distance)) best = RayHit{i, *at, ray.from + ray.along * *at, vec3(0)};
    }
    if (!best) return std::nullopt;
    const BodyState hit = interior_->body_state(best->body);
    best->normal = surface_normal(interior_->scene.bodies[best->body].shape, hit.position, hit.orientation, ray, best->point);
    return best;
}

}  // namespace scree
