// Convex hulls by qhull, with ordered faces and mass properties. Of qhull come only the corners of each face: its normals' last
// bits and its faces' order differ between machines.
#include "compute/scene/meshes/hull.h"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "compute/scene/portable_math.h"
#include "shaders/physics/collide/shape_data.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dvec3;

// Relative to the longest extent: thinner hulls have faces that single precision cannot distinguish.
constexpr double flattest = 1e-3;
constexpr double thinnest = 1e-3;  // m, as for other shapes
constexpr double longest = 1e5;    // m, likewise
// Relative to the size: faces this close to coplanar are merged, so that rounding makes no slivers.
constexpr const char* merging = "C-0.0001";

template <class Measure>
double farthest(const std::vector<dvec3>& points, const Measure& measure, dvec3& found) {
    double most = -1;
    for (const dvec3& p : points) {
        const double m = measure(p);
        if (m > most) {
            most = m;
            found = p;
        }
    }
    return most;
}

// Throws for points without volume.
void require_inside(const std::vector<dvec3>& points) {
    dvec3 a{0}, b{0}, c{0}, d{0};
    farthest(
        points, [&](const dvec3& p) { return glm::length(p - points[0]); }, a);
    const double length = farthest(
        points, [&](const dvec3& p) { return glm::length(p - a); }, b);
    if (length < thinnest) throw HullError("all its points lie within 0.001 m");
    if (length > longest) throw HullError("it is more than 100000 m long");
    const dvec3 along = (b - a) / length;
    const double width = farthest(
        points, [&](const dvec3& p) { return glm::length(glm::cross(p - a, along)); }, c);
    if (width < flattest * length) throw HullError("its points lie on a line, to a thousandth of its length");
    const dvec3 normal = glm::normalize(glm::cross(along, c - a));
    const double depth = farthest(
        points, [&](const dvec3& p) { return std::abs(glm::dot(p - a, normal)); }, d);
    if (depth < flattest * length)
        throw HullError("its points lie in a plane, to a thousandth of its length; it needs a thickness");
    if (depth < thinnest) throw HullError("it is thinner than 0.001 m");
}

struct Found {
    std::vector<std::uint32_t> corners;  // indices of points, in any order
    dvec3 normal;                        // nearly
};

// RAII for qhull's state. The C interface: the C++ one of the 2020 release does not compile as C++20.
class Qhull {
public:
    Qhull() : messages_(std::tmpfile()) { qh_zero(&qh_, messages_); }
    ~Qhull() {
        int remaining = 0, blocks = 0;
        qh_freeqhull(&qh_, !qh_ALL);
        qh_memfreeshort(&qh_, &remaining, &blocks);
        if (messages_) std::fclose(messages_);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    std::vector<Found> faces_between(std::vector<dvec3> points, std::string options) {
        options = "qhull " + options;
        if (qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), &points[0].x, False, options.data(), nullptr, messages_) != 0)
            throw HullError("qhull finds no hull around its points; are they nearly in a plane?");
        std::vector<Found> faces;
        for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
            Found& face = faces.emplace_back();
            face.normal = glm::normalize(dvec3(facet->normal[0], facet->normal[1], facet->normal[2]));
            for (const setelemT* e = facet->vertices->e; e->p; ++e) {
                const auto* vertex = static_cast<const vertexT*>(e->p);
                face.corners.push_back(static_cast<std::uint32_t>(qh_pointid(&qh_, vertex->point)));
            }
        }
        return faces;
    }

private:
    std::FILE* messages_;
    qhT qh_;
};

std::vector<Found> faces_between(const std::vector<dvec3>& points, const std::string& options) {
    return Qhull().faces_between(points, options);
}

// Counter-clockwise from outside, from the lowest on; `normal`: nearly that of the face.
void sort_around(HullForm::Face& face, const std::vector<dvec3>& vertices, const dvec3& normal) {
    dvec3 middle(0);
    std::sort(face.corners.begin(), face.corners.end());
    for (const std::uint32_t corner : face.corners) middle += vertices[corner];
    middle /= static_cast<double>(face.corners.size());
    const dvec3 u = glm::normalize(vertices[face.corners[0]] - middle), v = glm::cross(normal, u);
    const auto angle = [&](std::uint32_t corner) {
        const dvec3 arm = vertices[corner] - middle;
        const double at = portable::atan2(glm::dot(arm, v), glm::dot(arm, u));
        return at < 0 ? at + 2 * std::numbers::pi : at;
    };
    std::sort(face.corners.begin() + 1, face.corners.end(), [&](auto x, auto y) { return angle(x) < angle(y); });
}

