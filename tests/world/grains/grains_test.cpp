// Grains: sizes by the sieve curve, shapes by what their families promise, places that do not overlap.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "compute/grains.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

const std::vector<SievePoint> ballast{{0.0224f, 0}, {0.0315f, 5}, {0.04f, 45}, {0.05f, 85}, {0.063f, 100}};
const std::vector<SievePoint> gravel{{0.004f, 0}, {0.008f, 20}, {0.016f, 50}, {0.0315f, 100}};

std::vector<std::vector<GrainShape>> kinds() {
    MeshGrain wedge{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
    return {{},
            {{EllipsoidGrain{0.6f, 0.8f}}},
            {{PolyhedronGrain{}}},
            {{SphereGrain{}, 2}, {PolyhedronGrain{.elongation = 0.5f, .roundness = 0}, 1}, {wedge, 1}}};
}

Grains in_a_box(std::vector<SievePoint> sieve, std::size_t count) {
    Grains grains;
    grains.sieve = std::move(sieve);
    grains.count = count;
    grains.region = GrainBox{{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}};
    return grains;
}

std::vector<Body> placed(const GrainSupply& supply) {
    std::vector<Body> bodies;
    supply.place([&](Body body) { bodies.push_back(std::move(body)); });
    return bodies;
}

// Of the bodies themselves, by their own shapes and masses.
double measured_passing(const std::vector<Body>& bodies, double size) {
    std::map<const HullForm*, double> known;  // hulls are shared
    double passing = 0, all = 0;
    for (const Body& body : bodies) {
        const double mass = static_cast<double>(mass_properties(body).mass);
        const auto* hull = std::get_if<Hull>(&body.shape);
        double own = 0;
        if (!hull) own = sieve_size(body.shape);
        if (hull) {
            double& kept = known[hull->form.get()];
            if (kept == 0) kept = sieve_size(body.shape);
            own = kept;
        }
        all += mass;
        if (own <= size * (1 + 1e-3)) passing += mass;
    }
    return 100 * passing / all;
}

std::string refusal(const Grains& grains) {
    return tests::refusal_of([&] { placed(GrainSupply(grains, "/grains/3")); });
}

}  // namespace

TEST_CASE("grains follow their sieve curve within 1 %, and so does what has come of them so far", "[grains]") {
    for (const auto& curve : {ballast, gravel})
        for (const auto& shapes : kinds())
            for (const std::uint64_t seed : {1u, 2u, 77u})
                for (const std::size_t count : {std::size_t{2000}, std::size_t{20000}}) {
                    Grains grains = in_a_box(curve, count);
                    grains.shapes = shapes;
                    grains.seed = seed;
                    const GrainSupply supply(grains);
                    CAPTURE(shapes.size(), seed, count);
                    REQUIRE(supply.count() == count);
                    // The widest curve has few large grains among 2,000.
                    CHECK((supply.error() <= 1 || (curve.size() == gravel.size() && count == 2000)));
                    CHECK((supply.error() <= 1) == supply.notes().empty());
                    const std::vector<double> all = supply.passing();
                    REQUIRE(all.size() == curve.size());
                    CHECK(all.front() == 0);
                    CHECK(all.back() == Approx(100));
                    double half = 0;  // of the first half of the mass
                    for (std::size_t i = 0; i < count / 2; ++i)
                        if (supply.sieve_size(i) <= static_cast<double>(curve[2].size))
                            half += supply.mass_before(i + 1) - supply.mass_before(i);
                    if (count == 20000)
                        CHECK(100 * half / supply.mass_before(count / 2) ==
                              Approx(static_cast<double>(curve[2].passing)).margin(1));
                }
}

TEST_CASE("the curve of grains is that of the bodies' own shapes and masses", "[grains]") {
    for (const auto& shapes : kinds()) {
        Grains grains = in_a_box(ballast, 4000);
        grains.shapes = shapes;
        const std::vector<Body> bodies = placed(GrainSupply(grains));
        for (const SievePoint& point : ballast) {
            CAPTURE(point.size);
            CHECK(measured_passing(bodies, static_cast<double>(point.size)) ==
                  Approx(static_cast<double>(point.passing)).margin(1));
        }
    }
}

TEST_CASE("few grains cannot follow a curve, and say so", "[grains]") {
    const GrainSupply few(in_a_box(ballast, 12));
    CHECK(few.error() > 1);
    REQUIRE(few.notes().size() == 1);
    CHECK_THAT(few.notes().front(), Catch::StartsWith("/grains: 12 grains miss the sieve curve by "));
    CHECK(GrainSupply(in_a_box(ballast, 5000)).notes().empty());
    // Between the points of a curve, too: none of these is as large as the largest tenth is to be.
    const GrainSupply wide(in_a_box({{0.002f, 0}, {0.05f, 100}}, 1000));
    CHECK(wide.error() > 10);
    CHECK(wide.notes().size() == 1);
}

