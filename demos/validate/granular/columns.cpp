// Columns of grains between walls: the weight that their stress bears, and how friction at the walls takes it over (Janssen).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/measures.h"
#include "compute/scene/portable_math.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

using namespace granular;

namespace {

constexpr std::size_t yy = 4, xx = 0, zz = 8;  // of a tensor
constexpr double spheres_pack = 0.6;           // solid fraction, about, for the number of grains that fill a height

std::size_t grains_in(double volume, double solid_fraction = spheres_pack) {
    return static_cast<std::size_t>(std::max(8.0, std::round(volume * solid_fraction / (std::numbers::pi / 6 * dd * dd * dd))));
}

// Means over time of what slices of a column bear.
struct Slices {
    Slices(float half, float low, int count)
        : area(4 * static_cast<double>(half) * static_cast<double>(half)),
          lower(static_cast<double>(low)),
          vertical(static_cast<std::size_t>(count)),
          across(vertical.size()),
          weight(vertical.size()) {
        request.grid =
            MeasureGrid{{-half, low, -half}, {half, low + d * static_cast<float>(count), half}, {2 * half, d, 2 * half}};
    }
    void take(const World& world, Measuring& measuring) {
        const Measures now = measuring.take(world);
        for (std::size_t i = 0; i < vertical.size(); ++i) {
            vertical[i] += now.grid[i].stress[yy];
            across[i] += 0.5 * (now.grid[i].stress[xx] + now.grid[i].stress[zz]);
            weight[i] += now.grid[i].solid_fraction * dd * static_cast<double>(density) * g;
        }
        loads.resize(now.bodies.size());
        for (std::size_t i = 0; i < loads.size(); ++i) loads[i] += now.bodies[i].force;
        ++taken;
    }
    void finish() {
        for (auto* values : {&vertical, &across, &weight})
            for (double& value : *values) value /= taken;
        for (glm::dvec3& load : loads) load /= taken;
    }
    // Pa, of all that is above the middle of a slice.
    double above(std::size_t slice) const {
        double sum = 0.5 * weight[slice];
        for (std::size_t i = slice + 1; i < weight.size(); ++i) sum += weight[i];
        return sum;
    }
    // N/m^3, of the slices that are full: below the `full` topmost layers of the grains.
    double bulk_weight(double height) const {
        double sum = 0;
        int count = 0;
        for (std::size_t i = 1; i < weight.size() && static_cast<double>(i + 1) * dd < height - 2 * dd; ++i, ++count)
            sum += weight[i] / dd;
        return count > 0 ? sum / count : NAN;
    }

