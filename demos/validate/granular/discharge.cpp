// Grains that flow out of a hole in a flat floor (Beverloo).
#include <array>
#include <cmath>
#include <numbers>

#include "compute/measures.h"
#include "compute/scene/portable_math.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

using namespace granular;

namespace {

constexpr std::size_t flow_grains = 3300;
constexpr float flow_half = 7 * d;
constexpr double flow_height = 15 * dd;
constexpr double empty_annulus = 1.4;                     // Beverloo's k
constexpr std::array<double, 4> openings = {4, 5, 6, 8};  // diameters of the hole, in d

// A floor at y = 0 around a round hole.
Body floor_with_hole(float hole, float outer, float friction) {
    constexpr std::uint32_t sides = 48;
    Mesh mesh;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / sides;
        const vec3 way(portable::cos(angle), 0, portable::sin(angle));
        mesh.vertices.push_back(hole * way);
        mesh.vertices.push_back(outer * way);
    }
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % sides);
        mesh.triangles.emplace_back(a, b, a + 1);
        mesh.triangles.emplace_back(b, b + 1, a + 1);
    }
    Body body;
    body.name = "floor";
    body.motion = Motion::fixed;
    body.shape = std::move(mesh);
    body.friction = friction;
    return body;
}

// Puts grains that have fallen through back on top, so that the flow goes on; one place after the other, in three layers.
class Return {
public:
    Return(float half, float top) : half_(half), top_(top), across_(static_cast<int>(2 * half / (1.4f * d))) {}

    // Returns the mass that came through since the last call.
    double operator()(World& world) {
        const std::vector<BodyState> states = world.bodies();
        std::vector<BodyChange> changes;
        double mass = 0;
        for (std::size_t i = 0; i < states.size(); ++i) {
            const Body& body = world.scene().bodies[i];
            if (body.motion != Motion::dynamic || states[i].position.y > -2 * d) continue;
            mass += volume_of(world.scene(), i) * static_cast<double>(density);
            const int place = 7 * next_++;
            const float pitch = 2 * half_ / static_cast<float>(across_);
            const vec3 at(-half_ + pitch * (static_cast<float>(place % across_) + 0.5f),
                          top_ + 1.3f * d * static_cast<float>(changes.size() % 3),
                          -half_ + pitch * (static_cast<float>(place / across_ % across_) + 0.5f));
            changes.push_back({i, at, {}, vec3(0, -1.5f, 0), vec3(0)});
        }
        if (!changes.empty()) world.set_bodies(changes);
        return mass;
    }

private:
    float half_, top_;
    int across_, next_ = 0;
};

// Mass flow and bulk density at a hole of `hole` d, in units of d: W / (rho sqrt(g d^5)).
double flow_through(const GranularLab& lab, std::uint64_t seed, double hole) {
    const double scale = lab.scale(flow_grains);
    const float half = flow_half * static_cast<float>(scale), height = static_cast<float>(flow_height * scale);
    Scene scene;
    scene.bodies.push_back(floor_with_hole(0.5f * d * static_cast<float>(hole), 1.5f * half, 0.5f));
    add_walls(scene, half, half, 0.5f);
    const double area = 4 * static_cast<double>(half * half);
    add_grains(scene, grains_of(static_cast<std::size_t>(area * static_cast<double>(height) * 0.59 /
                                                         (std::numbers::pi / 6 * dd * dd * dd)),
                                seed, 0.5f, GrainBox{{-half, 0.01f, -half}, {half, height, half}}));
    World world = lab.world(scene, 240, 4);
    Return put_back(half, 1.3f * height);
    int step = 0;
    double mass = 0;
    const auto after_step = [&] {
        if (++step % 8 == 0) mass += put_back(world);
    };
    lab.run(world, 2, after_step);
    mass = 0;
    // In the middle of the bed, beside the flow.
    MeasureRequest request;
    request.regions.push_back({"bed", MeasureBox{{-half, 0.35f * height, -half}, {half, 0.65f * height, half}}});
    Measuring measuring(request, world);
    const double seconds = 3;
    std::vector<double> bulk;
    lab.run(world, seconds, [&] {
        after_step();
        if (step % 60 == 0) bulk.push_back(measuring.take(world).regions[0].solid_fraction * static_cast<double>(density));
    });
    return mass / seconds / (mean_of(bulk) * std::sqrt(g * dd) * dd * dd);
}

GranularMeasured beverloo(const GranularLab& lab, std::uint64_t seed) {
    std::vector<PlotPoint> logarithms, roots;
    std::vector<double> coefficients;
    GranularMeasured measured{{}, {{"measured", {}}}};
    for (const double hole : openings) {
        const double flow = flow_through(lab, seed, hole * lab.scale(flow_grains));
        const double wide = hole * lab.scale(flow_grains);
        logarithms.push_back({portable::log(wide - empty_annulus), portable::log(flow)});
        roots.push_back({wide, portable::pow(flow, 0.4)});
        coefficients.push_back(flow / portable::pow(wide - empty_annulus, 2.5));
        measured.points[0].points.push_back({wide, portable::pow(flow, 0.4)});
    }
    const Line line = fit(roots);
    measured.figures = {fit(logarithms).slope, mean_of(coefficients), -line.offset / line.slope};
    return measured;
}

}  // namespace

std::vector<GranularCase> discharge_cases() {
    PlotOf plot{.x = "diameter of the hole D / d",
                .y = "(W / (rho sqrt(g d^5)))^(2/5)",
                .lines = {{"0.58 (D - 1.4 d)^(5/2)", {}}},
                .points = {}};
    for (const double hole : {1.4, 9.0})
        plot.lines[0].points.push_back({hole, portable::pow(0.58, 0.4) * (hole - empty_annulus)});
    return {
        {.name = "beverloo",
         .title = "grains flow out of a round hole in a flat floor: W = C rho sqrt(g) (D - k d)^(5/2)",
         .source = "Beverloo, Leniger, van de Velde, Chem. Eng. Sci. 15, 260 (1961); C and k of spheres: Nedderman, Statics and "
                   "Kinematics of Granular Materials (1992), ch. 10",
         .setup = "spheres of 0.9 to 1.1 d, friction 0.5, also of walls, in a bin 14 d wide, 15 d high; holes of 4 to 8 d; what "
                  "came out is put back on top; 240 Hz, 4 substeps; mean over 3 s",
         .grains = flow_grains,
         .figures = {{"exponent, with k = 1.4", "2.5", 2.4, 2.6},
                     {"C, with k = 1.4", "0.55 to 0.65", 0.55, 0.65},
                     {"k, with the exponent 2.5", "1 to 2", 1, 2}},
         .plot = plot,
         .measure = beverloo}};
}

}  // namespace scree::demos
