// Compiles a scene into the tables of a state: parameters, bodies, parts, shapes, joints, vehicles.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/tables/state.h"

namespace scree {

struct MeshForm;  // compute/scene/meshes/mesh.h

// Parameters::sleep_steps.
physics::uint sleep_steps_of(const Settings& settings);
// The parameters with new gravity and settings; the others unchanged.
physics::Parameters tuned(physics::Parameters p, vec3 gravity, const Settings& settings);
// The periodic cell; tuned() afterwards, since bodies in one that stretches do not sleep.
void set_period(physics::Parameters& p, const PeriodicCell& cell);
PeriodicCell periodic_cell(const physics::Parameters& p);
bool is_stretching(const physics::Parameters& p);

// Capacities of the lists of pairs and contacts on each of `ranks`: the settings', or a first guess for so many bodies and moving
// parts in all.
void set_first_capacities(physics::Parameters& p, const Settings& settings, std::uint32_t bodies, std::uint32_t ranks);

// The table of gravities, of copies of a scene.
std::vector<physics::uvec4> records_of_gravities(const std::vector<vec3>& gravities);

// Half of a body's thinnest width (min_half_width in shaders/physics/base/shapes.h), m.
float least_half_width(const Shape& shape);

// Of a checked hull, in the layout of shaders/physics/collide/shape_data.h.
std::vector<physics::uvec4> hull_records(const Hull& hull);

// Whether a body or one of its parts has a collision filter.
bool has_filter(const Body& body);

class SceneCompiler {
public:
    explicit SceneCompiler(State& state) : state_(state) {}

    // The initial tables of a checked scene, made of `copies` copies (scene/copies.h), in an empty state.
    void compile(const Scene& scene, const Settings& settings, std::uint32_t group_size, std::uint32_t copies = 0,
                 std::uint32_t ranks = 1);

    // shape_records.cpp
    physics::BodyProperties properties_of(const Body& body,
                                          std::uint32_t index);  // appends its shape data to the tables
    static physics::Pose start_of(const Body& body);
    static physics::Velocity start_velocity_of(const Body& body);
    static float start_strain_of(const Body& body, const physics::BodyProperties& properties);
    void append_parts(const Body& body, std::uint32_t owner);                  // appends properties and poses of its parts
    void place(std::uint32_t part);                                            // sets a part's pose from its body's
    void set_material(physics::BodyProperties& properties, const Body& body);  // and damping
    // In place of the row's own. `curvature`: curvature_of its body.
    void set_surface(physics::BodyProperties& row, const Material& material, float curvature);
    void release_surface(physics::BodyProperties& row);
    static void set_mass(physics::BodyProperties& properties, const Body& body);  // and motion

    // field_records.cpp: parameters of fields, and how bodies meet air and water (none in a scene without both).
    void set_fields(const Scene& scene);
    static physics::Immersion immersion_of(const Body& body);

    // cohesion_records.cpp: of a body of which some surface is cohesive, 1 over the radius of the ball of its volume, 1/m; 0: it
    // is flat, or a ball, whose size tells it.
    static float curvature_of(const Body& body);

    // filter_records.cpp: the tables of filters and exclusions, empty if the scene has none.
    void filter(const Scene& scene);

    // bond_records.cpp: the tables of bonds, empty if the scene has none.
    void bond(const Scene& scene);

private:
    physics::BodyProperties form_of(const SimpleShape& shape);
    physics::BodyProperties form_of(const SimpleShape& shape, const std::optional<Tyre>& tyre);
    physics::uint place_of(const Hull& hull);
    physics::uint place_of(const MeshForm& mesh);
    physics::uint place_of(const std::vector<physics::uvec4>& seams);
    physics::uint place_of(const Fracture& fracture);
    physics::uint place_of(const std::optional<Tyre>& tyre);
    physics::uint place_of(const Material& material, float curvature);

    State& state_;
    std::map<std::vector<physics::uint>, physics::uint> seams_;
    bool shares_meshes_ = false;
    std::map<const MeshForm*, physics::uint> meshes_;  // places, if copies share them
};

}  // namespace scree
