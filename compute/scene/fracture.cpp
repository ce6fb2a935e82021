// Cutting bodies: boxes by halving, other shapes into Voronoi cells.
#include "compute/scene/fracture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <string>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene/voronoi.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr std::size_t most_in_all = 10000;  // fragments of one body on all levels, so that a small scene cannot exhaust memory

// splitmix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u) {}
    double between(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }

private:
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

// ---- boxes: the largest is halved across its longest side until there are enough
std::vector<Body> halved(const Box& box, const Fracture& fracture) {
    struct Part {
        dvec3 centre, half;
    };
    std::vector<Part> parts{{dvec3(0), dvec3(box.half_extents)}};
    Random random(fracture.seed);
    const auto volume = [](const Part& part) { return part.half.x * part.half.y * part.half.z; };
    while (parts.size() < fracture.pieces) {
        const auto largest =
            std::max_element(parts.begin(), parts.end(), [&](const Part& a, const Part& b) { return volume(a) < volume(b); });
        Part &first = *largest, second = first;
        const int axis =
            first.half.y > first.half.x ? (first.half.z > first.half.y ? 2 : 1) : (first.half.z > first.half.x ? 2 : 0);
        const double part = random.between(0.38, 0.62), whole = first.half[axis];
        first.half[axis] = whole * part;
        second.half[axis] = whole * (1 - part);
        first.centre[axis] -= whole * (1 - part);
        second.centre[axis] += whole * part;
        parts.push_back(second);
    }
    std::vector<Body> pieces;
    for (const Part& part : parts) {
        Body piece;
        piece.shape = Box{vec3(part.half)};
        piece.position = vec3(part.centre);
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

// ---- Voronoi cells
// Random points in the region; fewer if the region fills next to nothing of its box. Two Lloyd iterations (1982): cells
// of raw random points are slivers.
std::vector<dvec3> scattered(const Region& region, std::size_t count, Random& random) {
    std::vector<dvec3> points;
    for (std::size_t tries = 0; points.size() < count && tries < 10'000 * count; ++tries) {
        const dvec3 half = region.half;
        // z first: compilers differ in the order in which they take arguments.
        const double z = random.between(-half.z, half.z), y = random.between(-half.y, half.y);
        const dvec3 point(random.between(-half.x, half.x), y, z);
        if (region.holds(point)) points.push_back(point);
    }
    for (int round = 0; round < 2; ++round) {
        const std::vector<Cell> cells = cells_of(region, points);
        if (cells.size() != count) break;
        std::transform(cells.begin(), cells.end(), points.begin(), [](const Cell& cell) { return cell.centre; });
    }
    return points;
}

// Points on rings around the centre, in the plane perpendicular to the thinnest extent.
std::vector<dvec3> ringed(const Region& region, std::size_t count, Random& random) {
    const dvec3 half = region.half;
    const int thin = half.x < half.y ? (half.x < half.z ? 0 : 2) : (half.y < half.z ? 1 : 2);
    const int u = (thin + 1) % 3, v = (thin + 2) % 3;
    std::vector<dvec3> points;
    for (std::size_t tries = 0; points.size() < count && tries < 1000 * count; ++tries) {
        const double part = (static_cast<double>(tries % count) + random.between(0.2, 0.8)) / static_cast<double>(count);
        // A direction by rejection sampling.
        const double x = random.between(-1, 1), y = random.between(-1, 1), length = std::sqrt(x * x + y * y);
        if (length > 1 || length < 0.1) continue;
        dvec3 point(0);
        point[u] = half[u] * part * std::numbers::sqrt2 * (x / length);
        point[v] = half[v] * part * std::numbers::sqrt2 * (y / length);
        if (region.holds(point)) points.push_back(point);
    }
    return points;
}

// Sums over the fragments, at their densities.
struct Together {
    double mass = 0;
    dvec3 centre{0};
    dmat3 spread{0};  // second moments: integral of x x^T over the mass, per mass, about the origin
    dmat3 places{0};  // the part of it due to the fragments' centres
};
// Integrals of x^2, y^2 and z^2 over the mass, from the moments of inertia.
dvec3 squares_of(dvec3 inertia) {
    return dvec3(inertia.y + inertia.z - inertia.x, inertia.x + inertia.z - inertia.y, inertia.x + inertia.y - inertia.z) * 0.5;
}
Together sum_of(const std::vector<Body>& pieces) {
    Together sum;
    for (const Body& piece : pieces) {
        const MassProperties mass = mass_properties(piece.shape, piece.density);
        const double m = mass.mass;
        const dvec3 x(piece.position), own = squares_of(dvec3(mass.inertia));
        sum.mass += m;
        sum.centre += m * x;
        sum.places += m * glm::outerProduct(x, x);
        const glm::dquat turn(piece.orientation.w, piece.orientation.x, piece.orientation.y, piece.orientation.z);
        const dmat3 axes = glm::mat3_cast(glm::normalize(turn));
        for (int axis = 0; axis < 3; ++axis) sum.spread += own[axis] * glm::outerProduct(axes[axis], axes[axis]);
    }
    sum.centre /= sum.mass;
    sum.spread = (sum.spread + sum.places) / sum.mass;
    sum.places /= sum.mass;
    return sum;
}
dmat3 spread_of(const MassProperties& whole) {
    const dvec3 squares = squares_of(dvec3(whole.inertia)) / static_cast<double>(whole.mass);
    dmat3 spread(0);
    for (int axis = 0; axis < 3; ++axis) spread[axis][axis] = squares[axis];
    return spread;
}
double trace(const dmat3& matrix) {
    return matrix[0][0] + matrix[1][1] + matrix[2][2];
}

// The small symmetric E with E P + P E = R for a symmetric P, except along directions in which P vanishes: (1 + E)
// changes second moments P by R.
dmat3 stretch(const dmat3& p, const dmat3& r) {
    const dmat3 axes = principal_axes(p), p_there = glm::transpose(axes) * p * axes;
    dmat3 e = glm::transpose(axes) * r * axes;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            const double lever = p_there[row][row] + p_there[column][column];
            e[row][column] = lever > 0.01 * trace(p) ? e[row][column] / lever : 0;
        }
    return axes * e * glm::transpose(axes);
}

// Moves the fragments so that their inertia matches the body's exactly: corrects for rounding and merged faces, a few
// parts in ten thousand of their size.
void settle(std::vector<Body>& pieces, const MassProperties& whole) {
    const dmat3 wanted = spread_of(whole);
    for (int round = 0; round < 8; ++round) {
        const Together sum = sum_of(pieces);
        const dmat3 change = stretch(sum.places, wanted - sum.spread);
        for (Body& piece : pieces) {
            const dvec3 x = dvec3(piece.position) - sum.centre;
            piece.position = vec3(x + change * x);
        }
    }
}

// The cells as checked bodies: float vertices, nearly coplanar faces merged.
std::vector<Body> bodies_of(const std::vector<Cell>& cells) {
    Scene scene;
    for (const Cell& cell : cells) {
        Hull hull;
        for (const dvec3& corner : cell.corners) hull.points.push_back(vec3(corner));
        scene.bodies.emplace_back().shape = std::move(hull);
    }
    return checked(std::move(scene)).bodies;
}

// Stretches and moves the cells until their total inertia is the body's.
std::vector<Body> fitted(std::vector<Cell> cells, const MassProperties& whole) {
    const dmat3 wanted = spread_of(whole);
    std::vector<Body> best;
    double least = 1e9;
    for (int round = 0; round < 6; ++round) {
        std::vector<Body> pieces = bodies_of(cells);
        const Together sum = sum_of(pieces);
        const dmat3 found = sum.spread - glm::outerProduct(sum.centre, sum.centre);
        const dmat3 change = stretch(found, wanted - found);
        const double off =
            std::sqrt(glm::dot(change[0], change[0]) + glm::dot(change[1], change[1]) + glm::dot(change[2], change[2])) +
            glm::length(sum.centre) / std::sqrt(trace(wanted));
        if (off < least) {
            least = off;
            best = std::move(pieces);
        }
        if (off < 1e-6) break;
        for (Cell& cell : cells)
            for (dvec3& corner : cell.corners) corner = (corner - sum.centre) + change * (corner - sum.centre);
    }
    settle(best, whole);
    return best;
}

std::vector<Body> voronoi(const Shape& shape, const Fracture& fracture) {
    // A fragment has at most 64 vertices; few fragments of a finely approximated ball would have more.
    Region region{planes_of(shape, fracture.pieces >= 12), dvec3(0)};
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            dvec3 direction(0);
            direction[axis] = sign;
            region.half[axis] = std::max(region.half[axis], reach_along(shape, direction));
        }
    // Retries with other points if a cell is too flat for a hull.
    for (std::uint64_t attempt = 0;; ++attempt) {
        Random random(fracture.seed + (attempt << 32));
        const bool across = fracture.cutting == Cutting::splinters;
        const std::vector<dvec3> points =
            across ? ringed(region, fracture.pieces, random) : scattered(region, fracture.pieces, random);
        try {
            const std::vector<Cell> cells = cells_of(region, points);
            if (cells.size() != fracture.pieces) throw SceneError("", "a cell is empty");
            return fitted(cells, mass_properties(shape, 1));
        } catch (const SceneError& error) {
            if (attempt == 7)
                throw FractureError("pieces", "cannot be cut into " + std::to_string(fracture.pieces) + " pieces (" +
                                                  error.what() + "): ask for fewer or another seed");
        }
    }
}

