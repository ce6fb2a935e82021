// Bodies, shapes, contacts and joints of a world as chunks of a recording.
#include "demos/film/pages/world_chunks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <variant>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/shape_geometry.h"
#include "compute/tables/state.h"
#include "host/canvas/colors.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::demos {

namespace {

// Shapes that need no mesh, by their number in parts of bodies; meshes follow.
enum Drawn : std::uint32_t { drawn_sphere, drawn_box, drawn_capsule, drawn_cylinder, drawn_cone, first_mesh = 8 };

// Of the scene's shape, for what readers draw and tell.
void put_hull(ChunkBytes& to, const HullForm& form) {
    to.u8(0);
    to.count(form.vertices.size());
    to.count(form.faces.size());
    for (const glm::dvec3& vertex : form.vertices) to.vector(glm::vec3(vertex));
    for (const HullForm::Face& face : form.faces) {
        to.count(face.corners.size());
        for (const std::uint32_t corner : face.corners) to.count(corner);
    }
}
void put_mesh(ChunkBytes& to, const Mesh& mesh) {
    to.u8(1);
    to.count(mesh.vertices.size());
    to.count(mesh.triangles.size());
    for (const glm::vec3& vertex : mesh.vertices) to.vector(vertex);
    for (const glm::uvec3& triangle : mesh.triangles)
        for (glm::length_t k = 0; k < 3; ++k) to.count(triangle[k]);
}
void put_field(ChunkBytes& to, const HeightField& field) {
    to.u8(2);
    to.count(field.columns);
    to.count(field.rows);
    to.f32(field.spacing);
    for (const float height : field.heights) to.f32(height);
}

struct Sized {
    std::uint32_t drawn;
    glm::vec3 size;
};
Sized sized(const Sphere& s) {
    return {drawn_sphere, glm::vec3(s.radius)};
}
Sized sized(const Ellipsoid& s) {
    return {drawn_sphere, s.radii};
}
Sized sized(const Capsule& s) {
    return {drawn_capsule, {s.radius, s.half_height, s.radius}};
}
Sized sized(const Box& s) {
    return {drawn_box, s.half_extents};
}
Sized sized(const Cylinder& s) {
    return {drawn_cylinder, {s.radius, s.half_height, s.radius}};
}
Sized sized(const Cone& s) {
    return {drawn_cone, {s.radius, s.height, s.radius}};
}
Sized sized(const Hull&) {
    return {first_mesh, glm::vec3(1)};
}
Sized sized(const Plane&) {
    return {first_mesh, glm::vec3(1)};
}

bool has_axis(const JointKind& kind) {
    return !std::holds_alternative<Ball>(kind) && !std::holds_alternative<Fixed>(kind) && !std::holds_alternative<Distance>(kind);
}

// A unit vector on an octahedron, 0 to 255 for -1 to 1.
glm::vec2 on_octahedron(glm::vec3 n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 at = sum > 0 ? glm::vec2(n.x, n.z) / sum : glm::vec2(0);
    if (n.y < 0) at = {std::copysign(1 - std::abs(at.y), n.x), std::copysign(1 - std::abs(at.x), n.z)};
    return 127.5f + 127.5f * at;
}

}  // namespace

std::uint32_t WorldChunks::mesh_of(std::string& block, const void* key, const Shape& shape) {
    const auto [found, fresh] = meshes_.try_emplace(key, first_mesh + static_cast<std::uint32_t>(meshes_.size()));
    if (!fresh) return found->second;
    ChunkBytes mesh;
    if (const auto* hull = std::get_if<Hull>(&shape)) {
        put_hull(mesh, *hull->form);
        kept_.push_back(hull->form);
    } else if (const auto* field = std::get_if<HeightField>(&shape)) {
        put_field(mesh, *field);
        kept_.push_back(field->form);
    } else {
        put_mesh(mesh, std::get<Mesh>(shape));
        kept_.push_back(std::get<Mesh>(shape).form);
    }
    append_chunk(block, "mesh", mesh);
    return found->second;
}

