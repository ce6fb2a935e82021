// Heaps: the slope at which grains come to rest on a table, and how far a column of them runs out (Lube).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "compute/scene/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

using namespace granular;

namespace {

enum class GrainKind { spheres, cubes, irregular };

Grains grains_of_kind(GrainKind kind, std::size_t count, std::uint64_t seed, float friction) {
    Grains grains = grains_of(count, seed, friction, GrainBox{});
    if (kind == GrainKind::cubes) {  // hulls of a cube's corners, for which boxes are taken
        MeshGrain cube;
        for (int k = 0; k < 8; ++k) cube.points.emplace_back(k & 1, k >> 1 & 1, k >> 2 & 1);
        grains.shapes = {{cube}};
    } else if (kind == GrainKind::irregular) {
        grains.shapes = {{PolyhedronGrain{.elongation = 0.75f, .flatness = 0.75f, .roundness = 0.3f, .corners = 14}}};
    }
    return grains;
}

Body grain_of_kind(const GrainSupply& supply, std::size_t index, GrainKind kind) {
    Body body = supply.grain(index);
    if (kind == GrainKind::cubes) body.shape = Box{vec3(0.5f * static_cast<float>(supply.sieve_size(index)))};
    return body;
}

// ---- a heap on a round table of fixed balls, whose edge what is too much falls from
constexpr std::size_t heap_grains = 750;
constexpr float table_radius = 8 * d;

Scene rough_table(float radius) {
    Scene scene;
    const float row = d * std::sqrt(0.75f);
    for (int j = -200; j <= 200; ++j)
        for (int i = -200; i <= 200; ++i) {
            const vec3 at(d * (static_cast<float>(i) + (j % 2 != 0 ? 0.5f : 0)), -0.5f * d, row * static_cast<float>(j));
            if (glm::length(vec3(at.x, 0, at.z)) > radius) continue;
            add_body(scene, Sphere{0.5f * d}, at);
            scene.bodies.back().motion = Motion::fixed;
            scene.bodies.back().friction = 0.5f;
        }
    return scene;
}

// Greatest heights of centres over rings of the width d, each a mean over pieces of 1.5 d, m.
std::vector<PlotPoint> profile_of(const World& world, float radius) {
    const auto pieces_of = [](std::size_t ring) {
        return static_cast<std::size_t>(2 * std::numbers::pi * (static_cast<double>(ring) + 0.5) / 1.5);
    };
    std::vector<std::vector<double>> tops;
    for (std::size_t ring = 0; ring < static_cast<std::size_t>(radius / d); ++ring) tops.emplace_back(pieces_of(ring), 0.0);
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!states[i].exists || world.scene().bodies[i].motion != Motion::dynamic) continue;
        const glm::dvec3 at = states[i].position;
        const auto ring = static_cast<std::size_t>(portable::hypot(at.x, at.z) / dd);
        if (ring >= tops.size()) continue;
        const double turn = portable::atan2(at.z, at.x) / (2 * std::numbers::pi) + 0.5;
        const std::size_t pieces = tops[ring].size();
        double& top = tops[ring][std::min(pieces - 1, static_cast<std::size_t>(turn * static_cast<double>(pieces)))];
        top = std::max(top, at.y);
    }
    std::vector<PlotPoint> profile;
    for (std::size_t ring = 0; ring < tops.size(); ++ring)
        profile.push_back({(static_cast<double>(ring) + 0.5) * dd, mean_of(tops[ring])});
    return profile;
}

std::vector<PlotPoint> heap_of(const GranularLab& lab, std::uint64_t seed, GrainKind kind) {
    const float radius = table_radius * static_cast<float>(lab.scale(heap_grains));
    World world = lab.world(rough_table(radius), 120, 8);
    const std::size_t count = lab.options().bodies > 0 ? lab.options().bodies : heap_grains;
    const GrainSupply supply(grains_of_kind(kind, count, seed, 0.5f));
    SeededRandom random(seed);
    float apex = 0;
    const auto clear_edge = [&] {
        std::vector<BodyHandle> gone;
        const std::vector<BodyState> states = world.bodies();
        apex = 0;
        for (std::size_t i = 0; i < states.size(); ++i) {
            if (!states[i].exists || world.scene().bodies[i].motion != Motion::dynamic) continue;
            const vec3 at = states[i].position;
            if (at.y < -2 * d) gone.push_back(world.handle_of(i));
            if (portable::hypot(at.x, at.z) < 2 * d && glm::length(states[i].velocity) < 0.5f) apex = std::max(apex, at.y);
        }
        if (!gone.empty()) world.remove_bodies(gone);
    };
    // Bursts of up to seven grains, in a hexagon, from 2 d above the top.
    const float burst = 7 * static_cast<float>(lab.scale(heap_grains));
    for (std::size_t next = 0; next < supply.count();) {
        std::vector<Body> grains;
        const float turn = random.between(0, 6.28f);
        for (int k = 0; k < std::max(1, static_cast<int>(burst)) && next < supply.count() && k < 7; ++k) {
            Body body = grain_of_kind(supply, next++, kind);
            const float angle = turn + static_cast<float>(k) * std::numbers::pi_v<float> / 3, out = k == 6 ? 0 : 1.7f * d;
            body.position = {out * portable::cos(angle), apex + 2.5f * d, out * portable::sin(angle)};
            grains.push_back(std::move(body));
        }
        world.add_bodies(grains);
        lab.run(world, 0.17);
        clear_edge();
    }
    lab.run(world, 2);
    clear_edge();
    return profile_of(world, radius);
}

