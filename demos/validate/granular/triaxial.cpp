// Triaxial compression: grains between six plates, pressed in one direction while the stress across it is held.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compute/measures.h"
#include "compute/scene/portable_math.h"
#include "compute/servo_walls.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

using namespace granular;

namespace {

constexpr std::size_t triaxial_grains = 1000;
constexpr double confining = 2000;                // Pa
constexpr double strain_rate = 0.02, most = 0.3;  // 1/s; axial strain at the end, of the height before
constexpr double steady_from = 0.2;               // strain from which on the angle is that of the critical state
constexpr double bin = 0.01;                      // strain of a mean
constexpr float plate = 2 * d;                    // half its thickness
constexpr double settling = 8;                    // s, of the compression from all sides

// Fixed planes at 0, and plates opposite them that hold a stress; without gravity.
class TriaxialCell {
public:
    TriaxialCell(const GranularLab& lab, Grains grains, std::size_t count)
        : lab_(lab), world_(lab.world(scene_of(grains, count), 120, 8)) {
        for (std::size_t i = 0; i < 3; ++i) request_.bodies.push_back({plates_[i], std::nullopt});
    }

    // From all sides, with little friction, so that the packing is dense; then with friction of 0.5.
    void compress() {
        set_friction(0.1f);
        lab_.run(world_, settling, [&] { hold(0, 3); });
        set_friction(0.5f);
        lab_.run(world_, 1, [&] { hold(0, 3); });
    }
    // Along y, at the strain rate, by `strain`; returns means of the stresses on the plates, Pa.
    std::array<double, 3> shear(double strain, double height) {
        const double speed = strain_rate * height;
        Measuring measuring(request_, world_);
        std::array<double, 3> sums{};
        int steps = 0;
        lab_.run(world_, strain / strain_rate, [&] {
            hold(0, 1);
            hold(2, 3);
            // More than grains can bear, so that the plate moves at its speed.
            const std::array<double, 3> size = sizes();
            world_.set_motor(joints_[1], JointAxis::x,
                             {static_cast<float>(speed), static_cast<float>(100 * confining * size[0] * size[2])});
            const Measures now = measuring.take(world_);
            for (std::size_t i = 0; i < 3; ++i) sums[i] += std::abs(now.bodies[i].force[static_cast<int>(i)]) / area(size, i);
            ++steps;
        });
        for (double& sum : sums) sum /= steps;
        return sums;
    }
    // m, between planes and plates.
    std::array<double, 3> sizes() const {
        const std::vector<BodyState> states = world_.bodies();
        std::array<double, 3> sizes{};
        for (int i = 0; i < 3; ++i)
            sizes[static_cast<std::size_t>(i)] =
                states[plates_[static_cast<std::size_t>(i)]].position[i] - static_cast<double>(plate);
        return sizes;
    }

private:
    static double area(const std::array<double, 3>& size, std::size_t axis) {
        return size[(axis + 1) % 3] * size[(axis + 2) % 3];
    }

    void hold(std::size_t from, std::size_t to) {
        const std::array<double, 3> size = sizes();
        for (std::size_t i = from; i < to; ++i)
            world_.set_motor(joints_[i], JointAxis::x, {0.5f, static_cast<float>(confining * area(size, i))});
    }
    void set_friction(float friction) {
        for (std::size_t i = 0; i < world_.scene().bodies.size(); ++i) {
            if (world_.scene().bodies[i].motion != Motion::dynamic ||
                std::find(plates_.begin(), plates_.end(), i) != plates_.end())
                continue;
            Material material = material_of(world_.scene().bodies[i]);
            material.friction = friction;
            world_.set_material(i, material);
        }
    }
    Scene scene_of(Grains grains, std::size_t count) {
        const auto side = static_cast<float>(std::cbrt(static_cast<double>(count) * std::numbers::pi / 6 * dd * dd * dd / 0.12));
        Scene scene;
        scene.gravity = vec3(0);
        for (int i = 0; i < 3; ++i) {
            vec3 normal(0);
            normal[i] = 1;
            scene.bodies.push_back(wall(normal, 0, 0));
        }
        for (int i = 0; i < 3; ++i) {
            Body body;
            vec3 half(side), at(0.5f * side);
            half[i] = plate;
            at[i] = side + plate;
            body.shape = Box{half};
            body.position = at;
            body.friction = 0;
            body.friction_rule = CombineRule::minimum;
            const auto k = static_cast<std::size_t>(i);
            plates_[k] = scene.bodies.size();
            scene.bodies.push_back(body);
            vec3 axis(0);
            axis[i] = -1;
            joints_[k] = add_servo_wall(scene, {.body = plates_[k],
                                                .axis = axis,
                                                .stress = static_cast<float>(confining),
                                                .area = side * side,
                                                .max_speed = 0.5f,
                                                .gain = 5e-3f});
        }
        for (std::size_t a = 0; a < 6; ++a)
            for (std::size_t b = std::max<std::size_t>(a + 1, 3); b < 6; ++b) scene.exclusions.push_back({a, b});
        grains.region = GrainBox{vec3(0), vec3(side)};
        grains.count = count;
        add_grains(scene, grains);
        return scene;
    }

