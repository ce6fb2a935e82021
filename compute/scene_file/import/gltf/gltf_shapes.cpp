// Spheres, boxes, capsules, cylinders and planes of glTF, stretched and sheared.
#include "compute/scene_file/import/gltf/gltf_shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/portable_math.h"

namespace scree::imports {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;
constexpr double like_length = 1e-4;  // of lengths, relative
constexpr int hull_sides = 31;        // of a round hull; either end has a corner for each, and hulls have up to 64

bool same_length(double a, double b) {
    return std::abs(a - b) <= like_length * std::max(a, b);
}

// A piece of a solid of revolution about y: the square of its radius, at most quadratic in y.
struct Turned {
    double from, to;
    std::function<double(double)> squared;
};

// By Gauss's rule of three points, which is exact for these.
SolidMass turned_mass(const std::vector<Turned>& pieces) {
    double mass = 0, moment = 0, along = 0, across = 0;
    for (const Turned& piece : pieces) {
        const double half = 0.5 * (piece.to - piece.from), middle = 0.5 * (piece.to + piece.from);
        for (const auto& [at, weight] : {std::pair{-std::sqrt(0.6), 5.0 / 9}, {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}}) {
            const double y = middle + half * at, r = piece.squared(y), area = half * weight * whole_turn / 2 * r;
            mass += area;
            moment += area * y;
            along += area * r / 2;
            across += area * (r / 4 + y * y);
        }
    }
    const double centre = moment / mass;
    across -= mass * centre * centre;
    return {mass, {0, centre, 0}, diagonal({across, along, across})};
}

Turned frustum_piece(double from, double to, double bottom, double top) {
    return {from, to, [=](double y) {
                const double r = bottom + (top - bottom) * (y - from) / (to - from);
                return r * r;
            }};
}
Turned ball_piece(double from, double to, double centre, double radius) {
    return {from, to, [=](double y) { return std::max(0.0, radius * radius - (y - centre) * (y - centre)); }};
}

// What is tangent to both balls of a capsule: the frustum between two circles; none if one ball is within the other.
struct CapsuleSide {
    CapsuleSide(double height, double bottom_ball, double top_ball) {
        const double slope = (bottom_ball - top_ball) / height;
        is_there = std::abs(slope) < 1;
        if (!is_there) return;
        from = -0.5 * height + bottom_ball * slope, to = 0.5 * height + top_ball * slope;
        bottom = bottom_ball * std::sqrt(1 - slope * slope), top = top_ball * std::sqrt(1 - slope * slope);
    }
    bool is_there = false;
    double from = 0, to = 0, bottom = 0, top = 0;  // along y; radii
};

class ShapeMaker {
public:
    ShapeMaker(const ShapeNote& note, const glm::dmat4& frame) : note_(note), frame_(frame) {}

