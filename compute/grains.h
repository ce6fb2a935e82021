// Grains: many bodies whose sizes follow a sieve curve, placed in a region at the start or poured into it during a run.
//
// The same grains on every machine: sizes, shapes and places follow from the description and its seed alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "compute/scene.h"

namespace scree {

// A point of a sieve curve. The sieve size of a grain is the side of the smallest square hole that it passes, however it is
// turned, as sieves with square openings measure: of a sphere its diameter.
struct SievePoint {
    float size = 0;     // m, side of the hole
    float passing = 0;  // % of the mass that passes it
};

// ---- shapes; those of a family differ by grain, and all are scaled to the grain's sieve size
struct SphereGrain {};
struct EllipsoidGrain {
    float elongation = 0.75f;  // middle over longest axis, 0.1 to 1
    float flatness = 0.75f;    // shortest over middle axis, 0.1 to 1
};
// A random convex polyhedron. Its box along its own axes has the ratios of sides `elongation` and `flatness`.
struct PolyhedronGrain {
    float elongation = 0.75f;  // middle over longest side, 0.2 to 1
    float flatness = 0.75f;    // shortest over middle side, 0.2 to 1
    float roundness = 0.3f;    // 0: few sharp corners, to 1: many, on an ellipsoid
    // Wadell's: the surface of a ball of equal volume over that of the grain. Given: instead of `roundness`.
    std::optional<float> sphericity{};
    std::uint32_t corners = 16;   // at most, 8 to 64; more take longer to collide
    std::uint32_t variants = 16;  // shapes of the family, 1 to 256
};
struct MeshGrain {             // the convex hull of the user's points
    std::vector<vec3> points;  // m, in any scale
    std::string file{};        // a mesh file, for scene files, in place of `points`
};
using GrainForm = std::variant<SphereGrain, EllipsoidGrain, PolyhedronGrain, MeshGrain>;
struct GrainShape {
    GrainForm form = SphereGrain{};
    float share = 1;  // of the mass, relative to that of the others
};

// ---- where
struct GrainBox {
    vec3 low{0}, high{1};  // m, opposite corners
};
struct GrainCylinder {  // upright
    vec3 base{0};       // m, centre of its lower end
    float radius = 1;   // m
    float height = 1;   // m
};
using GrainRegion = std::variant<GrainBox, GrainCylinder>;
GrainBox box_about(const GrainRegion& region);

struct Grains {
    std::string name{};                // grain 17 is then called "name 17"
    std::vector<SievePoint> sieve{};   // ascending, from 0 to 100 %. Between its points passing grows with the logarithm of size
    float size = 0;                    // m, sieve size of all grains, in place of a curve
    std::vector<GrainShape> shapes{};  // none: spheres
    float density = 2650;              // kg/m^3
    Material material{};
    float rolling = 0;            // adds this part of half the sieve size to each grain's rolling resistance
    std::optional<vec3> color{};  // of pictures
    std::uint64_t seed = 1;
    GrainRegion region = GrainBox{};
    // How many; exactly one is positive.
    float mass = 0;         // kg
    std::size_t count = 0;  // grains
    float fill = 0;         // the volume of all grains over that of the region
    // Poured, if one of the rates is positive: they come into the region in bursts, where they overlap with nothing. Else they
    // are there at the start, apart from one another, in layers from the floor of the region up, and above it as far as they
    // need.
    float mass_rate = 0;    // kg/s
    float count_rate = 0;   // grains/s
    float interval = 0.1f;  // s, between bursts
    vec3 velocity{0};       // m/s, with which they begin
    std::size_t from = 0;   // the first grains that are left out: they came in before a run that this one continues
    bool poured() const { return mass_rate > 0 || count_rate > 0; }
};

// Where the grains of a description go wrong: `pointer` of the SceneError begins with `place`, as "/grains/0".
void check_grains(const Grains& grains, const std::string& place);

// All grains of a description, in the order in which they come: any first part of them follows the curve, too, as nearly as
// whole grains can.
class GrainSupply {
public:
    // Checks them. Throws SceneError likewise, also for more grains than `most`, or than 100 million.
    explicit GrainSupply(const Grains& grains, const std::string& place = "/grains",
                         std::size_t most = static_cast<std::size_t>(-1));
    ~GrainSupply();
    GrainSupply(GrainSupply&&) noexcept;
    GrainSupply& operator=(GrainSupply&&) noexcept;

    const Grains& description() const;
    std::size_t count() const;
    double mass() const;                          // kg, of all
    double mass_before(std::size_t index) const;  // kg, of the first `index` grains
    double sieve_size(std::size_t index) const;   // m
    double largest_reach() const;                 // m, radius of the ball about the largest grain
    // The grain turned at random, with its centre of mass at the origin of the world; checked as by scree::checked.
    Body grain(std::size_t index) const;
    // The grains in the region, at the start. Throws SceneError if it is too narrow for the largest of them.
    void place(const std::function<void(Body)>& take) const;
    double top() const;  // m, of the highest grain that place() made; that of the region if none is above it
    // % of the mass that passes each sieve of the curve, by the grains that there are.
    std::vector<double> passing() const;
    // The largest difference between that and what was asked for, in % of the mass; 0 without a curve.
    double error() const;
    // What a user should know: a curve that so few grains miss by more than 1 %, grains that begin above the region. May be
    // empty.
    std::vector<std::string> notes() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The sieve size of a convex shape (sphere, box, ellipsoid, hull), m; of a hull it is found to a thousandth. Throws
// std::invalid_argument for other shapes.
double sieve_size(const Shape& shape);
// Wadell's sphericity of a hull's points.
double sphericity(std::span<const vec3> points);

}  // namespace scree