// Degrees, from 2 d beside the axis to 1.5 d within the edge.
double slope_of(const std::vector<PlotPoint>& profile, double radius) {
    std::vector<PlotPoint> flank;
    for (const PlotPoint& point : profile)
        if (point.x > 2 * dd && point.x < radius - 1.5 * dd) flank.push_back(point);
    return -portable::atan(fit(flank).slope) * 180 / std::numbers::pi;
}

GranularMeasured repose(const GranularLab& lab, std::uint64_t seed) {
    GranularMeasured measured;
    const double radius = static_cast<double>(table_radius) * lab.scale(heap_grains);
    for (const auto& [kind, name] : {std::pair(GrainKind::spheres, "spheres"), std::pair(GrainKind::irregular, "irregular"),
                                     std::pair(GrainKind::cubes, "cubes")}) {
        std::vector<PlotPoint> profile = heap_of(lab, seed, kind);
        measured.figures.push_back(slope_of(profile, radius));
        for (PlotPoint& point : profile) {
            point.x /= dd;
            point.y /= dd;
        }
        measured.points.push_back({name, std::move(profile)});
    }
    measured.figures[2] /= measured.figures[0];
    return measured;
}

// ---- the collapse of a column
constexpr std::size_t collapse_grains = 1300;  // of the tallest
constexpr float collapse_radius = 5 * d;
constexpr std::array<double, 3> aspects = {0.6, 1.2, 3};

// A tube without friction, whose faces look inwards.
Body tube(float radius, float height) {
    constexpr std::uint32_t sides = 48;
    Mesh mesh;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / sides;
        const vec3 way(radius * portable::cos(angle), 0, radius * portable::sin(angle));
        mesh.vertices.push_back(way);
        mesh.vertices.push_back(way + vec3(0, height, 0));
    }
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % sides);
        mesh.triangles.emplace_back(a, b, a + 1);
        mesh.triangles.emplace_back(b, b + 1, a + 1);
    }
    Body body;
    body.motion = Motion::fixed;
    body.shape = std::move(mesh);
    body.friction = 0;
    body.friction_rule = CombineRule::minimum;
    return body;
}

struct Collapse {
    double aspect = 0, run_out = 0, height = 0;  // all but the first in radii of the column
};

Collapse collapse_of(const GranularLab& lab, std::uint64_t seed, double aspect) {
    const double scale = lab.scale(collapse_grains);
    const float radius = collapse_radius * static_cast<float>(scale);
    const double r0 = static_cast<double>(radius), area = std::numbers::pi * r0 * r0;
    Grains grains = grains_of_kind(GrainKind::irregular, 100000, seed, 0.5f);
    grains.region = GrainCylinder{{0, 0.01f, 0}, 0.97f * radius, 2.5f * radius};
    // As many as fill the height at a solid fraction of 0.57.
    grains.count = 0;
    grains.mass = static_cast<float>(0.57 * area * aspect * r0) * density;
    Scene scene;
    scene.bodies.push_back(wall({0, 1, 0}, 0, 0.5f));
    scene.bodies.push_back(tube(radius, 10 * static_cast<float>(aspect) * radius + 40 * d));
    add_grains(scene, grains);
    World world = lab.world(scene, 120, 8);
    lab.run(world, 2);
    // Its height: that of the topmost grains in most places.
    std::vector<double> tops;
    for (const PlotPoint& point : profile_of(world, radius)) tops.push_back(point.y + 0.3 * dd);
    const double h0 = mean_of(tops);
    world.remove_body(1);
    lab.run(world, 3);

    Collapse collapse{.aspect = h0 / r0};
    // The edge is where grains cover half of the ground.
    const std::size_t rings = static_cast<std::size_t>(20 * r0 / dd);
    std::vector<double> covered(rings, 0);
    double top = 0;
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!states[i].exists || world.scene().bodies[i].motion != Motion::dynamic) continue;
        const vec3 at = states[i].position;
        const double out = portable::hypot(static_cast<double>(at.x), static_cast<double>(at.z));
        const double size = portable::cbrt(volume_of(world.scene(), i) * 6 / std::numbers::pi);
        const auto ring = static_cast<std::size_t>(out / dd);
        if (ring < rings) covered[ring] += std::numbers::pi / 4 * size * size;
        if (out < 2 * dd) top = std::max(top, static_cast<double>(at.y) + 0.5 * size);
    }
    double before = 1;
    for (std::size_t ring = 0; ring < rings; ++ring) {
        const double share = covered[ring] / (std::numbers::pi * dd * dd * static_cast<double>(2 * ring + 1));
        if (share < 0.5) {
            const double within = (before - 0.5) / (before - share);  // between the middles of two rings
            collapse.run_out = ((static_cast<double>(ring) - 0.5 + within) * dd - r0) / r0;
            break;
        }
        before = share;
    }
    collapse.height = top / r0;
    return collapse;
}

