// Shapes of grains: random polyhedra by elongation, flatness and roundness, sphericity, and the smallest hole they pass.
#include "compute/scene/grains/grain_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "compute/scene/error_reason.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/random.h"

namespace scree {

namespace {

using glm::dvec3;

double width(const std::vector<dvec3>& points, const dvec3& axis) {
    double low = glm::dot(points.front(), axis), high = low;
    for (const dvec3& p : points) {
        const double along = glm::dot(p, axis);
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return high - low;
}

// Two unit vectors across each other, the sides of a hole.
struct HoleSides {
    dvec3 a{1, 0, 0}, b{0, 1, 0};
    double hole = 0;
};
HoleSides turned(const HoleSides& sides, const dvec3& axis, double angle) {
    const glm::dquat turn = portable::turn_about(axis, angle);
    const dvec3 a = glm::normalize(turn * sides.a), b = turn * sides.b;
    return {a, glm::normalize(b - a * glm::dot(a, b))};
}

// Directions evenly about the ball: a Fibonacci lattice.
std::vector<dvec3> lattice_directions(int count) {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<dvec3> made;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2 * i + 1.0) / count, across = std::sqrt(1 - y * y);
        made.emplace_back(across * portable::cos(turn * i), y, across * portable::sin(turn * i));
    }
    return made;
}

std::vector<dvec3> random_directions(int count, SeededRandom& random) {
    const double stray = 1.4 / std::sqrt(static_cast<double>(count));
    const vec4 q = random.orientation();
    const glm::dquat turn = glm::normalize(glm::dquat(q.w, q.x, q.y, q.z));
    std::vector<dvec3> made = lattice_directions(count);
    for (dvec3& one : made) one = turn * glm::normalize(one + dvec3(random.vector(-1, 1)) * stray);
    return made;
}

// A polyhedron before it is stretched: few corners, and further ones that come out of its faces as it becomes round.
struct RoughGrain {
    std::vector<dvec3> sharp, others;          // unit directions
    std::vector<double> sharp_way, other_way;  // from the middle, where roundness is 0
};
constexpr int sharp_corners = 6;

RoughGrain rough(const PolyhedronGrain& family, SeededRandom& random) {
    RoughGrain made;
    HullForm form;
    for (bool holds_middle = false; !holds_middle;) {
        made.sharp = random_directions(sharp_corners, random);
        made.sharp_way.clear();
        std::vector<vec3> corners;
        for (const dvec3& way : made.sharp) {
            made.sharp_way.push_back(static_cast<double>(random.between(0.65f, 1)));
            corners.emplace_back(way * made.sharp_way.back());
        }
        try {
            form = hull_form(corners);
        } catch (const HullError&) {  // nearly in a plane
            continue;
        }
        holds_middle = std::ranges::all_of(form.faces, [](const HullForm::Face& face) { return face.distance > 0.15; });
    }
    if (family.corners > sharp_corners) made.others = random_directions(static_cast<int>(family.corners) - sharp_corners, random);
    for (const dvec3& way : made.others) {
        double face = 1;
        for (const HullForm::Face& one : form.faces) {
            const double along = glm::dot(one.normal, way);
            if (along > 0) face = std::min(face, one.distance / along);
        }
        made.other_way.push_back(0.97 * face);
    }
    return made;
}

std::vector<vec3> corners_of(const RoughGrain& rough, const PolyhedronGrain& family, double roundness) {
    std::vector<dvec3> corners;
    const auto add = [&](const dvec3& way, double sharp) { corners.push_back(way * (sharp + (1 - sharp) * roundness)); };
    for (std::size_t i = 0; i < rough.sharp.size(); ++i) add(rough.sharp[i], rough.sharp_way[i]);
    for (std::size_t i = 0; i < rough.others.size(); ++i) add(rough.others[i], rough.other_way[i]);
    const double middle = static_cast<double>(family.elongation),
                 sides[3] = {1, middle, middle * static_cast<double>(family.flatness)};
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 along(0);
        along[axis] = 1;
        const double stretch = sides[axis] / width(corners, along);
        for (dvec3& corner : corners) corner[axis] *= stretch;
    }
    return {corners.begin(), corners.end()};
}

