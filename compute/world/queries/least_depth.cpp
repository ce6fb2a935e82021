// Depth over directions: support functions along a grid of them, then a pattern search (Hooke and Jeeves, 1961).
#include "compute/world/queries/least_depth.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace scree {

namespace {

constexpr std::size_t descents = 4;
constexpr float first_stride = 0.25f, last_stride = 1e-5f;  // rad, nearly

// Directions of whole numbers up to 2: no library function whose last bit differs between machines.
std::vector<glm::vec3> grid_of_directions() {
    std::vector<glm::vec3> grid;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                if (x % 2 != 0 || y % 2 != 0 || z % 2 != 0)  // others are multiples, or 0
                    grid.push_back(glm::normalize(glm::vec3(x, y, z)));
    return grid;
}

struct Direction {
    glm::vec3 normal;
    float distance;  // m, < 0: depth
};

}  // namespace

physics::DistanceBound least_depth(const physics::BodyProperties& a, const physics::Pose& pose_a,
                                   const physics::BodyProperties& b, const physics::Pose& pose_b,
                                   const physics::DistanceBound& found, physics::Hulls hulls) {
    const auto is_solid = [](physics::uint shape) { return shape != physics::SHAPE_PLANE && shape != physics::SHAPE_TRIANGLE; };
    if (!is_solid(a.shape) || !is_solid(b.shape)) return found;
    if (!physics::is_general_convex(a.shape) && !physics::is_general_convex(b.shape)) return found;
    const physics::ConvexShape of_a = physics::convex_shape_of(a, pose_a.orientation, hulls),
                               of_b = physics::convex_shape_of(b, pose_b.orientation, hulls);
    const glm::vec3 between = pose_b.position - pose_a.position;
    const auto along = [&](glm::vec3 normal) {
        const float distance = glm::dot(normal, physics::minkowski_support(of_a, of_b, between, normal, hulls));
        return Direction{normal, distance - (of_a.radius + of_b.radius)};
    };
    static const std::vector<glm::vec3> grid = grid_of_directions();
    std::vector<Direction> tried{{found.normal, found.distance}};
    for (const glm::vec3& normal : grid) tried.push_back(along(normal));
    const auto less_deep = [](const Direction& x, const Direction& y) { return x.distance > y.distance; };
    std::stable_sort(tried.begin() + 1, tried.end(), less_deep);
    Direction best = tried[0];
    for (std::size_t k = 0; k <= descents; ++k) {
        Direction now = tried[k];
        for (float stride = first_stride; stride > last_stride;) {
            const glm::vec3 u =
                glm::normalize(glm::cross(now.normal, std::abs(now.normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
            const glm::vec3 v = glm::cross(now.normal, u);
            Direction next = now;
            for (const glm::vec3& way : {u, v, -u, -v, u + v, u - v, v - u, -u - v}) {
                const Direction one = along(glm::normalize(now.normal + way * stride));
                if (one.distance > next.distance) next = one;
            }
            if (next.distance > now.distance)
                now = next;
            else
                stride *= 0.5f;
        }
        if (now.distance > best.distance) best = now;
    }
    return {best.normal, best.distance};
}

}  // namespace scree