TEST_CASE("grains have the mass, or fill the volume, that is asked for", "[grains]") {
    Grains grains = in_a_box(ballast, 0);
    grains.mass = 500;
    grains.density = 1800;
    const GrainSupply supply(grains);
    CHECK(supply.mass() == Approx(500).epsilon(0.001));
    double mass = 0;
    for (const Body& body : placed(supply)) mass += static_cast<double>(mass_properties(body).mass);
    CHECK(mass == Approx(supply.mass()).epsilon(1e-5));
    grains.mass = 0;
    grains.fill = 0.5f;
    CHECK(GrainSupply(grains).mass() == Approx(900).epsilon(0.001));
    grains.region = GrainCylinder{{0, 0, 0}, 0.5f, 2};
    CHECK(GrainSupply(grains).mass() == Approx(900 * 1.5708).epsilon(0.001));
}

TEST_CASE("the sieve size of a grain is the smallest square hole that it passes", "[grains]") {
    CHECK(sieve_size(Sphere{0.25f}) == Approx(0.5));
    CHECK(sieve_size(Ellipsoid{{0.9f, 0.25f, 0.25f}}) == Approx(0.5));
    CHECK(sieve_size(Box{{0.9f, 0.25f, 0.25f}}) == Approx(0.5).epsilon(1e-3));  // lengthwise, a square
    CHECK(sieve_size(Box{vec3(0.5f)}) == Approx(1).epsilon(1e-3));
    // A plate goes through along the diagonal: its side and thickness over the square root of 2.
    CHECK(sieve_size(Box{{1, 0.5f, 0.01f}}) == Approx(1.02 / std::sqrt(2.0)).epsilon(1e-3));
    CHECK_THROWS_AS(sieve_size(Plane{}), std::invalid_argument);
    // An ellipsoid by its own points.
    Hull hull;
    const vec3 radii(0.5f, 0.4f, 0.3f);
    for (int i = 0; i < 400; ++i) {
        const double y = 1 - (2 * i + 1.0) / 400, across = std::sqrt(1 - y * y);
        hull.points.push_back(radii * vec3(across * std::cos(2.399963 * i), y, across * std::sin(2.399963 * i)));
    }
    CHECK(sieve_size(hull) == Approx(sieve_size(Ellipsoid{radii})).epsilon(0.01));
}

TEST_CASE("polyhedra have the sphericity asked for, and are rounder the more round they are to be", "[grains]") {
    const auto mean = [](const PolyhedronGrain& family) {
        Grains grains;
        grains.size = 0.05f;
        grains.count = family.variants;
        grains.shapes = {{family}};
        double sum = 0;
        for (const Body& body : placed(GrainSupply(grains))) sum += sphericity(std::get<Hull>(body.shape).points);
        return sum / family.variants;
    };
    CHECK(mean({.sphericity = 0.8f}) == Approx(0.8).margin(0.005));
    CHECK(mean({.elongation = 1, .flatness = 1, .sphericity = 0.9f, .corners = 32}) == Approx(0.9).margin(0.005));
    double before = 0;
    for (const float roundness : {0.0f, 0.3f, 0.6f, 1.0f}) {
        const double now = mean({.roundness = roundness});
        CHECK(now > before);
        before = now;
    }
    Grains impossible = in_a_box(ballast, 10);
    impossible.shapes = {{PolyhedronGrain{.sphericity = 0.99f}}};
    CHECK_THAT(refusal(impossible), Catch::StartsWith("/grains/3/shapes/0/form/polyhedron/sphericity: with this elongation"));
}

TEST_CASE("grains begin apart from one another, inside the walls of their region", "[grains]") {
    for (const auto& shapes : kinds()) {
        Grains grains = in_a_box(ballast, 600);
        grains.shapes = shapes;
        const bool round = shapes.empty();
        if (round) grains.region = GrainCylinder{{1, 2, 3}, 0.3f, 0.5f};
        Scene scene;
        scene.bodies = placed(GrainSupply(grains));
        const World world(scene);
        std::vector<ShapeOverlap> itself;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            const Body& body = scene.bodies[i];
            itself.push_back({.shape = body.shape, .position = body.position, .orientation = body.orientation, .ignored = i});
            const vec3 from = round ? body.position - vec3(1, 2, 3) : body.position;
            if (round)
                CHECK(from.x * from.x + from.z * from.z < 0.09f);
            else
                CHECK((std::abs(from.x) < 0.5f && std::abs(from.z) < 0.5f));
            CHECK(from.y > 0);
        }
        CHECK(world.overlaps(itself).items.empty());
    }
}

