// A run as a folder of VTK files.
#include "demos/film/export/vtk_folder.h"

#include <fmt/format.h>

#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compute/measures/scan.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/portable_math.h"
#include "compute/tables/state.h"
#include "demos/film/export/glb_meshes.h"
#include "demos/film/export/vtk_files.h"
#include "demos/film/measure_columns.h"
#include "host/files/file.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

// Polygons in a body's frame.
struct Surface {
    std::vector<vec3> points;
    std::vector<std::uint32_t> corners, ends;
};

Surface surface_of(const Box& box) {
    Surface made;
    for (int k = 0; k < 8; ++k)
        made.points.push_back(box.half_extents * vec3((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1));
    made.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    made.ends = {4, 8, 12, 16, 20, 24};
    return made;
}
Surface surface_of(const HullForm& form) {
    Surface made;
    for (const glm::dvec3& vertex : form.vertices) made.points.emplace_back(vertex);
    for (const HullForm::Face& face : form.faces) {
        made.corners.insert(made.corners.end(), face.corners.begin(), face.corners.end());
        made.ends.push_back(static_cast<std::uint32_t>(made.corners.size()));
    }
    return made;
}
Surface surface_of(const Triangles& triangles, vec3 scale) {
    Surface made;
    for (const vec3& point : triangles.points) {
        made.corners.push_back(static_cast<std::uint32_t>(made.points.size()));
        made.points.push_back(point * scale);
        if (made.points.size() % 3 == 0) made.ends.push_back(static_cast<std::uint32_t>(made.corners.size()));
    }
    return made;
}
// Empty for a plane, which has no end.
Surface surface_of(const Shape& shape) {
    if (std::holds_alternative<Plane>(shape)) return {};
    if (const auto* box = std::get_if<Box>(&shape)) return surface_of(*box);
    if (const auto* hull = std::get_if<Hull>(&shape)) return surface_of(*hull->form);
    MeshCollection meshes;
    const Drawn drawn = meshes.add(shape, 1, vec3(0));
    return surface_of(meshes.meshes()[drawn.mesh], drawn.scale);
}

// The surfaces of bodies at their poses.
class Surfaces {
public:
    void add(const Surface& surface, const BodyState& at) {
        const auto first = static_cast<std::int64_t>(data.points.size()), before = static_cast<std::int64_t>(data.corners.size());
        for (const vec3& point : surface.points) data.points.push_back(at.position + physics::rotate(at.orientation, point));
        for (const std::uint32_t corner : surface.corners) data.corners.push_back(first + std::int64_t{corner});
        for (const std::uint32_t end : surface.ends) data.ends.push_back(before + std::int64_t{end});
        faces = surface.ends.size();
    }
    VtkPolyData data{.kind = "Polys"};
    std::size_t faces = 0;  // of the last one
};

double pressure_of(const Tensor& stress) {
    return (stress[0] + stress[4] + stress[8]) / 3;
}

}  // namespace

struct VtkFolder::Impl {
    std::filesystem::path folder;
    int moments = 0;
    struct Index {
        std::string kind;
        std::vector<std::pair<double, std::string>> files;
    };
    std::map<std::string, Index> indices;

    // By body, made when it is first seen; hulls that bodies share are made once for each.
    std::vector<std::optional<Surface>> surfaces;
    std::optional<std::uint64_t> arrangements;
    std::vector<float> radii, masses;

    template <class Data>
    void write(const std::string& kind, const char* ending, double time, const Data& data) {
        const std::string name = fmt::format("{}_{:06}.{}", kind, moments, ending);
        write_vtk(folder / name, time, data);
        Index& index = indices[kind];
        index.files.emplace_back(time, name);
        write_vtk_index(folder / (kind + ".pvd"), index.files);
    }
    void learn(const World& world);
    void write_walls(const World& world, const std::vector<BodyState>& states);
    VtkPolyData grains(const World& world, const std::vector<BodyState>& states, const GrainMeasures& told) const;
    VtkPolyData shapes(const World& world, const std::vector<BodyState>& states, const GrainMeasures& told);
    VtkPolyData contacts(const World& world, const std::vector<BodyState>& states) const;
    const Surface& surface(const Scene& scene, std::size_t body) {
        if (!surfaces[body]) surfaces[body] = surface_of(scene.bodies[body].shape);
        return *surfaces[body];
    }
};