void WorldChunks::add_part(std::string& block, ChunkBytes& to, const Shape& shape, glm::vec3 position, glm::vec4 orientation) {
    Sized drawn{first_mesh, glm::vec3(1)};
    if (const auto* hull = std::get_if<Hull>(&shape)) {
        drawn.drawn = mesh_of(block, hull->form.get(), shape);
    } else if (const std::optional<SimpleShape> simple = simple_shape(shape)) {
        drawn = std::visit([](const auto& one) { return sized(one); }, *simple);
    } else {
        const auto* field = std::get_if<HeightField>(&shape);
        drawn.drawn = mesh_of(block, field ? field->form.get() : std::get<Mesh>(shape).form.get(), shape);
    }
    to.count(drawn.drawn);
    to.vector(drawn.size);
    to.vector(position);
    for (glm::length_t k = 0; k < 4; ++k) to.f32(orientation[k]);
}

ChunkBytes WorldChunks::described(std::string& block, const World& world, std::size_t id) {
    const Scene& scene = world.scene();
    const scree::Body& body = scene.bodies[id];
    const physics::BodyProperties& properties = world.state().properties[world.state().row_of(id)];
    std::optional<glm::vec3> color = body.color;
    for (std::size_t piece = id; !color && scene.bodies[piece].piece_of < piece;) {  // fragments have that of what they are of
        piece = scene.bodies[piece].piece_of;
        color = scene.bodies[piece].color;
    }
    ChunkBytes to;
    to.count(id);
    to.text(body.name);
    to.u8(static_cast<std::uint32_t>(body.motion));
    to.u8((color ? 1u : 0u) | (body.piece_of < id ? 2u : 0u));
    if (color)
        for (glm::length_t k = 0; k < 3; ++k)
            to.u8(static_cast<std::uint32_t>(std::lround(255 * std::clamp((*color)[k], 0.0f, 1.0f))));
    to.f32(properties.inverse_mass > 0 ? 1 / properties.inverse_mass : 0);
    for (glm::length_t k = 0; k < 3; ++k) to.f32(properties.inverse_inertia[k] > 0 ? 1 / properties.inverse_inertia[k] : 0);
    to.text(shape_name(body.shape));
    ChunkBytes parts;
    std::size_t count = 0;
    if (const auto* plane = std::get_if<Plane>(&body.shape)) {
        to.u8(1);
        to.vector(plane->normal);
        to.f32(plane->offset);
    } else {
        to.u8(0);
    }
    if (const auto* compound = std::get_if<Compound>(&body.shape)) {
        for (const Part& part : compound->parts) {
            if (part.role == Role::sensor || body.role == Role::sensor || (part.skinned && !compound->skins.empty())) continue;
            add_part(block, parts, whole_shape(part.shape), part.position, part.orientation);
            ++count;
        }
        for (const Skin& skin : compound->skins) {
            if (body.role == Role::sensor) continue;
            add_part(block, parts, *skin.mesh, skin.position, skin.orientation);
            ++count;
        }
    } else if (!std::holds_alternative<Plane>(body.shape) && body.role != Role::sensor) {
        add_part(block, parts, body.shape, glm::vec3(0), glm::vec4(0, 0, 0, 1));
        count = 1;
    }
    to.count(count);
    to.append(parts);
    return to;
}

void WorldChunks::take_joints(std::string& block, const World& world) {
    const Scene& scene = world.scene();
    if (scene.joints.size() == joints_) return;
    joints_ = scene.joints.size();
    ChunkBytes to;
    to.count(scene.joints.size());
    for (const Joint& joint : scene.joints) {
        to.count(joint.a == the_world ? 0 : place_of(joint.a));
        to.count(joint.b == the_world ? 0 : place_of(joint.b));
        to.u8(has_axis(joint.kind) ? 1 : 0);
        to.vector(joint.anchor_a);
        to.vector(joint.anchor_b);
        for (glm::length_t k = 0; k < 4; ++k) to.f32(joint.frame_a[k]);
    }
    append_chunk(block, "join", to);
}

