// Neighbours among the parts of a compound: boxes and hulls that touch or overlap.
#include "compute/compile/seams.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <optional>
#include <variant>

#include "compute/scene/meshes/hull.h"
#include "shaders/physics/collide/seam.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dvec3;

// A polyhedron in the frame of the compound.
struct Polyhedron {
    struct Plane {
        dvec3 normal;
        double distance;
    };
    std::vector<Plane> planes;
    std::vector<dvec3> vertices;
    dvec3 lower{1e300}, upper{-1e300};
    double half_width = 0;  // least, m
};

void append_box(Polyhedron& made, const Box& box) {
    const dvec3 half(box.half_extents);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            dvec3 normal(0);
            normal[axis] = side;
            made.planes.push_back({normal, half[axis]});
        }
    for (int k = 0; k < 8; ++k)
        made.vertices.push_back(half * dvec3((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1));
}

std::optional<Polyhedron> polyhedron_of(const Part& part) {
    Polyhedron made;
    if (part.role != Role::solid) return {};
    if (const auto* box = std::get_if<Box>(&part.shape)) {
        append_box(made, *box);
    } else if (const auto* hull = std::get_if<Hull>(&part.shape)) {
        for (const HullForm::Face& face : hull->form->faces) made.planes.push_back({face.normal, face.distance});
        made.vertices = hull->form->vertices;
    } else {
        return {};
    }
    dvec3 least(1e300), most(-1e300);
    for (const dvec3& v : made.vertices) {
        least = glm::min(least, v);
        most = glm::max(most, v);
    }
    const dvec3 half = 0.5 * (most - least);
    made.half_width = std::min({half.x, half.y, half.z});
    const glm::dquat turn(part.orientation.w, part.orientation.x, part.orientation.y, part.orientation.z);
    const dmat3 axes = glm::mat3_cast(glm::normalize(turn));
    const dvec3 centre(part.position);
    for (Polyhedron::Plane& plane : made.planes) {
        plane.normal = axes * plane.normal;
        plane.distance += glm::dot(plane.normal, centre);
    }
    for (dvec3& v : made.vertices) {
        v = axes * v + centre;
        made.lower = glm::min(made.lower, v);
        made.upper = glm::max(made.upper, v);
    }
    return made;
}

// Whether a face of the one has the other in front of it, further away than `room`.
bool is_before_face(const Polyhedron& one, const Polyhedron& other, double room) {
    return std::any_of(one.planes.begin(), one.planes.end(), [&](const Polyhedron::Plane& plane) {
        return std::all_of(other.vertices.begin(), other.vertices.end(),
                           [&](const dvec3& v) { return glm::dot(plane.normal, v) - plane.distance > room; });
    });
}

bool are_neighbours(const Polyhedron& a, const Polyhedron& b) {
    const double room = static_cast<double>(physics::SEAM_WIDTH) * std::min(a.half_width, b.half_width);
    for (int axis = 0; axis < 3; ++axis)
        if (a.lower[axis] - b.upper[axis] > room || b.lower[axis] - a.upper[axis] > room) return false;
    return !is_before_face(a, b, room) && !is_before_face(b, a, room);
}

physics::uvec4 quad_of(const dvec3& v, double w) {
    const auto bits = [](double x) { return std::bit_cast<physics::uint>(physics::flush_tiny(static_cast<float>(x))); };
    return {bits(v.x), bits(v.y), bits(v.z), bits(w)};
}

// In the frame of that part.
void append_solid(std::vector<physics::uvec4>& records, const Polyhedron& solid, const Part& part) {
    const glm::dquat turn(part.orientation.w, part.orientation.x, part.orientation.y, part.orientation.z);
    const dmat3 back = glm::transpose(glm::mat3_cast(glm::normalize(turn)));
    const dvec3 centre(part.position);
    records.emplace_back(solid.planes.size(), solid.vertices.size(), 0, 0);
    for (const Polyhedron::Plane& plane : solid.planes)
        records.push_back(quad_of(back * plane.normal, plane.distance - glm::dot(plane.normal, centre)));
    for (const dvec3& v : solid.vertices) records.push_back(quad_of(back * (v - centre), 0));
}

// Neighbours of a part, at most: boxes in a grid have 26. Of thousands of parts in one place the records would fill the memory.
constexpr std::size_t most_neighbours = 32;

// Of each part, those that collide with the same bodies; by a sweep along x.
std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<Part>& parts,
                                                    const std::vector<std::optional<Polyhedron>>& solids) {
    std::vector<std::vector<std::size_t>> neighbours(solids.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < solids.size(); ++i)
        if (solids[i]) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(solids[a]->lower.x, a) < std::pair(solids[b]->lower.x, b); });
    const auto is_full = [&](std::size_t i) { return neighbours[i].size() >= most_neighbours; };
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t one = order[k];
        const double end = solids[one]->upper.x + static_cast<double>(physics::SEAM_WIDTH) * solids[one]->half_width;
        for (std::size_t m = k + 1; m < order.size() && solids[order[m]]->lower.x <= end; ++m) {
            const std::size_t other = order[m];
            if ((is_full(one) && is_full(other)) || parts[one].filter != parts[other].filter ||
                !are_neighbours(*solids[one], *solids[other]))
                continue;
            if (!is_full(one)) neighbours[one].push_back(other);
            if (!is_full(other)) neighbours[other].push_back(one);
        }
    }
    for (std::vector<std::size_t>& list : neighbours) std::sort(list.begin(), list.end());
    return neighbours;
}

}  // namespace

std::vector<std::vector<physics::uvec4>> seam_records(const Compound& compound) {
    std::vector<std::optional<Polyhedron>> solids;
    solids.reserve(compound.parts.size());
    for (const Part& part : compound.parts) solids.push_back(polyhedron_of(part));
    const std::vector<std::vector<std::size_t>> neighbours = neighbours_of(compound.parts, solids);
    std::vector<std::vector<physics::uvec4>> all(solids.size());
    for (std::size_t i = 0; i < solids.size(); ++i) {
        if (neighbours[i].empty()) continue;
        double width = solids[i]->half_width;
        for (const std::size_t other : neighbours[i]) width = std::min(width, solids[other]->half_width);
        const auto room = static_cast<float>(static_cast<double>(physics::SEAM_WIDTH) * width);
        all[i].emplace_back(1 + neighbours[i].size(), std::bit_cast<physics::uint>(room), 0, 0);
        append_solid(all[i], *solids[i], compound.parts[i]);
        for (const std::size_t other : neighbours[i]) append_solid(all[i], *solids[other], compound.parts[i]);
    }
    return all;
}

}  // namespace scree