// Of bodies that came or went.
void VtkFolder::Impl::learn(const World& world) {
    if (arrangements == world.arrangements()) return;
    arrangements = world.arrangements();
    const Scene& scene = world.scene();
    const State& state = world.state();
    surfaces.assign(scene.bodies.size(), std::nullopt);
    radii.assign(scene.bodies.size(), 0);
    masses.assign(scene.bodies.size(), 0);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& body = scene.bodies[i];
        const double volume = double{mass_properties(body.shape, 1).mass};
        radii[i] = static_cast<float>(portable::cbrt(0.75 * volume / std::numbers::pi));
        const float inverse = state.properties[state.row_of(i)].inverse_mass;
        masses[i] = inverse > 0 ? 1 / inverse : 0;
    }
}

void VtkFolder::Impl::write_walls(const World& world, const std::vector<BodyState>& states) {
    Surfaces made;
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Body& body = world.scene().bodies[i];
        if (body.motion != Motion::fixed || body.role != Role::solid || !states[i].exists) continue;
        made.add(surface(world.scene(), i), states[i]);
        ids.insert(ids.end(), made.faces, static_cast<std::int64_t>(i));
    }
    made.data.of_cells.push_back(vtk_array("id", 1, ids));
    write_vtk(folder / "walls.vtp", world.time(), made.data);
}

VtkPolyData VtkFolder::Impl::grains(const World& world, const std::vector<BodyState>& states, const GrainMeasures& told) const {
    VtkPolyData data;
    std::vector<std::int64_t> ids;
    std::vector<float> radius, mass, orientation, velocity, spin, stress, pressure;
    std::vector<std::int32_t> coordination, shape;
    std::vector<std::uint8_t> rattler, asleep;
    const std::vector<std::uint8_t> is_grain = granular::grains_among(world, states);
    const auto append = [](std::vector<float>& to, const auto& v) { to.insert(to.end(), &v.x, &v.x + v.length()); };
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Body& body = world.scene().bodies[i];
        const BodyState& now = states[i];
        if (is_grain[i] == 0) continue;
        data.corners.push_back(static_cast<std::int64_t>(data.points.size()));
        data.ends.push_back(static_cast<std::int64_t>(data.corners.size()));
        data.points.push_back(now.position);
        ids.push_back(static_cast<std::int64_t>(i));
        shape.push_back(static_cast<std::int32_t>(body.shape.index()));
        radius.push_back(radii[i]);
        mass.push_back(masses[i]);
        append(orientation, now.orientation);
        append(velocity, now.velocity);
        append(spin, now.angular_velocity);
        stress.insert(stress.end(), told.stress[i].begin(), told.stress[i].end());
        pressure.push_back(static_cast<float>(pressure_of(told.stress[i])));
        coordination.push_back(static_cast<std::int32_t>(told.coordination[i]));
        rattler.push_back(told.rattler[i]);
        asleep.push_back(now.asleep ? 1 : 0);
    }
    data.of_points = {vtk_array("id", 1, ids),
                      vtk_array("shape", 1, shape),
                      vtk_array("radius", 1, radius),
                      vtk_array("mass", 1, mass),
                      vtk_array("orientation", 4, orientation),
                      vtk_array("velocity", 3, velocity),
                      vtk_array("angular_velocity", 3, spin),
                      vtk_array("coordination", 1, coordination),
                      vtk_array("rattler", 1, rattler),
                      vtk_array("stress", 9, stress),
                      vtk_array("pressure", 1, pressure),
                      vtk_array("asleep", 1, asleep)};
    return data;
}