void WorldChunks::take_new(std::string& block, const World& world) {
    if (begun_ && arrangements_ == world.arrangements()) {
        take_joints(block, world);
        return;
    }
    const Scene& scene = world.scene();
    for (Followed& body : bodies_) body.gone = body.gone || !world.is_valid(body.handle);
    std::fill(places_.begin(), places_.end(), 0);
    places_.resize(scene.bodies.size());
    for (std::uint32_t place = 0; place < bodies_.size(); ++place)
        if (!bodies_[place].gone) places_[bodies_[place].id] = place + 1;
    ChunkBytes fresh;
    std::size_t count = 0;
    for (std::size_t id = 0; id < scene.bodies.size(); ++id) {
        const std::size_t copy = id / world.bodies_of_copy();
        const bool plane = std::holds_alternative<Plane>(scene.bodies[id].shape);
        if (places_[id] != 0 || !shown_.shows(copy) || (plane && copy > shown_.first)) continue;
        Followed body;
        try {
            body.handle = world.handle_of(id);
        } catch (const std::out_of_range&) {
            continue;  // removed before
        }
        body.id = id;
        body.plane = plane;
        if (shown_.count > 0) body.offset = shown_.offset(copy);
        fresh.append(described(block, world, id));
        ++count;
        bodies_.push_back(body);
        places_[id] = static_cast<std::uint32_t>(bodies_.size());
    }
    arrangements_ = world.arrangements();
    begun_ = true;
    if (count > 0) {
        ChunkBytes all;
        all.count(count);
        all.append(fresh);
        append_chunk(block, "body", all);
    }
    take_joints(block, world);
}

const std::vector<BodyMoment>& WorldChunks::look(const World& world) {
    const State& state = world.state();
    const physics::Parameters& fixed = state.fixed();
    forces_.assign(state.properties.size(), 0);
    for (std::uint32_t i = 0; i < state.counted().contacts; ++i) {
        const physics::Contact& contact = state.contacts[i];
        const glm::vec4 normal = state.impulses[i].normal;
        const float force = (normal.x + normal.y + normal.z + normal.w) * fixed.inverse_h;
        if (!(force > 0)) continue;
        forces_[state.body_of(contact.a)] += force;
        forces_[state.body_of(contact.b)] += force;
    }
    moments_.resize(bodies_.size());
    for (std::size_t place = 0; place < bodies_.size(); ++place) {
        const Followed& body = bodies_[place];
        BodyMoment& moment = moments_[place];
        if (body.gone) {
            moment.exists = moment.asleep = false;
            continue;
        }
        const std::uint32_t row = state.row_of(body.id);
        const physics::uint motion = state.properties[row].motion;
        moment.exists = !physics::is_absent(motion);
        moment.asleep = moment.exists && motion == physics::MOTION_DYNAMIC && fixed.sleep_steps != physics::NO_SLEEP &&
                        physics::has_slept(state.sleep_states[row], fixed.sleep_steps);
        if (body.plane || !moment.exists) continue;
        moment.position = state.poses[row].position + body.offset;
        moment.orientation = state.poses[row].orientation;
        moment.velocity = motion == physics::MOTION_FIXED ? glm::vec3(0) : state.velocities[row].linear;
        moment.force = motion == physics::MOTION_FIXED ? 0 : forces_[row];
    }
    return moments_;
}