    void add_box(const dvec3& size) {
        if (keeps_right_angles(frame_)) return add(Box{vec3(0.5 * size * scale_of(frame_))}, placed_of(frame_));
        std::vector<dvec3> corners;
        for (int k = 0; k < 8; ++k) corners.push_back(0.5 * size * dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
        add_hull(corners);
        note_("node", "shears the box, which becomes a hull");
    }

    // The image of a ball is an ellipsoid; where the map shears, its axes are the principal ones of the map and its transpose.
    void add_ball(const dvec3& centre, double radius) {
        if (!(radius > 0)) return;
        dvec3 radii = radius * scale_of(frame_);
        dquat turn = placed_of(frame_).turn;
        if (!keeps_right_angles(frame_)) {
            const dmat3 square = radius * radius * dmat3(frame_) * glm::transpose(dmat3(frame_)), axes = principal_axes(square);
            const dmat3 along = glm::transpose(axes) * square * axes;
            radii = glm::sqrt(dvec3(along[0][0], along[1][1], along[2][2]));
            turn = glm::normalize(glm::quat_cast(axes));
        }
        const bool round = same_length(radii.x, radii.y) && same_length(radii.y, radii.z);
        const Placed placed{dvec3(frame_ * glm::dvec4(centre, 1)), turn};
        round ? add(Sphere{static_cast<float>(radii.x)}, placed) : add(Ellipsoid{vec3(radii)}, placed);
    }

    // Between two circles about y. Returns whether it is exact.
    bool add_frustum(double from, double to, double bottom, double top) {
        const dvec3 scale = scale_of(frame_);
        const dvec3 middle(frame_ * glm::dvec4(0, 0.5 * (from + to), 0, 1));
        const Placed placed{middle, placed_of(frame_).turn};
        const double across = scale.x, half = 0.5 * (to - from) * scale.y, larger = std::max(bottom, top);
        const bool round = keeps_right_angles(frame_) && same_length(scale.x, scale.z);
        if (round && same_length(bottom, top)) {
            add(Cylinder{static_cast<float>(bottom * across), static_cast<float>(half)}, placed);
            return true;
        }
        if (round && std::min(bottom, top) <= like_length * larger) {
            // Its centre of mass is a quarter of its height above its base.
            const dquat up = top < bottom ? dquat(1, 0, 0, 0) : dquat(0, 1, 0, 0);
            add(Cone{static_cast<float>(larger * across), static_cast<float>(2 * half)},
                placed * Placed{up * dvec3(0, -0.5 * half, 0), up});
            return true;
        }
        std::vector<dvec3> points;
        // Of polygon and circle.
        const double equal_area = std::sqrt(whole_turn / hull_sides / portable::sin(whole_turn / hull_sides));
        for (int i = 0; i < hull_sides; ++i) {
            const dvec3 out =
                equal_area * dvec3(portable::cos(whole_turn * i / hull_sides), 0, portable::sin(whole_turn * i / hull_sides));
            points.push_back(bottom * out + dvec3(0, from, 0));
            points.push_back(top * out + dvec3(0, to, 0));
        }
        add_hull(points);
        return false;
    }

    // Balls at either end and what is tangent to both.
    void add_capsule(double height, double bottom, double top) {
        const dvec3 scale = scale_of(frame_);
        if (same_length(bottom, top) && keeps_right_angles(frame_) && same_length(scale.x, scale.y) &&
            same_length(scale.y, scale.z))
            return add(Capsule{static_cast<float>(bottom * scale.x), static_cast<float>(0.5 * height * scale.y)},
                       placed_of(frame_));
        const CapsuleSide side(height, bottom, top);
        const bool low = side.is_there || bottom > top, high = side.is_there || !low;
        if (low) add_ball({0, -0.5 * height, 0}, bottom);
        if (high) add_ball({0, 0.5 * height, 0}, top);
        const bool exact = !side.is_there || add_frustum(side.from, side.to, side.bottom, side.top);
        note_("capsule", exact ? "of unlike radii or scales becomes two balls or ellipsoids and what lies between them"
                               : "of unlike radii or scales becomes two balls or ellipsoids, and a hull of 31 sides between");
    }

    // Infinite: its normal maps by the inverse transpose.
    void add_plane() {
        const dvec3 normal = glm::normalize(glm::transpose(glm::inverse(dmat3(frame_))) * dvec3(0, 1, 0));
        add(Plane{vec3(normal), 0}, {dvec3(frame_[3]), {1, 0, 0, 0}});
    }

    GltfShape made;

private:
    void add(const SimpleShape& shape, const Placed& placed) { made.parts.push_back({shape, placed}); }
    void add_hull(const std::vector<dvec3>& points) {
        Hull hull;
        for (const dvec3& point : points) hull.points.push_back(vec3(dmat3(frame_) * point));
        add(hull, {dvec3(frame_[3]), {1, 0, 0, 0}});
    }

    const ShapeNote& note_;
    const glm::dmat4& frame_;
};

SolidMass capsule_mass(double height, double bottom, double top) {
    const CapsuleSide side(height, bottom, top);
    const double larger = std::max(bottom, top), low = -0.5 * height, high = 0.5 * height, at = bottom > top ? low : high;
    if (!side.is_there) return turned_mass({ball_piece(at - larger, at + larger, at, larger)});
    return turned_mass({ball_piece(low - bottom, side.from, low, bottom),
                        frustum_piece(side.from, side.to, side.bottom, side.top), ball_piece(side.to, high + top, high, top)});
}

}  // namespace

GltfShape stretched_shape(const ImplicitShape& shape, const glm::dmat4& frame, const ShapeNote& note) {
    using Kind = ImplicitShape::Kind;
    ShapeMaker shapes(note, frame);
    SolidMass mass;
    const double low = -0.5 * shape.height, high = 0.5 * shape.height;
    if (shape.kind == Kind::sphere) {
        shapes.add_ball(dvec3(0), shape.bottom);
        mass = turned_mass({ball_piece(-shape.bottom, shape.bottom, 0, shape.bottom)});
    } else if (shape.kind == Kind::box) {
        shapes.add_box(shape.size);
        mass = primitive_mass(Box{vec3(0.5 * shape.size)});
    } else if (shape.kind == Kind::plane) {
        shapes.add_plane();
    } else if (shape.kind == Kind::capsule) {
        shapes.add_capsule(shape.height, shape.bottom, shape.top);
        mass = capsule_mass(shape.height, shape.bottom, shape.top);
    } else {
        if (!shapes.add_frustum(low, high, shape.bottom, shape.top))
            note("cylinder", "that tapers, or is unlike wide, deep or upright by its node, makes a hull of 31 sides");
        mass = turned_mass({frustum_piece(low, high, shape.bottom, shape.top)});
    }
    if (mass.mass > 0) shapes.made.mass = stretched_mass(mass, dmat3(frame), dvec3(frame[3]));
    return std::move(shapes.made);
}

GltfShape gltf_shape(GltfValue shape, const glm::dmat4& frame) {
    enum Type : std::size_t { sphere, box, capsule, cylinder, plane, none };
    using Kind = ImplicitShape::Kind;
    static const std::vector<std::string> types = {"sphere", "box", "capsule", "cylinder", "plane"};
    static const Kind kinds[] = {Kind::sphere, Kind::box, Kind::capsule, Kind::cylinder, Kind::plane};
    const std::size_t type = shape.word("type", types, none);
    if (type == none) shape.refuse("has no \"type\"");
    GltfValue sizes = shape.at(types[type].c_str());
    ImplicitShape made;
    made.kind = kinds[type];
    const auto above_0 = [&](const char* key, double value) {
        if (!(value > 0)) sizes.refuse(std::string("\"") + key + "\" must be above 0 m");
        return value;
    };
    if (type == sphere) {
        made.bottom = above_0("radius", sizes.number("radius", 0.5));
    } else if (type == box) {
        const auto given = sizes.numbers("size", 3);
        made.size = given.empty() ? dvec3(1) : dvec3(given[0], given[1], given[2]);
        for (int k = 0; k < 3; ++k) above_0("size", made.size[k]);
    } else if (type == plane) {
        if (sizes.has("sizeX") || sizes.has("sizeZ")) sizes.note("size", "of a plane is left out: it is infinite");
        sizes.number("sizeX", 0), sizes.number("sizeZ", 0);
        if (sizes.flag("doubleSided", false)) sizes.note("doubleSided", "is left out: what lies behind the plane is solid");
    } else {
        made.height = above_0("height", sizes.number("height", 0.5));
        made.bottom = sizes.number("radiusBottom", 0.25), made.top = sizes.number("radiusTop", 0.25);
        if (made.bottom < 0 || made.top < 0) sizes.refuse("a radius is below 0 m");
        above_0("radiusBottom", std::max(made.bottom, made.top));
    }
    GltfShape result =
        stretched_shape(made, frame, [&](const char* kind, const std::string& reason) { sizes.note(kind, reason); });
    sizes.finish();
    shape.finish();
    return result;
}

}  // namespace scree::imports