// The direction of the area within the corners.
dvec3 normal_of(const HullForm::Face& face, const std::vector<dvec3>& vertices) {
    dvec3 area(0);
    const dvec3 from = vertices[face.corners[0]];
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k)
        area += glm::cross(vertices[face.corners[k]] - from, vertices[face.corners[k + 1]] - from);
    return glm::normalize(area);
}

// Volume, centre and second moments, summed over tetrahedra from the origin to each triangle of a face.
void measure(HullForm& form) {
    dvec3 first(0);
    dmat3 second(0);
    for (const HullForm::Face& face : form.faces) {
        for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
            const dvec3 a = form.vertices[face.corners[0]], b = form.vertices[face.corners[k]];
            const dvec3 c = form.vertices[face.corners[k + 1]], sum = a + b + c;
            const double volume = glm::dot(a, glm::cross(b, c)) / 6;
            form.volume += volume;
            first += sum * (volume / 4);
            second +=
                (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) + glm::outerProduct(sum, sum)) *
                (volume / 20);
        }
    }
    form.centre = first / form.volume;
    second -= glm::outerProduct(form.centre, form.centre) * form.volume;
    form.inertia = dmat3(second[0][0] + second[1][1] + second[2][2]) - second;
}

}  // namespace

HullForm hull_form(std::span<const glm::vec3> given) {
    if (given.size() < 4) throw HullError("a hull needs at least 4 points, has " + std::to_string(given.size()));
    dvec3 low(given[0]), high(given[0]);
    for (const glm::vec3& p : given) {
        low = glm::min(low, dvec3(p));
        high = glm::max(high, dvec3(p));
    }
    const dvec3 middle = (low + high) * 0.5;
    std::vector<dvec3> points;
    for (const glm::vec3& p : given) points.push_back(dvec3(p) - middle);
    require_inside(points);
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    for (dvec3& p : points) p /= size;

    std::vector<Found> found = faces_between(points, merging);
    const auto used_by = [&] {
        std::map<std::uint32_t, std::uint32_t> used;
        for (const Found& face : found)
            for (const std::uint32_t corner : face.corners) used.emplace(corner, 0);
        return used;
    };
    HullForm form;
    auto used = used_by();
    if (used.size() > physics::MOST_CORNERS) {
        // qhull adds the farthest points first; it stops after the four of the initial simplex and that many more.
        form.simplified = true;
        found = faces_between(points, std::string(merging) + " TA" + std::to_string(physics::MOST_CORNERS - 4));
        used = used_by();
    }
    for (auto& [point, vertex] : used) {
        vertex = static_cast<std::uint32_t>(form.vertices.size());
        form.vertices.push_back(points[point] * size + middle);
    }
    for (const Found& face : found) {
        if (face.corners.size() < 3) continue;
        HullForm::Face& made = form.faces.emplace_back();
        for (const std::uint32_t corner : face.corners) made.corners.push_back(used.at(corner));
        sort_around(made, form.vertices, face.normal);
        made.normal = normal_of(made, form.vertices);
        made.distance = -1e300;
        for (const dvec3& v : form.vertices) made.distance = std::max(made.distance, glm::dot(made.normal, v));
    }
    std::sort(form.faces.begin(), form.faces.end(), [](const auto& a, const auto& b) { return a.corners < b.corners; });
    measure(form);
    return form;
}

// Jacobi eigenvalue rotations (Golub and Van Loan, Matrix Computations, 8.5), each by the smaller angle, so that axes
// stay near the given ones.
glm::dmat3 principal_axes(const glm::dmat3& inertia) {
    dmat3 a = inertia, axes(1);
    const double scale = a[0][0] + a[1][1] + a[2][2];
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(a[p][q]) <= (sweep == 0 ? 1e-6 : 1e-15) * scale) continue;
                const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                dmat3 turn(1);
                turn[p][p] = turn[q][q] = c;
                turn[q][p] = s;
                turn[p][q] = -s;
                a = glm::transpose(turn) * a * turn;
                axes = axes * turn;
            }
        }
        if (sweep == 0 && axes == dmat3(1)) break;
    }
    return axes;
}

}  // namespace scree