template <class Value>
void add_to_key(std::vector<double>& key, const Value& value) {
    if constexpr (std::is_same_v<Value, float>) {
        key.push_back(static_cast<double>(value));
    } else if constexpr (std::is_same_v<Value, vec3>) {
        key.insert(key.end(), {static_cast<double>(value.x), static_cast<double>(value.y), static_cast<double>(value.z)});
    } else if constexpr (std::is_same_v<Value, std::vector<vec3>>) {
        for (const vec3& point : value) add_to_key(key, point);
    }
}
std::vector<double> key_of(const Shape& shape, const Fracture& f) {
    std::vector<double> key{static_cast<double>(shape.index()), static_cast<double>(f.cutting), static_cast<double>(f.pieces),
                            static_cast<double>(f.depth),       static_cast<double>(f.seed),    static_cast<double>(f.impulse),
                            static_cast<double>(f.momentum)};
    std::visit(
        [&](const auto& one) {
            for_each_shape_field<decltype(one)>([&](const auto& field) { add_to_key(key, one.*field.member); });
        },
        shape);
    return key;
}

// Rules beyond the ranges of the field table (compute/schema/body.h).
void require_sense(const Shape& shape, const Fracture& f) {
    const bool by_impulse = f.impulse > 0 && std::isfinite(f.impulse), by_momentum = f.momentum > 0 && std::isfinite(f.momentum);
    if (by_impulse == by_momentum)
        throw FractureError("", "needs one threshold that is positive: \"impulse\" or \"momentum\", N s");
    if (!simple_shape(shape) || std::holds_alternative<Plane>(shape))
        throw FractureError("",
                            "only a body of one convex shape can break: box, capsule, cone, cylinder, hull, sphere; make the "
                            "parts bodies of their own, held together by joints that break");
    if (f.cutting == Cutting::boxes && !std::holds_alternative<Box>(shape))
        throw FractureError("cutting", "only a box can be cut into boxes; others: \"voronoi\", \"splinters\"");
    std::size_t in_all = 1;
    for (std::size_t level = 0; level < f.depth && in_all <= most_in_all; ++level) in_all *= f.pieces;
    if (in_all > most_in_all)
        throw FractureError("depth", "gives more than 10000 pieces of one body; ask for fewer pieces or less depth");
}

}  // namespace

