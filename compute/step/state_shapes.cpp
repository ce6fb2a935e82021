// What bodies become in the tables: shapes, materials and masses, hulls and triangles, and the rows of parts.
#include <algorithm>
#include <bit>
#include <optional>

#include "compute/scene/fracture.h"
#include "compute/scene/hull.h"
#include "compute/scene/hull_cells.h"
#include "compute/scene/mesh.h"
#include "compute/scene/shape_geometry.h"
#include "compute/step/state.h"
#include "shaders/physics/collide/compound.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/triangle.h"
#include "shaders/physics/extra/tyre.h"

namespace scree {

namespace {

// Shape and size.
physics::Traits simple_form(const SimpleShape& shape) {
    physics::Traits made{};
    made.shape = static_cast<physics::uint>(shape.index());
    made.size = record_size(shape);
    return made;
}

physics::uvec4 record_of(vec3 v, float w) {
    return {std::bit_cast<physics::uint>(v.x), std::bit_cast<physics::uint>(v.y), std::bit_cast<physics::uint>(v.z),
            std::bit_cast<physics::uint>(w)};
}
// In the form of shaders/physics/collide/triangle.h.
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
// In the form of shaders/physics/collide/shape_data.h.
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

// Of a body that only its parts touch, as SHAPE_NONE has it.
vec3 size_of_whole(const Shape& shape) {
    if (const MeshForm* form = mesh_form_of(shape)) return {1e30f, form->reach, 0};
    vec3 size(1e30f, 0, 0);
    for (const Part& part : std::get<Compound>(shape).parts) {
        const physics::Traits form = simple_form(part.shape);
        size.x = std::min(size.x, physics::thickness(form));
        size.y = std::max(size.y, glm::length(part.position) + physics::farthest_of(form));
    }
    return size;
}

}  // namespace

physics::Pose State::start_of(const Body& body) {
    const auto* plane = std::get_if<Plane>(&body.shape);
    return {plane ? plane->normal * plane->offset : body.position, 0, plane ? vec4(0, 0, 0, 1) : body.orientation};
}
physics::Velocity State::start_velocity_of(const Body& body) {
    const bool moves = body.motion != Motion::fixed && body.piece_of == no_body;
    return {moves ? body.velocity : vec3(0), 0, moves ? body.angular_velocity : vec3(0), 0};
}
// Where the hull's records begin. Equal hulls made one by one are looked for only while the table is small: a long search for
// each of ten thousand different ones would take minutes.
physics::uint State::place_of(const Hull& hull) {
    constexpr std::size_t small_table = 65536;
    const auto [known, fresh] = places_.try_emplace(hull.form);
    if (!fresh) return known->second;
    const std::vector<physics::uvec4> records = hull_records(hull);
    auto found = hulls.end();
    if (hulls.size() < small_table) found = std::search(hulls.begin(), hulls.end(), records.begin(), records.end());
    known->second = static_cast<physics::uint>(found - hulls.begin());
    if (found == hulls.end()) hulls.insert(hulls.end(), records.begin(), records.end());
    return known->second;
}

physics::Traits State::form_of(const SimpleShape& shape) {
    physics::Traits made = simple_form(shape);
    if (const auto* hull = std::get_if<Hull>(&shape)) made.large = place_of(*hull) << 1;
    return made;
}

// In the form of shaders/physics/extra/fracture.h.
physics::uint State::place_of(const Fracture& fracture) {
    const auto [known, fresh] = cuts_.try_emplace(fracture.cut, static_cast<physics::uint>(hulls.size()));
    if (fresh) {
        hulls.emplace_back(fracture.cut->pieces.size(), 0, 0, 0);
        for (const Body& piece : fracture.cut->pieces) {
            hulls.push_back(record_of(piece.position, 0));
            hulls.push_back(record_of(vec3(piece.orientation), piece.orientation.w));
        }
    }
    const bool of_momentum = fracture.momentum > 0;
    hulls.emplace_back(std::bit_cast<physics::uint>(of_momentum ? fracture.momentum : fracture.impulse), of_momentum,
                       fracture.first_piece, known->second);
    return static_cast<physics::uint>(hulls.size() - 1);
}

// In the form of shaders/physics/extra/tyre.h; 0: none.
physics::uint State::place_of(const std::optional<Tyre>& tyre) {
    if (!tyre) return 0;
    const physics::uvec4 record(std::bit_cast<physics::uint>(tyre->best_slip), std::bit_cast<physics::uint>(tyre->sliding), 0, 0);
    const auto [known, fresh] =
        tyres_.try_emplace({tyre->best_slip, tyre->sliding}, static_cast<physics::uint>(hulls.size() + 1));
    if (fresh) hulls.push_back(record);
    return known->second;
}

physics::Traits State::form_of(const SimpleShape& shape, const std::optional<Tyre>& tyre) {
    physics::Traits made = form_of(shape);
    if (physics::takes_tyre(made.shape)) made.large = place_of(tyre) << 1;
    return made;
}

physics::Traits State::traits_of(const Body& body, std::uint32_t index) {
    physics::Traits made{};
    if (const std::optional<SimpleShape> simple = simple_shape(body.shape)) {
        made = form_of(*simple, body.tyre);
    } else {
        made.shape = physics::SHAPE_NONE;
        made.size = size_of_whole(body.shape);
    }
    made.motion = body.piece_of == no_body ? static_cast<physics::uint>(body.motion) : physics::MOTION_UNBORN;
    made.owner = index;
    made.fracture = body.fracture ? place_of(*body.fracture) : physics::NONE;
    made.joints = physics::NONE;
    if (body.motion == Motion::dynamic) {
        const MassProperties properties = mass_properties(body.shape, body.density);
        made.inverse_mass = 1 / properties.mass;
        made.inverse_inertia = vec3(1 / properties.inertia.x, 1 / properties.inertia.y, 1 / properties.inertia.z);
    }
    made.friction = body.friction;
    made.restitution = body.restitution;
    made.rolling_resistance = body.rolling_resistance;
    made.gravity_scale = body.gravity_scale;
    made.linear_damping = body.linear_damping;
    made.angular_damping = body.angular_damping;
    if (made.shape == physics::SHAPE_PLANE) made.large = 1;
    if (body.fracture && body.fracture->momentum > 0 && body.piece_of == no_body)
        made.strain = std::bit_cast<physics::uint>(glm::length(body.velocity) / made.inverse_mass);
    return made;
}

void State::append_parts(const Body& body, std::uint32_t owner) {
    const physics::Traits whole = traits[owner];
    const auto append = [&](physics::Traits part, vec3 place, vec4 turn) {
        part.motion = whole.motion | physics::MOTION_OF_PART;
        part.owner = owner;
        part.fracture = part.joints = physics::NONE;
        part.friction = whole.friction;
        part.restitution = whole.restitution;
        part.rolling_resistance = whole.rolling_resistance;
        part.inverse_inertia = place;
        part.inverse_mass = turn.x;
        part.gravity_scale = turn.y;
        part.linear_damping = turn.z;
        part.angular_damping = turn.w;
        traits.push_back(part);
    };
    if (const auto* compound = std::get_if<Compound>(&body.shape))
        for (const Part& part : compound->parts) append(form_of(part.shape, body.tyre), part.position, part.orientation);
    if (const MeshForm* form = mesh_form_of(body.shape)) {
        hulls.reserve(hulls.size() + physics::TRIANGLE_RECORDS * form->triangles.size());
        for (const MeshForm::Triangle& triangle : form->triangles) {
            physics::Traits part{};
            part.shape = physics::SHAPE_TRIANGLE;
            part.large = static_cast<physics::uint>(hulls.size()) << 1;
            part.size = triangle.half_extents;
            const std::vector<physics::uvec4> records = triangle_records(triangle);
            hulls.insert(hulls.end(), records.begin(), records.end());
            append(part, triangle.middle, vec4(0, 0, 0, 1));
        }
    }
}

void State::place(std::uint32_t part) {
    const physics::Traits& own = traits[part];
    poses[part] = physics::pose_of_part(physics::place_in_body(own), physics::turn_in_body(own), poses[own.owner]);
    velocities[part] = physics::velocity_of_part(own, poses[own.owner], velocities[own.owner]);
    rests[part] = 0;
}

Content State::content() const {
    Content found;
    found.joints = has_joints();
    found.vehicles = fixed().vehicles != 0;
    found.breaking = has_fractures();
    found.reordered = reordered();
    found.bounces = fixed().least_restitution > 0;
    for (const physics::Traits& row : traits) {
        found.bounces |= row.restitution > 0;
        found.rolls |= row.rolling_resistance > 0;
        found.tyres |= physics::tyre_of(row) != 0;
        found.round |= physics::has_round_core(row.shape);
        found.hulls |= row.shape == physics::SHAPE_HULL;
        found.convex |= physics::is_general_convex(row.shape);
        found.triangles |= row.shape == physics::SHAPE_TRIANGLE;
        found.moving_parts |= physics::is_part(row) && physics::motion_of(row) != physics::MOTION_FIXED;
    }
    return found;
}

void State::add(const Body& body) {
    physics::Parameters& p = fixed();
    const std::uint32_t n = p.first_part;
    if (reordered()) rows_.push_back(n);
    const auto make_room = [n](auto& table, const auto& record) {
        if (table.size() >= n) table.insert(table.begin() + n, record);
    };
    traits.resize(p.bodies);  // tables of no bodies have a record all the same
    poses.resize(p.bodies);
    velocities.resize(p.bodies);
    rests.resize(p.bodies);
    make_room(traits, traits_of(body, n));
    make_room(poses, start_of(body));
    make_room(velocities, start_velocity_of(body));
    make_room(rests, 0u);
    if (!masses.empty()) make_room(masses, physics::Mass{});
    // It has no contacts yet: where they begin, they end. Those of parts are told by the parts' new rows.
    for (auto* starts : {&first_contacts, &first_contacts_before})
        if (starts->size() > n) make_room(*starts, physics::uint{(*starts)[n]});
    for (auto* list : {&contacts, &contacts_before})
        for (physics::Contact& contact : *list)
            for (physics::uint* row : {&contact.a, &contact.b})
                if (*row >= n) ++*row;
    p.first_part = n + 1;
    ++p.bodies;
    const std::uint32_t old_rows = p.bodies;
    append_parts(body, n);
    p.bodies = static_cast<std::uint32_t>(traits.size());
    p.buckets = std::max(p.buckets, buckets_for(p.bodies));
    allocate();
    for (std::uint32_t i = old_rows; i < p.bodies; ++i) {
        place(i);
        for (auto* starts : {&first_contacts, &first_contacts_before})
            if (starts->size() > i + 1) (*starts)[i + 1] = (*starts)[i];
    }
}

}  // namespace scree
