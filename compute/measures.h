// Measures of granular media: what bodies and contacts are like after a step, in regions, on a grid, per body and at gates.
//
//     scree::MeasureRequest request;
//     request.regions.push_back({"core", scree::MeasureSphere{{0, 1, 0}, 0.5f}});
//     scree::Measuring measuring(request, world);
//     world.step();
//     measuring.after_step(world);  // only gates need it, after each step
//     const scree::Measures now = measuring.take(world);
//
// Grains are the solid dynamic bodies that exist and that no joint holds. All other bodies are walls: they have contacts, and no
// volume, mass or motion here. Forces are those of the last substep of the last step. Sums are taken in integers, or in the order
// of bodies: no order of contacts, no backend and no number of threads changes a bit. demos/docs/guide/measures.md has the
// definitions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compute/scene.h"

namespace scree {

class World;  // compute/world.h

// ---- what is asked
struct MeasureBox {  // along the world's axes
    vec3 lower{0};   // m, within 1e6 m of 0
    vec3 upper{1};   // m, above `lower` along each axis
};
struct MeasureCylinder {
    vec3 from{0};      // m, the ends of its axis
    vec3 to{0, 1, 0};  // m
    float radius = 1;  // m, above 0
};
struct MeasureSphere {
    vec3 centre{0};    // m
    float radius = 1;  // m, above 0
};
using MeasureShape = std::variant<MeasureBox, MeasureCylinder, MeasureSphere>;

struct MeasureRegion {
    std::string name{};  // of its columns; empty: "region" and its number
    MeasureShape shape = MeasureBox{};
};
struct MeasureGrid {  // along the world's axes
    vec3 lower{0};    // m
    vec3 upper{1};    // m; moved out to whole cells
    vec3 cell{0.1f};  // m, edges of a cell, above 0
};
constexpr std::size_t most_measured_cells = std::size_t{1} << 20;
glm::uvec3 cells_of(const MeasureGrid& grid);

// A rectangle whose crossings are counted, by the centres of grains. Flow along u x v is positive.
struct MeasureGate {
    std::string name{};  // empty: "gate" and its number
    vec3 centre{0};      // m
    vec3 u{1, 0, 0};     // m, from the centre to the middle of one edge
    vec3 v{0, 0, 1};     // m, of the next edge, at right angles to u
};
// A body whose load is told: the sum of the forces of its contacts, and their torque. Any solid body, by its index in the scene,
// or in each of its copies.
struct MeasuredBody {
    std::size_t body = no_body;
    std::optional<vec3> about{};  // m, point of the torque; none: the body's centre of mass
};

struct MeasureRequest {
    std::optional<MeasureGrid> grid{};
    std::vector<MeasureRegion> regions{};
    std::vector<MeasureGate> gates{};
    std::vector<MeasuredBody> bodies{};
    float interval = 0.1f;  // s, from one line of a table to the next, for programs that write one; 0: every step
};
// Throws SceneError with the JSON pointer of a value that is out of range, below `at`, and for a body that is not there.
void check_measures(const MeasureRequest& request, const Scene& scene, const std::string& at = "/measures");
// Names of columns. Of several measured bodies with one name the second is "name 2".
std::string name_of_region(const MeasureRequest& request, std::size_t region);
std::string name_of_gate(const MeasureRequest& request, std::size_t gate);
std::string name_of_load(const MeasureRequest& request, std::size_t body, const Scene& scene);

// ---- what is told
using Tensor = std::array<double, 9>;  // xx, xy, xz, yx and so on

// Of a region, or a cell of the grid. Bodies count where their centres of mass are, contacts where their points are.
struct CellMeasures {
    double volume = 0;           // m^3
    double solid_volume = 0;     // m^3, of grains within
    double solid_fraction = 0;   // their share of the volume
    std::uint64_t bodies = 0;    // grains
    std::uint64_t rattlers = 0;  // of these, with fewer than two touching neighbours
    // Mean number of bodies, walls included, that press on a grain.
    double coordination = 0;
    // The same of those that are no rattlers.
    double coordination_without_rattlers = 0;
    double mass = 0;         // kg, of the grains
    glm::dvec3 velocity{0};  // m/s, of their mass
    double temperature = 0;  // m^2/s^2, granular: the mean of a third of |velocity - mean|^2, by mass
    // Pa, pressure is positive: contacts (Love and Weber) and motion. A region that cuts a branch has its share of it.
    Tensor stress{}, kinetic_stress{};  // the former with the latter
    double pressure = 0;                // Pa, a third of the trace
    std::uint64_t contacts = 0;         // that press
    Tensor fabric{};                    // mean of n n over these; its trace is 1
    double force_mean = 0;              // N, normal force of a contact
    double force_max = 0;               // N
};

constexpr std::size_t force_bins = 32;  // each a quarter of the mean wide; the last is open
struct ForceDistribution {
    double deviation = 0, skewness = 0, kurtosis = 0;  // standard deviation, N; of a normal distribution 0 and 3
    std::array<std::uint64_t, force_bins> counts{};    // contacts by their normal force
};

struct RegionMeasures : CellMeasures {
    std::string name;
    ForceDistribution forces{};
    double diameter = 0;    // m, mean of the spheres of equal volume
    double shear_rate = 0;  // 1/s, of the velocity gradient that fits the grains best: sqrt(2 D:D), D its symmetric deviator
    // shear_rate diameter sqrt(density / pressure): below 1e-3 the flow is quasi-static, above 0.1 collisional (GDR MiDi, Eur.
    // Phys. J. E 14, 2004). 0 without pressure.
    double inertial_number = 0;
};

struct GateMeasures {
    std::string name;
    double seconds = 0;                // since the last take(), or since it began
    double forward = 0, backward = 0;  // kg that crossed
    std::uint64_t bodies_forward = 0, bodies_backward = 0;
    double mass_flow = 0;  // kg/s, forward less backward
};

struct BodyLoad {
    std::string name;
    std::size_t body = 0;
    glm::dvec3 force{0};   // N
    glm::dvec3 torque{0};  // N m, of normal forces and friction; without rolling and spinning resistance
};

// By body; of what is no grain 0.
struct GrainMeasures {
    std::vector<std::uint32_t> coordination;
    std::vector<std::uint8_t> rattler;
    std::vector<Tensor> stress;  // Pa, of its contacts over its own volume
};

struct Measures {
    std::uint64_t step = 0;
    double time = 0;     // s
    RegionMeasures all;  // in the box around all grains
    std::vector<RegionMeasures> regions;
    glm::uvec3 cells{0};             // of the grid
    std::vector<CellMeasures> grid;  // x fastest, then y, then z
    std::vector<GateMeasures> gates;
    std::vector<BodyLoad> bodies;
    GrainMeasures grains;
};

// Takes measures of a world, which it does not keep.
class Measuring {
public:
    // `copy`: of the scene, in a world of several: the grains that count. Throws SceneError as check_measures() does.
    Measuring(const MeasureRequest& request, const World& world, std::size_t copy = 0);
    ~Measuring();
    Measuring(Measuring&&) noexcept;
    Measuring& operator=(Measuring&&) noexcept;

    bool watches_steps() const;           // whether there are gates
    void after_step(const World& world);  // counts crossings since the last call: of straight ways. Reads all bodies
    Measures take(const World& world);    // at present. Reads all bodies and contacts
    const MeasureRequest& request() const;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// Once, without gates.
Measures measure(const World& world, const MeasureRequest& request = {});

}  // namespace scree