std::shared_ptr<const Cut> Cuts::of(const Shape& shape, const Fracture& fracture) {
    require_sense(shape, fracture);
    std::shared_ptr<const Cut>& known = made_[key_of(shape, fracture)];
    if (known) return known;
    auto cut = std::make_shared<Cut>();
    const auto* box = std::get_if<Box>(&shape);
    cut->pieces = fracture.cutting == Cutting::boxes ? halved(*box, fracture) : voronoi(shape, fracture);
    const double whole = mass_properties(shape, 1).mass, density = whole / sum_of(cut->pieces).mass;
    cut->all = cut->pieces.size();
    for (Body& piece : cut->pieces) {
        piece.density = static_cast<float>(density * static_cast<double>(piece.density));
        const double part = mass_properties(piece.shape, piece.density).mass / whole;
        if (fracture.depth == 1) continue;
        Fracture deeper = fracture;
        const auto weaker = static_cast<float>(portable::cbrt(part * part));
        deeper.impulse *= weaker;
        deeper.momentum *= weaker;
        deeper.depth = fracture.depth - 1;
        deeper.seed = fracture.seed + 1;
        deeper.cut = of(piece.shape, deeper);
        deeper.first_piece = no_body;
        cut->all += deeper.cut->all;
        piece.fracture = std::move(deeper);
    }
    return made_[key_of(shape, fracture)] = std::move(cut);
}

