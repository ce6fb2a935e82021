// Volumes of cut shapes: balls by the theorem of Gauss and Bonnet, polyhedra by clipping, others by a lattice of points.
#include "compute/measures/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <variant>

#include "compute/measures/ball_in_box.h"
#include "compute/scene/double_quaternion.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/shape_geometry.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double pi = std::numbers::pi;

double volume_of(const Solid& solid) {
    if (solid.ball) {
        const double r = solid.ball->radius;
        return 4.0 / 3.0 * pi * r * r * r;
    }
    if (solid.box) {
        const dvec3 half(solid.box->half_extents);
        return 8 * half.x * half.y * half.z;
    }
    if (solid.hull) return solid.hull->form->volume;
    return double{mass_properties(*solid.other, 1).mass};
}

// How far it reaches from its centre along either side of each of these axes.
dvec3 reach_of(const Solid& solid, const dmat3& axes) {
    if (solid.ball) return dvec3(double{solid.ball->radius});
    dvec3 reach(0);
    for (int k = 0; k < 3; ++k) {
        const dvec3 along(axes[0][k], axes[1][k], axes[2][k]);  // the world's axis in the part's frame
        if (solid.box) {
            reach[k] = glm::dot(glm::abs(along), dvec3(solid.box->half_extents));
        } else if (solid.hull) {
            for (const dvec3& vertex : solid.hull->form->vertices)
                reach[k] = std::max(reach[k], std::abs(glm::dot(vertex, along)));
        } else {
            reach[k] = std::max(reach_along(*solid.other, along), reach_along(*solid.other, -along));
        }
    }
    return reach;
}

// Around the part, in its own frame.
Span box_of(const Solid& solid) {
    Span box{-reach_of(solid, dmat3(1)), reach_of(solid, dmat3(1))};
    for (int k = 0; solid.other && k < 3; ++k) {
        dvec3 along(0);
        along[k] = 1;
        box.upper[k] = reach_along(*solid.other, along);
        box.lower[k] = -reach_along(*solid.other, -along);
    }
    return box;
}

// In the part's frame.
bool holds(const Solid& solid, dvec3 point) {
    if (solid.ball) return glm::dot(point, point) <= double{solid.ball->radius} * double{solid.ball->radius};
    if (solid.box) return true;  // of points within its bounds
    if (solid.hull)
        return std::all_of(solid.hull->form->faces.begin(), solid.hull->form->faces.end(),
                           [&](const HullForm::Face& face) { return glm::dot(face.normal, point) <= face.distance; });
    return contains(*solid.other, vec3(0), vec4(0, 0, 0, 1), vec3(point));
}

// ---- polyhedra
using Polygon = std::vector<dvec3>;
using Polyhedron = std::vector<Polygon>;  // faces, counter-clockwise seen from outside

Polyhedron faces_of(const Solid& solid) {
    Polyhedron faces;
    const auto put = [&](dvec3 corner) { return solid.axes * corner; };  // about the centre
    if (solid.box) {
        const dvec3 half(solid.box->half_extents);
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {1.0, -1.0}) {
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                Polygon& face = faces.emplace_back();
                for (const auto& [a, b] : {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
                    dvec3 corner(0);
                    corner[axis] = side * half[axis];
                    corner[u] = (side > 0 ? a : b) * half[u];
                    corner[v] = (side > 0 ? b : a) * half[v];
                    face.push_back(put(corner));
                }
            }
        return faces;
    }
    const HullForm& form = *solid.hull->form;
    for (const HullForm::Face& face : form.faces) {
        Polygon& made = faces.emplace_back();
        for (const std::uint32_t corner : face.corners) made.push_back(put(form.vertices[corner]));
    }
    return faces;
}

// The part below `limit` along an axis, `side` 1, or above it, -1. A face in the plane is made anew from the edges there.
Polyhedron clipped(const Polyhedron& faces, int axis, double limit, double side) {
    const auto depth = [&](dvec3 point) { return side * (point[axis] - limit); };  // > 0: outside
    Polyhedron kept;
    std::optional<dvec3> middle;  // of the fan of the new face
    Polyhedron lid;
    for (const Polygon& face : faces) {
        if (std::all_of(face.begin(), face.end(), [&](dvec3 point) { return depth(point) == 0; })) continue;
        Polygon part;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const dvec3 from = face[i], to = face[(i + 1) % face.size()];
            const double a = depth(from), b = depth(to);
            if (a <= 0) part.push_back(from);
            if ((a < 0 && b > 0) || (a > 0 && b < 0)) {  // from inside to outside, so that neighbours cut alike
                const dvec3 in = a < 0 ? from : to, out = a < 0 ? to : from;
                const double below = std::min(a, b), above = std::max(a, b);
                dvec3 cut = in + (out - in) * (below / (below - above));
                cut[axis] = limit;
                part.push_back(cut);
            }
        }
        if (part.size() < 3) continue;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const dvec3 from = part[i], to = part[(i + 1) % part.size()];
            if (from[axis] != limit || to[axis] != limit) continue;
            if (!middle) middle = from;
            lid.push_back({*middle, to, from});
        }
        kept.push_back(std::move(part));
    }
    kept.insert(kept.end(), lid.begin(), lid.end());
    return kept;
}

