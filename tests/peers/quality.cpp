// How well engines keep a scene.
#include "tests/peers/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "compute/scene/meshes/hull.h"
#include "demos/program/outputs/table.h"
#include "tests/peers/race.h"

namespace scree::peers {

namespace {

using dvec3 = glm::dvec3;

dvec3 turned(vec4 q, dvec3 v) {
    const dvec3 u(q.x, q.y, q.z);
    return v + 2.0 * glm::cross(u, glm::cross(u, v) + static_cast<double>(q.w) * v);
}

// A box or hull in the world, m; normals and edges are unit vectors.
struct Solid {
    dvec3 centre;
    double radius = 0;
    std::vector<dvec3> corners, normals, edges;
    bool moves = false;

    std::pair<double, double> span_along(dvec3 direction) const {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const dvec3& corner : corners) {
            const double at = glm::dot(corner, direction);
            low = std::min(low, at);
            high = std::max(high, at);
        }
        return {low, high};
    }
};

// Depth in m by the axis of least overlap (separating axis theorem); at most 0: apart.
double depth_of(const Solid& a, const Solid& b) {
    double least = std::numeric_limits<double>::max();
    const auto along = [&](dvec3 axis) {
        const double length = glm::length(axis);
        if (least <= 0 || length < 1e-3) return;  // of edges that are all but parallel; faces tell as much
        axis /= length;
        const auto [low_a, high_a] = a.span_along(axis);
        const auto [low_b, high_b] = b.span_along(axis);
        least = std::min(least, std::min(high_a - low_b, high_b - low_a));
    };
    along(b.centre - a.centre);  // tells most that are apart
    for (const dvec3& axis : a.normals) along(axis);
    for (const dvec3& axis : b.normals) along(axis);
    for (const dvec3& first : a.edges)
        for (const dvec3& second : b.edges) along(glm::cross(first, second));
    return least;
}

std::optional<Solid> solid_of(const Body& body, const Pose& pose) {
    Solid solid;
    solid.centre = dvec3(pose.position);
    solid.moves = body.motion == Motion::dynamic;
    const auto add_corner = [&](dvec3 v) {
        solid.corners.push_back(solid.centre + turned(pose.orientation, v));
        solid.radius = std::max(solid.radius, glm::length(v));
    };
    if (const auto* box = std::get_if<Box>(&body.shape)) {
        const dvec3 half(box->half_extents);
        for (unsigned k = 0; k < 8; ++k)
            add_corner({k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z});
        for (const dvec3 axis : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)})
            solid.normals.push_back(turned(pose.orientation, axis));
        solid.edges = solid.normals;
        return solid;
    }
    const auto* hull = std::get_if<Hull>(&body.shape);
    if (!hull) return std::nullopt;
    for (const dvec3& v : hull->form->vertices) add_corner(v);
    for (const HullForm::Face& face : hull->form->faces) {
        solid.normals.push_back(turned(pose.orientation, face.normal));
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const std::uint32_t from = face.corners[k], to = face.corners[(k + 1) % face.corners.size()];
            if (from < to)  // each edge once, of the two faces that have it
                solid.edges.push_back(
                    turned(pose.orientation, glm::normalize(hull->form->vertices[to] - hull->form->vertices[from])));
        }
    }
    return solid;
}

double horizontal(vec3 a, vec3 b) {
    return std::hypot(static_cast<double>(a.x) - static_cast<double>(b.x), static_cast<double>(a.z) - static_cast<double>(b.z));
}

// The greatest of `way` over the dynamic bodies.
double greatest_way(const Scene& scene, const std::vector<Pose>& from, const std::vector<Pose>& to, auto way) {
    double most = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].motion == Motion::dynamic)
            most = std::max(most, static_cast<double>(way(from[i].position, to[i].position)));
    return most;
}

}  // namespace

Overlaps overlaps_of(const Scene& scene, const std::vector<Pose>& poses) {
    Overlaps found;
    double sum = 0;
    const auto count = [&](double depth) {
        if (depth <= 0) return;
        ++found.pairs;
        sum += depth;
        found.greatest = std::max(found.greatest, depth);
    };
    std::vector<Solid> solids;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (const auto solid = solid_of(scene.bodies[i], poses[i])) solids.push_back(*solid);
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const Solid& a = solids[i];
        for (std::size_t k = i + 1; k < solids.size(); ++k) {
            const Solid& b = solids[k];
            if ((a.moves || b.moves) && glm::length(a.centre - b.centre) < a.radius + b.radius) count(depth_of(a, b));
        }
        for (const Body& body : scene.bodies) {
            const auto* plane = std::get_if<Plane>(&body.shape);
            if (plane && a.moves) count(static_cast<double>(plane->offset) - a.span_along(dvec3(plane->normal)).first);
        }
    }
    if (found.pairs > 0) found.mean = sum / static_cast<double>(found.pairs);
    return found;
}