void add_pieces(Scene& scene) {
    Cuts cuts;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!scene.bodies[i].fracture || scene.bodies[i].fracture->first_piece != no_body) continue;
        const Body whole = scene.bodies[i];
        Fracture& fracture = *scene.bodies[i].fracture;
        const std::string place = "/bodies/" + std::to_string(i);
        const std::string name = whole.name.empty() ? "" : " (body \"" + whole.name + "\")";
        if (whole.motion != Motion::dynamic) throw SceneError(place + "/fracture", "only a dynamic body can break" + name);
        try {
            if (!fracture.cut) fracture.cut = cuts.of(whole.shape, fracture);
        } catch (const FractureError& error) {
            throw SceneError(place + "/fracture" + (*error.key ? "/" : "") + error.key, error.what() + name);
        }
        fracture.first_piece = scene.bodies.size();
        const std::shared_ptr<const Cut> cut = fracture.cut;
        for (const Body& part : cut->pieces) {
            Body piece = whole;
            piece.shape = part.shape;
            piece.density = part.density * whole.density;
            piece.position = whole.position + physics::rotate(whole.orientation, part.position);
            piece.orientation = physics::unit_quaternion(physics::compose(whole.orientation, part.orientation));
            piece.fracture = part.fracture;
            piece.surface_velocity = physics::rotate_back(part.orientation, whole.surface_velocity);
            piece.piece_of = i;
            scene.bodies.push_back(std::move(piece));
        }
    }
}

std::vector<std::size_t> fragments_of(const Scene& scene, std::size_t body) {
    std::vector<std::size_t> found{body};
    for (std::size_t k = 0; k < found.size(); ++k) {
        const std::optional<Fracture>& fracture = scene.bodies[found[k]].fracture;
        if (!fracture || fracture->first_piece == no_body) continue;
        for (std::size_t i = 0; i < fracture->cut->pieces.size(); ++i) found.push_back(fracture->first_piece + i);
    }
    found.erase(found.begin());
    return found;
}

Body on_its_own(Body body) {
    body.piece_of = no_body;
    if (body.fracture) {
        body.fracture->first_piece = no_body;
        body.fracture->cut.reset();
    }
    return body;
}

}  // namespace scree