VtkPolyData VtkFolder::Impl::shapes(const World& world, const std::vector<BodyState>& states, const GrainMeasures& told) {
    Surfaces made;
    std::vector<std::int64_t> ids;
    std::vector<float> speed, pressure;
    std::vector<std::int32_t> coordination;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Body& body = world.scene().bodies[i];
        if (body.motion == Motion::fixed || body.role != Role::solid || !states[i].exists) continue;
        if (std::holds_alternative<Sphere>(body.shape)) continue;
        made.add(surface(world.scene(), i), states[i]);
        ids.insert(ids.end(), made.faces, static_cast<std::int64_t>(i));
        speed.insert(speed.end(), made.faces, glm::length(states[i].velocity));
        pressure.insert(pressure.end(), made.faces, static_cast<float>(pressure_of(told.stress[i])));
        coordination.insert(coordination.end(), made.faces, static_cast<std::int32_t>(told.coordination[i]));
    }
    made.data.of_cells = {vtk_array("id", 1, ids), vtk_array("speed", 1, speed), vtk_array("coordination", 1, coordination),
                          vtk_array("pressure", 1, pressure)};
    return std::move(made.data);
}

VtkPolyData VtkFolder::Impl::contacts(const World& world, const std::vector<BodyState>& states) const {
    VtkPolyData data{.kind = "Lines"};
    std::vector<std::int64_t> a, b;
    std::vector<float> normal_force, force;
    const std::vector<std::uint8_t> is_grain = granular::grains_among(world, states);
    for (const ContactState& contact : world.contacts()) {
        float pressing = 0;
        vec3 middle(0);
        for (std::uint32_t k = 0; k < contact.count; ++k) {
            pressing += contact.points[k].force;
            middle += contact.points[k].position * contact.points[k].force;
        }
        if (!(pressing > 0)) continue;
        // A wall's end is where the contact is.
        for (const std::size_t body : {contact.a, contact.b}) {
            data.corners.push_back(static_cast<std::int64_t>(data.points.size()));
            data.points.push_back(is_grain[body] == 0 ? middle / pressing : states[body].position);
        }
        data.ends.push_back(static_cast<std::int64_t>(data.corners.size()));
        a.push_back(static_cast<std::int64_t>(contact.a));
        b.push_back(static_cast<std::int64_t>(contact.b));
        normal_force.push_back(pressing);
        const vec3 whole = contact.normal * pressing + contact.friction;
        force.insert(force.end(), {whole.x, whole.y, whole.z});
    }
    data.of_cells = {vtk_array("normal_force", 1, normal_force), vtk_array("force", 3, force), vtk_array("a", 1, a),
                     vtk_array("b", 1, b)};
    return data;
}

VtkFolder::VtkFolder(const std::filesystem::path& folder, const World& world) : interior_(std::make_unique<Impl>()) {
    Impl& in = *interior_;
    in.folder = folder;
    host::make_folder(folder);
    for (const char* index : {"grains.pvd", "shapes.pvd", "contacts.pvd", "grid.pvd"})
        if (std::filesystem::exists(folder / index))
            throw std::invalid_argument(std::string("has ") + index + " of an earlier run; name another folder");
    in.learn(world);
    in.write_walls(world, world.bodies());
}
VtkFolder::~VtkFolder() = default;

void VtkFolder::add(const World& world, const Measures& measures, const MeasureRequest& request) {
    Impl& in = *interior_;
    in.learn(world);
    const std::vector<BodyState> states = world.bodies();
    const double time = world.time();
    in.write("grains", "vtp", time, in.grains(world, states, measures.grains));
    if (VtkPolyData shapes = in.shapes(world, states, measures.grains); !shapes.ends.empty() || in.indices.contains("shapes"))
        in.write("shapes", "vtp", time, shapes);
    in.write("contacts", "vtp", time, in.contacts(world, states));
    if (request.grid) {
        VtkImage image{glm::dvec3(request.grid->lower), glm::dvec3(request.grid->cell), measures.cells, {}};
        for (const auto& column : cell_columns())
            image.of_cells.push_back(vtk_array(column.name, column.width, values_of(column, measures.grid)));
        in.write("grid", "vti", time, image);
    }
    ++in.moments;
}
int VtkFolder::moments() const {
    return interior_->moments;
}

}  // namespace scree::demos
