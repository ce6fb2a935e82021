// A vertical cut in cohesive grains: how high it stands.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/measures.h"
#include "compute/scene/portable_math.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

using namespace granular;

namespace {

constexpr std::size_t cut_grains = 1050;
constexpr float cut_half_length = 8 * d, cut_half_width = 2.5f * d;
constexpr double cut_height = 12 * dd;
constexpr double angle_of_friction = 23.4 * std::numbers::pi / 180;  // of these spheres, as the case `repose` has it

// Whether the cut stands without the wall before it: whether fewer than 3% of the grains move by more than d within 2 s.
bool stands(const GranularLab& lab, World& world, const std::vector<std::byte>& filled, double adhesion) {
    world.restore(filled);
    for (std::size_t i = 0; i < world.scene().bodies.size(); ++i) {
        if (world.scene().bodies[i].motion != Motion::dynamic) continue;
        Material material = material_of(world.scene().bodies[i]);
        material.cohesion = static_cast<float>(adhesion);
        world.set_material(i, material);
    }
    lab.run(world, 0.5);
    const std::vector<BodyState> before = world.bodies();
    world.remove_body(1);
    lab.run(world, 2);
    const std::vector<BodyState> after = world.bodies();
    std::size_t moved = 0, grains = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (i == 1 || world.scene().bodies[i].motion != Motion::dynamic) continue;
        ++grains;
        moved += glm::length(after[i].position - before[i].position) > d;
    }
    return static_cast<double>(moved) < 0.03 * static_cast<double>(grains);
}

GranularMeasured cut(const GranularLab& lab, std::uint64_t seed) {
    const double scale = lab.scale(cut_grains), height = cut_height * scale;
    const float half = cut_half_length * static_cast<float>(scale);
    Scene scene;
    scene.bodies.push_back(wall({0, 1, 0}, 0, 0.5f));
    scene.bodies.push_back(wall({-1, 0, 0}, -half, 0));
    scene.bodies.push_back(wall({1, 0, 0}, -half, 0));
    scene.bodies.push_back(wall({0, 0, 1}, -cut_half_width, 0));
    scene.bodies.push_back(wall({0, 0, -1}, -cut_half_width, 0));
    World world = lab.world(scene, 120, 12);
    const double area = 4 * static_cast<double>(half * cut_half_width);
    const auto count = static_cast<std::size_t>(0.57 * area * height / (std::numbers::pi / 6 * dd * dd * dd));
    const double volume = pour(lab, world, grains_of(count, seed, 0.5f, GrainBox{vec3(-half), vec3(half)}), half, cut_half_width);
    lab.run(world, 1.5);
    MeasureRequest request;
    request.regions.push_back({"middle", MeasureBox{{-half, 0.25f * static_cast<float>(height), -cut_half_width},
                                                    {half, 0.75f * static_cast<float>(height), cut_half_width}}});
    const RegionMeasures middle = measure(world, request).regions[0];
    const double solid = middle.solid_fraction, reached = volume / area / solid;  // m, height without voids on top
    const std::vector<std::byte> filled = world.save();
    double low = 0, high = 1600 * scale;  // J/m^2
    if (!stands(lab, world, filled, high)) return {{NAN}, {{"measured", {}}}};
    for (int i = 0; i < 8; ++i) {
        const double adhesion = 0.5 * (low + high);
        (stands(lab, world, filled, adhesion) ? high : low) = adhesion;
    }
    const double adhesion = 0.5 * (low + high), pull = std::numbers::pi * adhesion * dd / 2;
    // Rumpf: tensile strength of a packing of equal balls, of k contacts each.
    const double tension = solid * middle.coordination * pull / (std::numbers::pi * dd * dd);
    const double cohesion = tension * portable::tan(angle_of_friction);
    const double law =
        4 * cohesion / (solid * static_cast<double>(density) * g) * portable::tan(std::numbers::pi / 4 + angle_of_friction / 2);
    const double weight = std::numbers::pi / 6 * dd * dd * dd * static_cast<double>(density) * g;
    return {{reached / law},
            {{"measured", {{pull / weight, reached / dd}}}},
            {{"law", {{0, 0}, {1.3 * pull / weight, 1.3 * law / dd}}}}};
}

}  // namespace

std::vector<GranularCase> cut_cases() {
    return {
        {.name = "cut",
         .title =
             "a wall before cohesive grains is taken away: the height at which they stand is 4 c / (rho g) tan(45 + phi / 2)",
         .source =
             "Terzaghi, Theoretical Soil Mechanics (1943); c = tan(phi) times the tensile strength of Rumpf, Chem. Ing. Tech. "
             "42, 538 (1970): solid fraction k F / (pi d^2)",
         .setup =
             "spheres of 0.9 to 1.1 d, friction 0.5, poured without cohesion, 12 d high, 16 d long and 5 d wide between walls "
             "without friction; phi 23.4 degrees; the pull-off force F at which they just stand; 120 Hz, 12 substeps",
         .grains = cut_grains,
         .figures = {{"height over the law's", "1", 0.9, 1.1}},
         .plot = {.x = "pull-off force over weight", .y = "height / d", .lines = {}, .points = {}, .whole_range = true},
         .measure = cut}};
}

}  // namespace scree::demos