    double area, lower;
    std::vector<double> vertical, across, weight;  // Pa
    std::vector<glm::dvec3> loads;                 // N
    MeasureRequest request;
    int taken = 0;
};

// ---- a column between walls without friction
constexpr std::size_t column_grains = 825;
constexpr float column_half = 3 * d;
constexpr double column_height = 20 * dd;

GranularMeasured settled_column(const GranularLab& lab, std::uint64_t seed) {
    const float half = column_half * static_cast<float>(lab.scale(column_grains));
    const double height = column_height * lab.scale(column_grains);
    Scene scene;
    scene.bodies.push_back(wall({0, 1, 0}, 0, 0.5f));
    add_walls(scene, half, half, 0);
    const double volume = add_grains(scene, grains_of(grains_in(height * 4 * static_cast<double>(half * half)), seed, 0.5f,
                                                      GrainBox{{-half, 0, -half}, {half, static_cast<float>(height), half}}));
    World world = lab.world(scene, 120, 12);
    lab.run(world, 6);
    Slices slices(half, 0, static_cast<int>(std::ceil(1.15 * height / dd)));
    slices.request.bodies.push_back({0, {}});
    Measuring measuring(slices.request, world);
    lab.run(world, 0.5, [&] { slices.take(world, measuring); });
    slices.finish();

    const double rho_g = slices.bulk_weight(height);
    const double deep =
        volume * static_cast<double>(density) * g / slices.area / rho_g;  // m, of the grains, without voids on top
    GranularMeasured measured{{}, {{"", {}}}};
    std::vector<double> of_weight, of_depth;
    double worst = 0;
    for (std::size_t i = 0; i < slices.vertical.size(); ++i) {
        const double depth = deep - (static_cast<double>(i) + 0.5) * dd;
        if (depth < 0) break;
        if (depth < 2 * dd) continue;
        measured.points[0].points.push_back({depth / dd, slices.vertical[i] / (rho_g * depth)});
        of_weight.push_back(slices.vertical[i] / slices.above(i));
        of_depth.push_back(slices.vertical[i] / (rho_g * depth));
        worst = std::max(worst, std::abs(of_weight.back() - 1));
    }
    std::reverse(measured.points[0].points.begin(), measured.points[0].points.end());
    measured.figures = {mean_of(of_depth), 100 * worst, -slices.loads[0].y / (volume * static_cast<double>(density) * g)};
    return measured;
}

// ---- a silo, filled gently, whose floor then sinks
constexpr std::size_t silo_grains = 2930;
constexpr float silo_half = 4 * d;
constexpr double silo_height = 40 * dd, silo_friction = 0.5, sinking = 0.05;

// Of the slices that bear more than a few layers, and lie above the lowest ones.
double ratio_of_stresses(const Slices& slices, double rho_g) {
    std::vector<double> ratios;
    for (std::size_t i = 4; i < slices.vertical.size() && slices.above(i) > 3 * rho_g * dd; ++i)
        ratios.push_back(slices.across[i] / slices.vertical[i]);
    return mean_of(ratios);
}

Slices slices_of(const GranularLab& lab, World& world, float half, double height, double seconds) {
    Slices slices(half, world.body(0).position.y, static_cast<int>(std::ceil(1.2 * height / dd)) + 1);
    for (std::size_t body = 0; body < 5; ++body) slices.request.bodies.push_back({body, {}});
    Measuring measuring(slices.request, world);
    int step = 0;
    lab.run(world, seconds, [&] {
        if (++step % 4 == 0) slices.take(world, measuring);
    });
    slices.finish();
    return slices;
}

GranularMeasured silo(const GranularLab& lab, std::uint64_t seed) {
    const double scale = lab.scale(silo_grains), height = silo_height * scale;
    const float half = silo_half * static_cast<float>(scale);
    const double width = 2 * static_cast<double>(half);
    Scene scene;
    Body floor;
    floor.motion = Motion::kinematic;
    floor.shape = Box{{half + d, d, half + d}};
    floor.position = {0, -d, 0};
    floor.friction = 0.5f;
    scene.bodies.push_back(floor);
    add_walls(scene, half, half, static_cast<float>(silo_friction));
    World world = lab.world(scene, 120, 12);
    pour(lab, world, grains_of(grains_in(height * width * width), seed, 0.5f, GrainBox{vec3(-half), vec3(half)}), half, half);
    lab.run(world, 1.5);
    const Slices poured = slices_of(lab, world, half, height, 0.2);
    world.set_velocity(0, {0, static_cast<float>(-sinking), 0}, vec3(0));
    lab.run(world, 2);
    const Slices slices = slices_of(lab, world, half, height, 3);

    const double rho_g = slices.bulk_weight(height);
    double total = 0, pressing = 0, rubbing = 0;
    for (const double weight : slices.weight) total += weight;
    for (std::size_t i = 1; i < 5; ++i) {
        pressing += std::hypot(slices.loads[i].x, slices.loads[i].z);
        rubbing += -slices.loads[i].y;
    }
    const double across = ratio_of_stresses(slices, rho_g), friction = rubbing / pressing;
    const double length = width / (4 * friction * across);  // m, of screening
    const auto janssen = [&](double depth) { return rho_g * length * (1 - portable::exp(-depth / length)); };
    GranularMeasured measured{{}, {{"measured", {}}}, {{"Janssen", {}}, {"without friction", {}}}};
    double error = 0;
    int count = 0;
    // The floor sinks by 1.5 d meanwhile, through the lowest slices.
    for (std::size_t i = slices.vertical.size(); i-- > 2;) {
        const double depth = slices.above(i) / rho_g;
        if (depth <= 0.5 * dd) continue;
        measured.points[0].points.push_back({depth / dd, slices.vertical[i] / (rho_g * dd)});
        error += std::pow((slices.vertical[i] - janssen(depth)) / (rho_g * length), 2);
        ++count;
    }
    for (int i = 0; i <= 80; ++i) {
        const double depth = height * i / 80;
        measured.theory[0].points.push_back({depth / dd, janssen(depth) / (rho_g * dd)});
        if (depth < 1.5 * length) measured.theory[1].points.push_back({depth / dd, depth / dd});
    }
    measured.figures = {-slices.loads[0].y / slices.area / janssen(total / rho_g), 100 * std::sqrt(error / count),
                        friction / silo_friction, ratio_of_stresses(poured, poured.bulk_weight(height))};
    return measured;
}

}  // namespace

std::vector<GranularCase> column_cases() {
    GranularCase column{
        .name = "column",
        .title = "a column settles between walls without friction",
        .source = "statics: the stress bears the weight above, rho g h",
        .setup = "spheres of 0.9 to 1.1 d, friction 0.5, in a box 6 d wide, 20 d high; 120 Hz, 12 substeps; mean over 0.5 s",
        .grains = column_grains,
        .figures = {{"vertical stress over rho g h", "1", 0.99, 1.01},
                    {"greatest error of a slice's stress against the weight above it, %", "0", 0, 1},
                    {"force on the floor over the weight", "1", 0.99, 1.01}},
        .plot = {.x = "depth h / d", .y = "stress / (rho g h)", .lines = {{"", {{0, 1}, {20, 1}}}}, .points = {}},
        .measure = settled_column};
    GranularCase janssen{
        .name = "janssen",
        .title = "the walls of a silo bear its grains: stress = rho g l (1 - exp(-h / l)), l = width / (4 mu K)",
        .source =
            "Janssen, Z. Ver. Dtsch. Ing. 39, 1045 (1895), translated by Sperl, Granul. Matter 8, 59 (2006); a floor that "
            "sinks: Vanel, Clement, Eur. Phys. J. B 11, 525 (1999); K: Jaky (1944); mu: Richard et al., Phys. Rev. Lett. "
            "101, 248002 (2008)",
        .setup =
            "spheres of 0.9 to 1.1 d, friction 0.5, also of walls, poured from 1.5 d into a shaft 8 d wide, 40 d high; then "
            "the floor sinks at 0.05 sqrt(g d); 120 Hz, 12 substeps; mean over 3 s",
        .grains = silo_grains,
        .figures = {{"load of the floor over the law's, with measured mu and K", "1", 0.9, 1.1},
                    {"error of the stress's profile (root mean square), % of the saturated stress", "0", 0, 10},
                    {"mu of the walls over that of the grains", "below 1, since grains also roll", 0.3, 1},
                    {"K before the floor sinks", "1 - sin(phi): 0.5 to 0.7 for phi of 17 to 30 degrees", 0.5, 0.7}},
        .plot = {.x = "depth / d", .y = "vertical stress / (rho g d)", .lines = {}, .points = {}},
        .measure = silo};
    return {column, janssen};
}

}  // namespace scree::demos