std::vector<Keeping> keep(const Scene& scene, const std::vector<std::unique_ptr<Engine>>& engines, int steps) {
    const std::size_t n = engines.size();
    const int last_second = std::max(0, steps - static_cast<int>(std::lround(1 / step_seconds)));
    std::vector<Keeping> all(n);
    std::vector<std::vector<Pose>> start(n), middle(n), before(n);
    for (std::size_t k = 0; k < n; ++k) start[k] = middle[k] = engines[k]->poses();
    for (int i = 0; i < steps; ++i) {
        for (std::size_t turn = 0; turn < n; ++turn) {
            const std::size_t k = (turn + static_cast<std::size_t>(i)) % n;
            if (i >= last_second) before[k] = engines[k]->poses();
            if (i == steps / 2) middle[k] = engines[k]->poses();
            const double begin = processor_ms();
            engines[k]->step();
            all[k].ms += (processor_ms() - begin) / steps;
            if (i < last_second) continue;
            const double way =
                greatest_way(scene, before[k], engines[k]->poses(), [](vec3 a, vec3 b) { return glm::length(a - b); });
            all[k].end_speed = std::max(all[k].end_speed, way / static_cast<double>(step_seconds));
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        const std::vector<Pose> end = engines[k]->poses();
        all[k].name = engines[k]->name();
        all[k].drift = greatest_way(scene, start[k], end, horizontal);
        all[k].late_drift = greatest_way(scene, middle[k], end, horizontal);
        all[k].sinking = greatest_way(scene, start[k], end, [](vec3 a, vec3 b) { return a.y - b.y; });
        all[k].overlaps = overlaps_of(scene, end);
    }
    return all;
}

std::vector<std::unique_ptr<Engine>> keepers(const Scene& scene) {
    std::vector<std::unique_ptr<Engine>> engines;
#ifdef SCREE_PEER_BOX3D
    for (const int substeps : {4, 8}) engines.push_back(make_box3d(scene, substeps));
    // As stiff as substeps allow is an eighth of their rate, and Box3D's default 30 Hz: that of 4 substeps.
    engines.push_back(make_box3d(scene, 8, 60));
#endif
    for (const int substeps : {4, 8, 12}) engines.push_back(make_scree_on_processor(scene, 1, substeps));
    return engines;
}

std::string table_of(const std::vector<Keeping>& all) {
    std::vector<demos::Cells> rows = {{"program", "cpu ms", "ratio", "drift mm", "second half mm", "sinking mm", "penetration mm",
                                       "greatest mm", "end speed mm/s"}};
    for (const Keeping& one : all)
        rows.push_back({one.name, fmt::format("{:.2f}", one.ms), fmt::format("{:.2f}", one.ms / all.front().ms),
                        fmt::format("{:.2f}", one.drift * 1e3), fmt::format("{:.2f}", one.late_drift * 1e3),
                        fmt::format("{:.2f}", one.sinking * 1e3), fmt::format("{:.3f}", one.overlaps.mean * 1e3),
                        fmt::format("{:.2f}", one.overlaps.greatest * 1e3), fmt::format("{:.2f}", one.end_speed * 1e3)});
    return demos::table(rows);
}

std::vector<std::string> keeping_heading() {
    return {"scene",
            "bodies",
            "program",
            "cpu_ms",
            "ratio",
            "drift_m",
            "drift_second_half_m",
            "sinking_m",
            "penetrations",
            "penetration_mean_m",
            "penetration_max_m",
            "end_speed_m_per_s"};
}

std::vector<std::vector<std::string>> csv_rows(const std::string& scene, std::size_t bodies, const std::vector<Keeping>& all) {
    std::vector<std::vector<std::string>> rows;
    for (const Keeping& one : all)
        rows.push_back({scene, std::to_string(bodies), one.name, fmt::format("{:.4f}", one.ms),
                        fmt::format("{:.4f}", one.ms / all.front().ms), fmt::format("{:.6f}", one.drift),
                        fmt::format("{:.6f}", one.late_drift), fmt::format("{:.6f}", one.sinking),
                        std::to_string(one.overlaps.pairs), fmt::format("{:.6f}", one.overlaps.mean),
                        fmt::format("{:.6f}", one.overlaps.greatest), fmt::format("{:.6f}", one.end_speed)});
    return rows;
}

}  // namespace scree::peers
