// Records of bodies: shapes, materials and masses, hulls and triangles, and the rows of parts.
#include <algorithm>
#include <bit>
#include <optional>
#include <type_traits>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/compile/seams.h"
#include "compute/scene/fracture.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/hull_cells.h"
#include "compute/scene/meshes/mesh.h"
#include "compute/scene/shape_geometry.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/triangle.h"
#include "shaders/physics/contact/material.h"
#include "shaders/physics/contact/tyre.h"

namespace scree {

namespace {

// Properties with shape id and size.
physics::BodyProperties simple_form(const SimpleShape& shape) {
    physics::BodyProperties made{};
    made.shape = static_cast<physics::uint>(shape.index());
    made.size = record_size(shape);
    if (std::holds_alternative<Hull>(shape)) {
        const double farthest = 1.00001 * static_cast<double>(bounding_radius(whole_shape(shape)));
        const double nearer = 16 * (1 - farthest / glm::length(glm::dvec3(made.size)));
        made.flags = static_cast<physics::uint>(std::clamp(nearer, 0.0, double{physics::ROW_REACH_MOST}))
                     << physics::ROW_REACH_SHIFT;
    }
    return made;
}

physics::uvec4 record_of(vec3 v, float w) {
    return {std::bit_cast<physics::uint>(v.x), std::bit_cast<physics::uint>(v.y), std::bit_cast<physics::uint>(v.z),
            std::bit_cast<physics::uint>(w)};
}
// In the layout of shaders/physics/collide/triangle.h.
std::vector<physics::uvec4> triangle_records(const MeshForm::Triangle& triangle) {
    float way = glm::length(triangle.corners[0]);
    for (const vec3& corner : triangle.corners) way = std::min(way, glm::length(corner));
    std::vector<physics::uvec4> records{{3, 1, 0, std::bit_cast<physics::uint>(-way)}};
    for (const vec3& corner : triangle.corners) records.push_back(record_of(corner, 0));
    records.push_back(record_of(triangle.normal, triangle.distance));
    records.emplace_back(0, 3, 0, 0);
    records.emplace_back(0x020100, 0, 0, 0);
    for (const vec3& limit : triangle.limits) records.push_back(record_of(limit, 0));
    return records;
}
physics::uint flags_of(Role role) {
    if (role == Role::solid) return 0;
    return role == Role::sensor ? physics::ROW_APART | physics::ROW_SENSOR : physics::ROW_APART;
}

// Size of a body of which only parts collide, as for SHAPE_NONE.
vec3 size_of_whole(const Shape& shape) {
    if (const MeshForm* form = mesh_form_of(shape)) return {1e30f, form->reach, 0};
    vec3 size(1e30f, 0, 0);
    for (const Part& part : std::get<Compound>(shape).parts) {
        const physics::BodyProperties form = simple_form(part.shape);
        if (part.role == Role::solid) size.x = std::min(size.x, physics::min_half_width(form));
        size.y = std::max(size.y, glm::length(part.position) + physics::bounding_radius(form));
    }
    if (size.x == 1e30f) size.x = 1;  // nothing that collides
    return size;
}

}  // namespace

std::vector<physics::uvec4> hull_records(const Hull& hull) {
    const HullForm& form = *hull.form;
    const HullCells cells = hull_cells(form);
    double inner = form.faces.front().distance;
    for (const HullForm::Face& face : form.faces) inner = std::min(inner, face.distance);
    std::vector<physics::uvec4> records{
        {form.vertices.size(), form.faces.size(), cells.across, std::bit_cast<physics::uint>(static_cast<float>(inner))}};
    for (const glm::dvec3& v : form.vertices) records.push_back(record_of(v, 0));
    for (const HullForm::Face& face : form.faces) records.push_back(record_of(face.normal, static_cast<float>(face.distance)));
    std::vector<std::uint32_t> corners;
    for (const HullForm::Face& face : form.faces) {
        records.emplace_back(corners.size(), face.corners.size(), 0, 0);
        corners.insert(corners.end(), face.corners.begin(), face.corners.end());
    }
    for (const HullCells::Cell& cell : cells.cells) {
        records.push_back(cell.vertices);
        records.push_back(cell.faces);
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (k % 16 == 0) records.emplace_back(0);
        records.back()[static_cast<int>(k / 4 % 4)] |= corners[k] << (8 * (k % 4));
    }
    return records;
}

float least_half_width(const Shape& shape) {
    const std::optional<SimpleShape> simple = simple_shape(shape);
    return simple ? physics::min_half_width(simple_form(*simple)) : size_of_whole(shape).x;
}

physics::Pose SceneCompiler::start_of(const Body& body) {
    const auto* plane = std::get_if<Plane>(&body.shape);
    return {physics::flush_tiny(plane ? plane->normal * plane->offset : body.position), 0,
            plane ? vec4(0, 0, 0, 1) : physics::flush_tiny(body.orientation)};
}
physics::Velocity SceneCompiler::start_velocity_of(const Body& body) {
    const bool moves = body.motion != Motion::fixed && body.piece_of == no_body;
    return {moves ? physics::flush_tiny(body.velocity) : vec3(0), 0, moves ? physics::flush_tiny(body.angular_velocity) : vec3(0),
            0};
}
// Initial strain: the momentum of a body that breaks by momentum.
float SceneCompiler::start_strain_of(const Body& body, const physics::BodyProperties& properties) {
    const bool by_momentum = body.fracture && body.fracture->momentum > 0 && body.piece_of == no_body;
    return by_momentum ? glm::length(body.velocity) / properties.inverse_mass : 0;
}

// Index of the hull's records. Equal hulls with separate forms are searched for only while the table is small: a linear
// search for each of ten thousand different ones would take minutes.
physics::uint SceneCompiler::place_of(const Hull& hull) {
    constexpr std::size_t small_table = 65536;
    const auto [known, fresh] = state_.shape_places.hulls.try_emplace(hull.form);
    if (!fresh) return known->second;
    const std::vector<physics::uvec4> records = hull_records(hull);
    auto found = state_.hulls.end();
    if (state_.hulls.size() < small_table)
        found = std::search(state_.hulls.begin(), state_.hulls.end(), records.begin(), records.end());
    known->second = static_cast<physics::uint>(found - state_.hulls.begin());
    if (found == state_.hulls.end()) state_.hulls.insert(state_.hulls.end(), records.begin(), records.end());
    return known->second;
}

// Index of the mesh's records, one triangle behind the other. The copies of a scene share them.
physics::uint SceneCompiler::place_of(const MeshForm& mesh) {
    const auto place = static_cast<physics::uint>(state_.hulls.size());
    if (shares_meshes_) {
        const auto [known, fresh] = meshes_.try_emplace(&mesh, place);
        if (!fresh) return known->second;
    }
    state_.hulls.reserve(state_.hulls.size() + physics::TRIANGLE_RECORDS * mesh.triangles.size());
    for (const MeshForm::Triangle& triangle : mesh.triangles) {
        const std::vector<physics::uvec4> records = triangle_records(triangle);
        state_.hulls.insert(state_.hulls.end(), records.begin(), records.end());
    }
    return place;
}

physics::BodyProperties SceneCompiler::form_of(const SimpleShape& shape) {
    physics::BodyProperties made = simple_form(shape);
    if (const auto* hull = std::get_if<Hull>(&shape)) made.shape_data = place_of(*hull);
    return made;
}

// Index of a part's seams plus 1; 0: none. Equal parts of equal compounds share them.
physics::uint SceneCompiler::place_of(const std::vector<physics::uvec4>& seams) {
    if (seams.empty()) return 0;
    std::vector<physics::uint> key;
    for (const physics::uvec4& quad : seams) key.insert(key.end(), {quad.x, quad.y, quad.z, quad.w});
    const auto [known, fresh] = seams_.try_emplace(key, static_cast<physics::uint>(state_.hulls.size() + 1));
    if (fresh) state_.hulls.insert(state_.hulls.end(), seams.begin(), seams.end());
    return known->second;
}

physics::uint SceneCompiler::place_of(const Fracture& fracture) {
    const auto [known, fresh] =
        state_.shape_places.cuts.try_emplace(fracture.cut, static_cast<physics::uint>(state_.pieces.size()));
    if (fresh) {
        std::vector<physics::PoseInBody> poses;
        for (const Body& piece : fracture.cut->pieces) poses.push_back({piece.position, 0, piece.orientation});
        constexpr std::size_t small_table = 65536;  // as of hulls
        auto same = state_.pieces.end();
        if (state_.pieces.size() < small_table)
            same = std::search(
                state_.pieces.begin(), state_.pieces.end(), poses.begin(), poses.end(),
                [](const auto& x, const auto& y) { return x.position == y.position && x.orientation == y.orientation; });
        known->second = static_cast<physics::uint>(same - state_.pieces.begin());
        if (same == state_.pieces.end()) state_.pieces.insert(state_.pieces.end(), poses.begin(), poses.end());
    }
    physics::Fracturing made{};
    made.of_momentum = fracture.momentum > 0;
    made.threshold = fracture.momentum > 0 ? fracture.momentum : fracture.impulse;
    made.first_row = static_cast<physics::uint>(fracture.first_piece);
    made.count = static_cast<physics::uint>(fracture.cut->pieces.size());
    made.first_pose = known->second;
    if (!state_.spare.fractures.empty()) {
        const physics::uint place = state_.spare.fractures.back();
        state_.spare.fractures.pop_back();
        state_.fractures[place] = made;
        return place;
    }
    state_.fractures.push_back(made);
    return static_cast<physics::uint>(state_.fractures.size() - 1);
}

// Index plus 1; 0: none.
physics::uint SceneCompiler::place_of(const std::optional<Tyre>& tyre) {
    if (!tyre) return 0;
    const auto [known, fresh] = state_.shape_places.tyres.try_emplace({tyre->best_slip, tyre->sliding},
                                                                      static_cast<physics::uint>(state_.tyres.size() + 1));
    if (fresh) state_.tyres.push_back({tyre->best_slip, tyre->sliding, 0, 0});
    return known->second;
}

physics::BodyProperties SceneCompiler::form_of(const SimpleShape& shape, const std::optional<Tyre>& tyre) {
    physics::BodyProperties made = form_of(shape);
    if (physics::takes_tyre(made.shape)) made.shape_data = place_of(tyre);
    return made;
}

physics::BodyProperties SceneCompiler::properties_of(const Body& body, std::uint32_t index) {
    physics::BodyProperties made{};
    if (const std::optional<SimpleShape> simple = simple_shape(body.shape)) {
        made = form_of(*simple, body.tyre);
    } else {
        made.shape = physics::SHAPE_NONE;
        made.size = size_of_whole(body.shape);
    }
    made.owner = index;
    made.fracture = body.fracture ? place_of(*body.fracture) : physics::NONE;
    made.joints = physics::NONE;
    set_mass(made, body);
    if (body.piece_of != no_body) made.motion = physics::MOTION_PENDING;
    made.flags |= flags_of(body.role);
    set_material(made, body);
    if (made.shape == physics::SHAPE_PLANE && body.role == Role::solid) made.flags |= physics::ROW_LARGE;
    return made;
}

void SceneCompiler::set_mass(physics::BodyProperties& properties, const Body& body) {
    properties.motion = static_cast<physics::uint>(body.motion);
    properties.inverse_mass = 0;
    properties.inverse_inertia = vec3(0);
    if (body.motion != Motion::dynamic) return;
    const MassProperties mass = mass_properties(body);
    properties.inverse_mass = 1 / mass.mass;
    properties.inverse_inertia = vec3(1 / mass.inertia.x, 1 / mass.inertia.y, 1 / mass.inertia.z);
    // In world axes the tensor of a thinner needle is rounding: about its cross axes, contacts at its ends had no mass or a
    // negative one. So about its own axis it counts as a little thicker.
    constexpr float most_slender = 1e6f;
    const float most =
        most_slender * std::min({properties.inverse_inertia.x, properties.inverse_inertia.y, properties.inverse_inertia.z});
    properties.inverse_inertia = glm::min(properties.inverse_inertia, vec3(most));
}

void SceneCompiler::set_material(physics::BodyProperties& properties, const Body& body) {
    set_surface(properties, material_of(body), curvature_of(body));
    properties.gravity_scale = body.gravity_scale;
    properties.linear_damping = body.linear_damping;
    properties.angular_damping = body.angular_damping;
}

// Index plus 1; 0: the material says no more than the properties.
physics::uint SceneCompiler::place_of(const Material& material, float curvature) {
    if (material.static_friction <= material.friction && material.spinning_resistance < 0 && material.restitution_threshold < 0 &&
        material.surface_velocity == vec3(0) && material.friction_rule == CombineRule::usual &&
        material.restitution_rule == CombineRule::usual && material.cohesion == 0)
        return 0;
    const bool coheres = material.cohesion > 0;
    const physics::Surface made{material.surface_velocity,
                                material.static_friction,
                                material.spinning_resistance,
                                material.restitution_threshold,
                                static_cast<physics::uint>(material.friction_rule),
                                static_cast<physics::uint>(material.restitution_rule),
                                material.cohesion,
                                coheres ? material.cohesion_range : unset,
                                coheres ? curvature : 0,
                                0};
    const auto [known, fresh] = state_.shape_places.surfaces.try_emplace(std::bit_cast<std::array<physics::uint, 12>>(made));
    if (fresh && !state_.spare.surfaces.empty()) {
        known->second = state_.spare.surfaces.back();
        state_.spare.surfaces.pop_back();
        state_.surfaces[known->second] = made;
    } else if (fresh) {
        known->second = static_cast<physics::uint>(state_.surfaces.size());
        state_.surfaces.push_back(made);
        state_.spare.surface_users.push_back(0);
    }
    ++state_.spare.surface_users[known->second];
    return known->second + 1;
}

void SceneCompiler::release_surface(physics::BodyProperties& row) {
    const physics::uint surface = physics::surface_of(row);
    row.flags &= (1u << physics::ROW_SURFACE_SHIFT) - 1u;
    if (surface == 0 || --state_.spare.surface_users[surface - 1] > 0) return;
    state_.shape_places.surfaces.erase(std::bit_cast<std::array<physics::uint, 12>>(state_.surfaces[surface - 1]));
    state_.spare.surfaces.push_back(surface - 1);
}

void SceneCompiler::set_surface(physics::BodyProperties& row, const Material& material, float curvature) {
    release_surface(row);
    row.friction = material.friction;
    row.restitution = material.restitution;
    row.rolling_resistance = material.rolling_resistance;
    row.flags |= place_of(material, curvature) << physics::ROW_SURFACE_SHIFT;
}

void SceneCompiler::append_parts(const Body& body, std::uint32_t owner) {
    const physics::BodyProperties whole = state_.properties[owner];
    const Material own = material_of(body);
    const float curvature = curvature_of(body);
    const auto append = [&](physics::BodyProperties part, vec3 place, vec4 turn, const Material& material, physics::uint seams) {
        part.motion = whole.motion | physics::MOTION_OF_PART;
        part.owner = owner;
        part.fracture = part.joints = physics::NONE;
        set_surface(part, material, curvature);
        state_.properties.push_back(part);
        state_.parts.push_back({place, seams, turn});
    };
    if (const auto* compound = std::get_if<Compound>(&body.shape)) {
        const std::vector<std::vector<physics::uvec4>> seams = seam_records(*compound);
        for (std::size_t i = 0; i < seams.size(); ++i) {
            const Part& part = compound->parts[i];
            physics::BodyProperties form = form_of(part.shape, body.tyre);
            form.flags |= flags_of(body.role != Role::solid ? body.role : part.role);
            append(form, part.position, part.orientation, part.material.value_or(own), place_of(seams[i]));
        }
    }
    if (const MeshForm* form = mesh_form_of(body.shape)) {
        physics::uint next = place_of(*form);
        for (const MeshForm::Triangle& triangle : form->triangles) {
            physics::BodyProperties part{};
            part.shape = physics::SHAPE_TRIANGLE;
            part.shape_data = next;
            part.size = triangle.half_extents;
            next += physics::TRIANGLE_RECORDS;
            append(part, triangle.middle, vec4(0, 0, 0, 1), own, 0);
        }
    }
}

void SceneCompiler::place(std::uint32_t part) {
    const std::uint32_t owner = state_.properties[part].owner;
    const physics::PoseInBody& in_body = state_.part_in(part);
    state_.poses[part] = physics::pose_of_part(in_body, state_.poses[owner]);
    state_.velocities[part] = physics::velocity_of_part(in_body, state_.poses[owner], state_.velocities[owner]);
    state_.sleep_states[part] = 0;
}

}  // namespace scree