double volume_of(const Polyhedron& faces) {
    double six = 0;
    for (const Polygon& face : faces)
        for (std::size_t i = 2; i < face.size(); ++i) six += glm::dot(face[0], glm::cross(face[i - 1], face[i]));
    return six / 6;
}

double polyhedron_within(const Solid& solid, const Span& box) {
    Polyhedron faces = faces_of(solid);
    for (int axis = 0; axis < 3; ++axis) {
        if (solid.bounds.upper[axis] > box.upper[axis]) faces = clipped(faces, axis, box.upper[axis] - solid.centre[axis], 1);
        if (solid.bounds.lower[axis] < box.lower[axis]) faces = clipped(faces, axis, box.lower[axis] - solid.centre[axis], -1);
    }
    return volume_of(faces);
}

bool is_in(const Span& box, dvec3 point) {
    for (int k = 0; k < 3; ++k)
        if (!(point[k] >= box.lower[k] && point[k] < box.upper[k])) return false;
    return true;
}

}  // namespace

Solid moved(Solid solid, dvec3 shift) {
    solid.centre += shift;
    solid.bounds.lower += shift;
    solid.bounds.upper += shift;
    return solid;
}

std::vector<Solid> solids_of(const Body& body, dvec3 position, vec4 orientation) {
    std::vector<Solid> solids;
    const auto add = [&](const auto& shape, dvec3 centre, const glm::dquat& turn) {
        Solid& made = solids.emplace_back();
        std::visit(
            [&]<class Kind>(const Kind& one) {
                if constexpr (std::is_same_v<Kind, Sphere>)
                    made.ball = &one;
                else if constexpr (std::is_same_v<Kind, Box>)
                    made.box = &one;
                else if constexpr (std::is_same_v<Kind, Hull>)
                    made.hull = &one;
                else
                    made.other = one;
            },
            shape);
        made.centre = centre;
        made.axes = glm::mat3_cast(glm::normalize(turn));
        made.volume = volume_of(made);
        const dvec3 reach = reach_of(made, made.axes);
        made.bounds = {centre - reach, centre + reach};
    };
    const glm::dquat turn = glm::normalize(double_quaternion(orientation));
    const auto* compound = std::get_if<Compound>(&body.shape);
    if (!compound) {
        add(body.shape, position, turn);
        return solids;
    }
    for (const Part& part : compound->parts)
        if (part.role == Role::solid)
            add(part.shape, position + turn * dvec3(part.position), turn * double_quaternion(part.orientation));
    return solids;
}

double volume_within(const Solid& solid, const Span& box) {
    bool whole = true;
    for (int k = 0; k < 3; ++k) {
        if (solid.bounds.lower[k] >= box.upper[k] || solid.bounds.upper[k] <= box.lower[k]) return 0;
        whole = whole && solid.bounds.lower[k] >= box.lower[k] && solid.bounds.upper[k] <= box.upper[k];
    }
    if (whole) return solid.volume;
    if (solid.ball) return ball_in_box(double{solid.ball->radius}, box.lower - solid.centre, box.upper - solid.centre);
    if (solid.box || solid.hull) return std::clamp(polyhedron_within(solid, box), 0.0, solid.volume);
    return volume_where(solid, [&](dvec3 point) { return is_in(box, point); });
}

double volume_where(const Solid& solid, const std::function<bool(dvec3)>& inside) {
    // Points of the sequence R3 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018): whichever way a cut
    // goes, they lie evenly on both sides.
    constexpr int points = 8192;
    constexpr dvec3 stride(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    const Span box = box_of(solid);
    std::size_t all = 0, found = 0;
    dvec3 place(0.5);
    for (int i = 0; i < points; ++i) {
        place += stride;
        place -= glm::floor(place);
        const dvec3 point = box.lower + (box.upper - box.lower) * place;
        if (!holds(solid, point)) continue;
        ++all;
        found += inside(solid.centre + solid.axes * point);
    }
    return all == 0 ? 0 : solid.volume * static_cast<double>(found) / static_cast<double>(all);
}

}  // namespace scree