double sphericity_of(const HullForm& form) {
    double area = 0;
    for (const HullForm::Face& face : form.faces)
        for (std::size_t k = 1; k + 1 < face.corners.size(); ++k)
            area += 0.5 * glm::length(glm::cross(form.vertices[face.corners[k]] - form.vertices[face.corners[0]],
                                                 form.vertices[face.corners[k + 1]] - form.vertices[face.corners[0]]));
    const double side = portable::cbrt(6 * form.volume);
    return portable::cbrt(std::numbers::pi) * side * side / area;
}

// The roundness that gives the sphericity asked for.
double roundness_for(const RoughGrain& rough, const PolyhedronGrain& family, const std::string& place) {
    const auto measured = [&](double roundness) { return sphericity_of(hull_form(corners_of(rough, family, roundness))); };
    constexpr double tolerance = 0.04;  // shapes of a family differ
    const double asked = static_cast<double>(*family.sphericity);
    double low = 0, high = 1;
    const double least = measured(low), most = measured(high);
    if (asked < least - tolerance || asked > most + tolerance) {
        const auto text = [](double value) { return std::to_string(std::lround(value * 100) / 100.0).substr(0, 4); };
        throw SceneError(place + "/polyhedron/sphericity",
                         "with this elongation, flatness and number of corners it can be from " + text(least) + " to " +
                             text(most) + "; more corners make rounder grains");
    }
    for (int i = 0; i < 14; ++i) {
        const double middle = 0.5 * (low + high);
        (measured(middle) < asked ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

UnitGrain unit_hull(const std::vector<vec3>& points, const std::string& place) {
    Scene scene;
    scene.bodies.push_back({.shape = Hull{points}});
    try {
        scene = checked(std::move(scene));
    } catch (const SceneError& error) {
        throw SceneError(place, reason_of(error));
    }
    const HullForm& form = *std::get<Hull>(scene.bodies.front().shape).form;
    const double size = smallest_hole(form.vertices);
    UnitGrain made;
    Hull hull;
    for (const dvec3& v : form.vertices) hull.points.emplace_back(v / size);
    made.shape = std::move(hull);
    made.volume = form.volume / (size * size * size);
    return made;
}

std::vector<UnitGrain> unit_polyhedra(const PolyhedronGrain& family, std::uint64_t seed, const std::string& place) {
    std::vector<UnitGrain> made;
    for (std::uint32_t i = 0; i < family.variants; ++i) {
        SeededRandom random(seed, 0x5A5A0000u + i);
        const RoughGrain shape = rough(family, random);
        const double roundness = family.sphericity ? roundness_for(shape, family, place) : static_cast<double>(family.roundness);
        made.push_back(unit_hull(corners_of(shape, family, roundness), place + "/polyhedron"));
    }
    return made;
}

}  // namespace

double smallest_hole(const std::vector<dvec3>& points) {
    const auto measure = [&](HoleSides& sides) { sides.hole = std::max(width(points, sides.a), width(points, sides.b)); };
    constexpr int directions = 120, turns = 12;
    constexpr std::size_t kept = 4;
    std::vector<HoleSides> best;
    for (const dvec3& way : lattice_directions(directions)) {
        const dvec3 other = std::abs(way.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
        HoleSides sides;
        sides.a = glm::normalize(glm::cross(way, other));
        sides.b = glm::cross(way, sides.a);
        HoleSides here = sides;
        measure(here);
        for (int k = 1; k < turns; ++k) {
            HoleSides tried = turned(sides, way, 0.5 * std::numbers::pi * k / turns);
            measure(tried);
            if (tried.hole < here.hole) here = tried;
        }
        const auto place = std::find_if(best.begin(), best.end(), [&](const HoleSides& one) { return here.hole < one.hole; });
        best.insert(place, here);
        if (best.size() > kept) best.pop_back();
    }
    double found = best.front().hole;
    for (HoleSides sides : best) {
        for (double step = 0.15; step > 1e-4;) {
            bool improved = false;
            for (int k = 0; k < 6; ++k) {
                const dvec3 axis = k / 2 == 0 ? sides.a : k / 2 == 1 ? sides.b : glm::cross(sides.a, sides.b);
                HoleSides tried = turned(sides, axis, k % 2 == 0 ? step : -step);
                measure(tried);
                if (tried.hole >= sides.hole) continue;
                sides = tried;
                improved = true;
            }
            if (!improved) step *= 0.5;
        }
        found = std::min(found, sides.hole);
    }
    return found;
}

double sieve_size(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return 2 * static_cast<double>(sphere->radius);
    // The smallest square about an ellipse has the square of its side twice the sum of those of the semi-axes, and the least such
    // sum of all projections is that along the longest axis.
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
        std::array<double, 3> r{static_cast<double>(ellipsoid->radii.x), static_cast<double>(ellipsoid->radii.y),
                                static_cast<double>(ellipsoid->radii.z)};
        std::sort(r.begin(), r.end());
        return std::sqrt(2 * (r[0] * r[0] + r[1] * r[1]));
    }
    std::vector<dvec3> points;
    if (const auto* box = std::get_if<Box>(&shape))
        for (int k = 0; k < 8; ++k)
            points.push_back(dvec3(box->half_extents) * dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    if (const auto* hull = std::get_if<Hull>(&shape)) points.assign(hull->points.begin(), hull->points.end());
    if (points.empty()) throw std::invalid_argument(std::string("a ") + shape_name(shape) + " has no sieve size here");
    return smallest_hole(points);
}

double sphericity(std::span<const vec3> points) {
    return sphericity_of(hull_form(points));
}

std::vector<UnitGrain> unit_grains(const GrainForm& form, std::uint64_t seed, const std::string& place) {
    if (std::holds_alternative<SphereGrain>(form)) return {{Sphere{0.5f}, std::numbers::pi / 6}};
    if (const auto* ellipsoid = std::get_if<EllipsoidGrain>(&form)) {
        const double b = static_cast<double>(ellipsoid->elongation), c = b * static_cast<double>(ellipsoid->flatness);
        const double size = std::sqrt(2 * (b * b + c * c));
        const dvec3 radii = dvec3(1, b, c) / size;
        return {{Ellipsoid{vec3(radii)}, 4 * std::numbers::pi / 3 * radii.x * radii.y * radii.z}};
    }
    if (const auto* polyhedron = std::get_if<PolyhedronGrain>(&form)) return unit_polyhedra(*polyhedron, seed, place);
    const auto& mesh = std::get<MeshGrain>(form);
    // Brought to a size of 1 m, in which thin shapes are judged.
    vec3 low = mesh.points.front(), high = low;
    for (const vec3& p : mesh.points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (!(extent > 0) || !std::isfinite(extent))
        throw SceneError(place + "/mesh", "its points are all in one place, or not finite");
    std::vector<vec3> points;
    for (const vec3& p : mesh.points) points.push_back((p - low) / extent);
    return {unit_hull(points, place + "/mesh")};
}

Shape scaled(const UnitGrain& unit, double size) {
    Shape made = unit.shape;
    if (auto* sphere = std::get_if<Sphere>(&made)) sphere->radius = static_cast<float>(0.5 * size);
    if (auto* ellipsoid = std::get_if<Ellipsoid>(&made)) ellipsoid->radii = vec3(dvec3(ellipsoid->radii) * size);
    if (auto* hull = std::get_if<Hull>(&made))
        for (vec3& p : hull->points) p = vec3(dvec3(p) * size);
    return made;
}

}  // namespace scree