TEST_CASE("grains have the same bits everywhere", "[grains]") {
    std::uint64_t hash = 1469598103934665603u;
    const auto add = [&](const auto& value) {
        unsigned char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
    };
    for (const auto& shapes : kinds()) {
        Grains grains = in_a_box(ballast, 500);
        grains.shapes = shapes;
        for (const Body& body : placed(GrainSupply(grains))) {
            add(body.position);
            add(body.orientation);
            if (const auto* hull = std::get_if<Hull>(&body.shape))
                for (const vec3& point : hull->points) add(point);
            if (const auto* sphere = std::get_if<Sphere>(&body.shape)) add(sphere->radius);
            if (const auto* ellipsoid = std::get_if<Ellipsoid>(&body.shape)) add(ellipsoid->radii);
        }
    }
    CHECK(hash == 0x72fefb05d5f7fca9u);
    Grains other = in_a_box(ballast, 500);
    const auto place = [](const Grains& grains) { return placed(GrainSupply(grains)).back().position; };
    const vec3 one = place(other);
    CHECK(place(other) == one);
    other.seed = 2;
    CHECK(place(other) != one);
}

TEST_CASE("grains that cannot be are refused with their place", "[grains]") {
    const auto with = [](auto change) {
        Grains grains = in_a_box(ballast, 100);
        change(grains);
        return refusal(grains);
    };
    CHECK_THAT(with([](Grains& g) { g.sieve.clear(); }), Catch::StartsWith("/grains/3: needs either \"sieve\""));
    CHECK_THAT(with([](Grains& g) { g.size = 1; }), Catch::StartsWith("/grains/3: needs either \"sieve\""));
    CHECK_THAT(with([](Grains& g) { g.sieve.resize(1); }), Catch::StartsWith("/grains/3/sieve: a curve has at least 2"));
    CHECK_THAT(with([](Grains& g) { g.sieve[1].size = 0.01f; }), Catch::StartsWith("/grains/3/sieve/1/size: must be above"));
    CHECK_THAT(with([](Grains& g) { g.sieve[2].passing = 2; }), Catch::StartsWith("/grains/3/sieve/2/passing: must not be"));
    CHECK_THAT(with([](Grains& g) { g.sieve[0].passing = 2; }), Catch::StartsWith("/grains/3/sieve/0/passing: must be 0"));
    CHECK_THAT(with([](Grains& g) { g.sieve.back().passing = 98; }), Catch::StartsWith("/grains/3/sieve/4/passing: must be 100"));
    CHECK_THAT(with([](Grains& g) { g.sieve[1].size = NAN; }), Catch::StartsWith("/grains/3/sieve/1/size: must be"));
    CHECK_THAT(with([](Grains& g) { g.mass = 3; }), Catch::StartsWith("/grains/3: needs exactly one of"));
    CHECK_THAT(with([](Grains& g) { g.count = 0; }), Catch::StartsWith("/grains/3: needs exactly one of"));
    for (const bool by_mass : {false, true})
        CHECK_THAT(with([=](Grains& g) {
                       g.count = by_mass ? 0 : 4'000'000'000u;
                       g.mass = by_mass ? 1e15f : 0;
                   }),
                   Catch::StartsWith("/grains/3: these are more than 100000000 grains"));
    CHECK_THAT(with([](Grains& g) { g.shapes.assign(9, {PolyhedronGrain{.variants = 256}}); }),
               Catch::StartsWith("/grains/3/shapes: all variants in all intervals of the curve are 73728 hulls"));
    CHECK_THAT(with([](Grains& g) { g.from = 3; }), Catch::StartsWith("/grains/3/from: is of poured"));
    CHECK_THAT(with([](Grains& g) { g.density = -1; }), Catch::StartsWith("/grains/3/density: must be"));
    CHECK_THAT(with([](Grains& g) {
                   g.region = GrainBox{{0, 0, 0}, {1, 0, 1}};
               }),
               Catch::StartsWith("/grains/3/region/box/upper"));
    CHECK_THAT(with([](Grains& g) {
                   g.region = GrainBox{{0, 0, 0}, {1, 1, 0.05f}};
               }),
               Catch::StartsWith("/grains/3/region: is too narrow for its largest grain"));
    CHECK_THAT(with([](Grains& g) {
                   g.region = GrainCylinder{{0, 0, 0}, 0.02f, 1};
               }),
               Catch::StartsWith("/grains/3/region: is too narrow for its largest grain"));
    CHECK_THAT(with([](Grains& g) {
                   g.shapes = {{MeshGrain{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}};
               }),
               Catch::StartsWith("/grains/3/shapes/0/form/mesh: needs a file, or at least 4 points"));
    CHECK_THAT(with([](Grains& g) {
                   g.shapes = {{MeshGrain{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}}};
               }),
               Catch::StartsWith("/grains/3/shapes/0/form/mesh: its points lie in a plane"));
    CHECK_THAT(with([](Grains& g) { g.shapes = {{PolyhedronGrain{.corners = 3}}}; }),
               Catch::StartsWith("/grains/3/shapes/0/form/polyhedron/corners: must be between 8 and 64"));
    CHECK_THAT(with([](Grains& g) {
                   g.sieve = {{1e-4f, 0}, {2e-4f, 100}};
               }),
               Catch::StartsWith("/grains/3/shapes/0/form: a grain of this shape and a size of"));
}