double lube_run_out(double aspect) {
    return aspect < 1.7 ? 1.24 * aspect : 1.6 * std::sqrt(aspect);
}
double lube_height(double aspect) {
    return 0.88 * portable::pow(aspect, 1.0 / 6);
}

GranularMeasured collapses(const GranularLab& lab, std::uint64_t seed) {
    GranularMeasured measured{{}, {{"run-out", {}}, {"height", {}}}};
    std::vector<double> low, tall, heights;
    for (const double aspect : aspects) {
        const Collapse collapse = collapse_of(lab, seed, aspect);
        const double a = collapse.aspect;
        (a < 1.7 ? low : tall).push_back(collapse.run_out / lube_run_out(a));
        if (a >= 1.7) heights.push_back(collapse.height / lube_height(a));
        measured.points[0].points.push_back({a, collapse.run_out});
        measured.points[1].points.push_back({a, collapse.height});
    }
    measured.figures = {mean_of(low), mean_of(tall), mean_of(heights)};
    return measured;
}

}  // namespace

std::vector<GranularCase> heap_cases() {
    GranularCase heap{
        .name = "repose",
        .title = "grains are poured onto a round table, and fall off its edge: the angle of repose",
        .source =
            "spheres: Albert et al., Phys. Rev. E 56, R6271 (1997) and Carrigy, Sedimentology 14, 147 (1970); broken stone and "
            "sand: Carrigy (1970); cubes: steeper than spheres",
        .setup =
            "grains of 0.9 to 1.1 d, friction 0.5, without rolling resistance; cubes; polyhedra (ratios 0.75, roundness 0.3); "
            "dropped from 2 d onto a table of fixed balls, radius 8 d; 120 Hz, 8 substeps",
        .grains = heap_grains,
        .figures = {{"angle of spheres, degrees", "22 to 26", 22, 26},
                    {"angle of irregular grains, degrees", "30 to 40", 30, 40},
                    {"angle of cubes over that of spheres", "above 1", 1, 2.5}},
        .plot = {.x = "distance from the axis / d",
                 .y = "height / d",
                 .lines = {},
                 .points = {},
                 .whole_range = true,
                 .legend_right = true},
        .measure = repose};
    PlotOf plot{.x = "height over radius, a",
                .y = "in radii of the column",
                .lines = {{"run-out: 1.24 a, 1.6 a^(1/2)", {}}, {"height: 0.88 a^(1/6)", {}}},
                .points = {},
                .whole_range = true};
    for (int i = 0; i <= 90; ++i) {
        const double a = 0.05 * i;
        plot.lines[0].points.push_back({a, lube_run_out(a)});
        if (a >= 1.7) plot.lines[1].points.push_back({a, lube_height(a)});
    }
    GranularCase column{
        .name = "collapse",
        .title = "a round column collapses: run-out and height of what lies then",
        .source =
            "Lube, Huppert, Sparks, Hallworth, J. Fluid Mech. 508, 175 (2004): (r - r0) / r0 = 1.24 a below a = 1.7, 1.6 a^(1/2) "
            "above; height 0.88 r0 a^(1/6)",
        .setup =
            "polyhedra of 0.9 to 1.1 d, friction 0.5, also of the ground, in a tube of radius 5 d without friction, which "
            "vanishes; the edge is where grains cover half of the ground; 120 Hz, 8 substeps",
        .grains = collapse_grains,
        .figures = {{"run-out over the law's, a < 1.7", "1", 0.85, 1.15},
                    {"run-out over the law's, a > 1.7", "1", 0.85, 1.15},
                    {"height over the law's, a > 1.7", "1", 0.85, 1.15}},
        .plot = plot,
        .measure = collapses};
    return {heap, column};
}

}  // namespace scree::demos