    const GranularLab& lab_;
    std::array<std::size_t, 3> plates_{}, joints_{};
    MeasureRequest request_;
    World world_;
};

struct Sheared {
    double peak = 0, steady = 0;  // angles of friction, degrees
    double error = 0;             // of the mean stress held, of the asked one
    double dilation = 0;          // volume at the end over that before
    PlotSeries ratio{};           // of the stresses, by strain in %
};

double angle_of(double ratio) {
    return std::asin((ratio - 1) / (ratio + 1)) * 180 / std::numbers::pi;
}

Sheared shear(const GranularLab& lab, const Grains& grains) {
    const double scale = lab.scale(triaxial_grains);
    TriaxialCell cell(lab, grains, static_cast<std::size_t>(static_cast<double>(triaxial_grains) * scale * scale * scale));
    cell.compress();
    const std::array<double, 3> before = cell.sizes();
    Sheared sheared;
    double greatest = 0, sum = 0;
    std::array<double, 2> held{};  // Pa, means
    int steady = 0;
    const int bins = static_cast<int>(std::lround(most / bin));
    for (int i = 0; i < bins; ++i) {
        const std::array<double, 3> stress = cell.shear(bin, before[1]);
        const double across = 0.5 * (stress[0] + stress[2]), ratio = stress[1] / across, strain = (i + 0.5) * bin;
        held[0] += stress[0] / bins;
        held[1] += stress[2] / bins;
        greatest = std::max(greatest, ratio);
        if (strain > steady_from) {
            sum += ratio;
            ++steady;
        }
        sheared.ratio.points.push_back({100 * strain, ratio});
    }
    for (const double stress : held) sheared.error = std::max(sheared.error, std::abs(stress / confining - 1));
    const std::array<double, 3> after = cell.sizes();
    sheared.peak = angle_of(greatest);
    sheared.steady = angle_of(sum / steady);
    sheared.dilation = after[0] * after[1] * after[2] / (before[0] * before[1] * before[2]);
    return sheared;
}

GranularMeasured triaxial(const GranularLab& lab, std::uint64_t seed) {
    const Grains spheres = grains_of(0, seed, 0.5f, GrainBox{});
    Grains stones = spheres;
    stones.shapes = {{PolyhedronGrain{.elongation = 0.75f, .flatness = 0.75f, .roundness = 0.3f, .corners = 14}}};
    Sheared ball = shear(lab, spheres), stone = shear(lab, stones);
    ball.ratio.name = "spheres";
    stone.ratio.name = "polyhedra";
    return {{100 * std::max(ball.error, stone.error), ball.steady, stone.steady, ball.peak - ball.steady,
             stone.peak - stone.steady, stone.dilation},
            {ball.ratio, stone.ratio}};
}

}  // namespace

std::vector<GranularCase> triaxial_cases() {
    return {{.name = "triaxial",
             .title = "grains are compressed along one axis while the stress across it is held: the angle of friction, sin(phi) "
                      "= (s1 - s3) / (s1 + s3)",
             .source =
                 "balls: simulations by Thornton, Geotechnique 50, 43 (2000) and Suiker, Fleck, J. Appl. Mech. 71, 350 (2004); "
                 "angular grains: "
                 "Bolton, Geotechnique 36, 65 (1986), stronger than balls: Azema, Radjai, Saussine, Mech. Mater. 41, 729 (2009)",
             .setup = "grains of 0.9 to 1.1 d, spheres or polyhedra (ratios 0.75, roundness 0.3), without gravity, between six "
                      "plates without "
                      "friction; compressed to 2 kPa from all sides with friction 0.1, so that they are dense; then with "
                      "friction 0.5 by 30% along one axis at "
                      "0.02/s (inertial number 0.002), servo walls holding 2 kPa across; the critical state is that from 20% on; "
                      "120 Hz, 8 substeps",
             .grains = triaxial_grains,
             .figures = {{"error of the stress held, greatest of two sides and both grains, %", "0", 0, 1},
                         {"angle of spheres in the critical state, degrees", "18 to 24", 18, 24},
                         {"angle of polyhedra in the critical state, degrees", "33 (quartz sand) to 40 (feldspar)", 33, 40},
                         {"peak of dense spheres above it, degrees", "above 0", 0, 15},
                         {"peak of dense polyhedra above it, degrees", "above 0", 0, 20},
                         {"volume of dense polyhedra at the end over that before", "above 1", 1, 1.3}},
             .plot = {.x = "axial strain, %",
                      .y = "stress ratio s1 / s3",
                      .lines = {},
                      .points = {},
                      .whole_range = true,
                      .legend_low = true},
             .measure = triaxial}};
}

}  // namespace scree::demos