std::vector<WorldChunks::TouchingPoint> WorldChunks::touching(const World& world, const FrameUnits& units,
                                                              const std::vector<Follower>& followers) const {
    std::vector<TouchingPoint> points;
    const double unit = 4 * units.position;
    for (const ContactState& contact : world.contacts()) {
        const std::uint32_t a = place_of(contact.a), b = place_of(contact.b);
        if (a == 0 || b == 0) continue;
        const std::uint32_t beside = bodies_[a - 1].plane ? b : a;
        const glm::vec2 normal = on_octahedron(contact.normal);
        for (std::uint32_t k = 0; k < contact.count; ++k) {
            const double force = static_cast<double>(contact.points[k].force);
            if (!(force >= units.force)) continue;
            TouchingPoint& point = points.emplace_back();
            point.a = a;
            point.b = b;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto axis = static_cast<glm::length_t>(i);
                const double at = static_cast<double>(contact.points[k].position[axis] + bodies_[beside - 1].offset[axis]);
                point.exact[i] = std::clamp((at - followers[beside - 1].position[i] * units.part()) / unit, -1e8, 1e8);
            }
            point.exact[3] = static_cast<double>(normal.x);
            point.exact[4] = static_cast<double>(normal.y);
            point.exact[5] = 1 + FrameUnits::levels_per_octave * std::log2(force / units.force);
        }
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const TouchingPoint& x, const TouchingPoint& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    return points;
}

void WorldChunks::add_contacts(ChunkBytes& to, const World& world, const FrameUnits& units,
                               const std::vector<Follower>& followers, bool whole) {
    if (whole) touching_.clear();
    std::vector<TouchingPoint> now = touching(world, units, followers);
    BitRow stays, changed;
    ChunkBytes fresh_a, fresh_b;
    std::array<ChunkBytes, 6> columns, fresh;
    std::size_t fresh_count = 0, old = 0;
    std::uint32_t before = 0;
    for (TouchingPoint& point : now) {
        const auto comes_before = [&](const TouchingPoint& x) { return std::tie(x.a, x.b) < std::tie(point.a, point.b); };
        for (; old < touching_.size() && comes_before(touching_[old]); ++old) stays.add(false);
        const bool known = old < touching_.size() && touching_[old].a == point.a && touching_[old].b == point.b;
        if (known) {
            stays.add(true);
            point.told = touching_[old++].told;
            bool differs = false;
            for (std::size_t k = 0; k < 6; ++k)
                differs = differs || std::abs(point.exact[k] - point.told[k]) > (k < 3 ? 0.75 : 1.5);
            changed.add(differs);
            if (!differs) continue;
        } else {
            fresh_a.integer(static_cast<std::int32_t>(point.a) - static_cast<std::int32_t>(before));
            fresh_b.integer(static_cast<std::int32_t>(point.b) - static_cast<std::int32_t>(point.a));
            before = point.a;
            ++fresh_count;
        }
        for (std::size_t k = 0; k < 6; ++k) {
            const auto value = static_cast<std::int32_t>(std::lround(point.exact[k]));
            (known ? columns : fresh)[k].integer(value - point.told[k]);
            point.told[k] = value;
        }
    }
    for (; old < touching_.size(); ++old) stays.add(false);
    to.part(stays.row);
    to.part(changed.row);
    for (const ChunkBytes& column : columns) to.part(column);
    to.count(fresh_count);
    to.part(fresh_a);
    to.part(fresh_b);
    for (const ChunkBytes& column : fresh) to.part(column);
    touching_ = std::move(now);
}

void WorldChunks::add_joints(ChunkBytes& to, const World& world, const FrameUnits& units, bool whole) {
    const std::vector<JointState> joints = world.joints();
    std::vector<float> forces;
    BitRow broken;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        forces.push_back(glm::length(joints[j].force));
        broken.add(joints[j].broken || std::holds_alternative<Coupling>(world.scene().joints[j].kind));  // has no place
    }
    to.count(joints.size());
    to.part(broken.row);
    joint_forces_.encode(to, forces, units.force, whole);
}

}  // namespace scree::demos
