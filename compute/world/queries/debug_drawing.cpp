// A world as lines and points.
#include "compute/debug_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/shape_geometry.h"
#include "compute/world.h"
#include "shaders/physics/base/shapes.h"

namespace scree {

namespace {

constexpr vec3 of_fixed{0.55f}, of_kinematic{0.45f, 0.6f, 0.95f}, of_dynamic{0.95f}, of_sensor{0.95f, 0.85f, 0.2f},
    of_speculative{0.5f}, of_touching{1, 0.9f, 0.1f}, of_normal{1}, of_force{0.95f, 0.2f, 0.15f}, of_friction{0.2f, 0.8f, 0.25f},
    of_lever{0.6f}, of_gap{1, 0, 1}, of_box{0.1f, 0.4f, 0.15f};
constexpr std::array<vec3, 3> of_axes{vec3(0.95f, 0.2f, 0.15f), vec3(0.2f, 0.8f, 0.25f), vec3(0.25f, 0.4f, 1)};
constexpr float plane_reach = 10;  // m

glm::quat quaternion(vec4 q) {
    return {q.w, q.x, q.y, q.z};
}

// Draws in a frame.
struct Pen {
    DebugDrawing& on;
    vec3 color;
    int segments;
    vec3 position{0};
    glm::quat turn{1, 0, 0, 0};

    vec3 out(vec3 local) const { return position + turn * local; }
    void line(vec3 from, vec3 to) const { on.lines.push_back({out(from), out(to), color}); }
    void point(vec3 at) const { on.points.push_back({out(at), color}); }
    // Of an ellipse, from one angle to another, rad.
    void arc(vec3 middle, vec3 u, vec3 v, float begin = 0, float end = glm::two_pi<float>()) const {
        const int pieces =
            std::max(1, static_cast<int>(std::lround(static_cast<float>(segments) * (end - begin) / glm::two_pi<float>())));
        const auto at = [&](int k) {
            const float angle = begin + (end - begin) * static_cast<float>(k) / static_cast<float>(pieces);
            return middle + u * portable::cos(angle) + v * portable::sin(angle);
        };
        for (int k = 0; k < pieces; ++k) line(at(k), at(k + 1));
    }
    void box(vec3 least, vec3 most) const {
        const auto corner = [&](int k) {
            return vec3(k & 1 ? most.x : least.x, k & 2 ? most.y : least.y, k & 4 ? most.z : least.z);
        };
        for (int k = 0; k < 8; ++k)
            for (const int bit : {1, 2, 4})
                if (!(k & bit)) line(corner(k), corner(k | bit));
    }
    Pen within(vec3 at, vec4 orientation) const {
        Pen inner = *this;
        inner.position = out(at);
        inner.turn = turn * quaternion(orientation);
        return inner;
    }
};

constexpr vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

void draw(const Pen& pen, const Sphere& s) {
    for (const auto& [u, v] : {std::pair(x, y), {y, z}, {z, x}}) pen.arc(vec3(0), u * s.radius, v * s.radius);
}
void draw(const Pen& pen, const Ellipsoid& e) {
    for (const auto& [u, v] : {std::pair(x, y), {y, z}, {z, x}}) pen.arc(vec3(0), u * e.radii, v * e.radii);
}
void draw(const Pen& pen, const Box& b) {
    pen.box(-b.half_extents, b.half_extents);
}
// Four lines between two rings about y.
void draw_side(const Pen& pen, float below, float radius_below, float above, float radius_above) {
    for (const vec3 way : {x, z, -x, -z}) pen.line(way * radius_below + y * below, way * radius_above + y * above);
    for (const auto& [height, radius] : {std::pair(below, radius_below), {above, radius_above}})
        if (radius > 0) pen.arc(y * height, x * radius, z * radius);
}
void draw(const Pen& pen, const Capsule& c) {
    draw_side(pen, -c.half_height, c.radius, c.half_height, c.radius);
    for (const float side : {-1.0f, 1.0f})
        for (const vec3 across : {x, z})
            pen.arc(y * (side * c.half_height), across * c.radius, y * (side * c.radius), 0, glm::pi<float>());
}
void draw(const Pen& pen, const Cylinder& c) {
    draw_side(pen, -c.half_height, c.radius, c.half_height, c.radius);
}
void draw(const Pen& pen, const Cone& c) {
    draw_side(pen, -0.25f * c.height, c.radius, 0.75f * c.height, 0);
}
void draw(const Pen& pen, const Plane& plane) {
    Pen flat = pen;  // whose pose it ignores
    flat.position = vec3(0);
    flat.turn = glm::quat(1, 0, 0, 0);
    const vec3 across = glm::normalize(glm::cross(plane.normal, std::abs(plane.normal.x) < 0.7f ? x : y));
    const vec3 along = glm::cross(plane.normal, across), middle = plane.normal * plane.offset;
    for (int k = -2; k <= 2; ++k) {
        const float at = 0.5f * static_cast<float>(k) * plane_reach;
        flat.line(middle + across * at - along * plane_reach, middle + across * at + along * plane_reach);
        flat.line(middle + along * at - across * plane_reach, middle + along * at + across * plane_reach);
    }
    flat.line(middle, middle + plane.normal);
}
void draw(const Pen& pen, const Hull& hull) {
    for (const HullForm::Face& face : hull.form->faces)  // each edge is one of two faces
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const std::uint32_t from = face.corners[k], to = face.corners[(k + 1) % face.corners.size()];
            if (from < to) pen.line(vec3(hull.form->vertices[from]), vec3(hull.form->vertices[to]));
        }
}
void draw(const Pen& pen, const Mesh& mesh) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const glm::uvec3& corners : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
            if (edges.insert(std::minmax(from, to)).second) pen.line(mesh.vertices[from], mesh.vertices[to]);
        }
}
vec3 grid_point(const HeightField& field, std::uint32_t column, std::uint32_t row) {
    const float half_x = 0.5f * static_cast<float>(field.columns - 1), half_z = 0.5f * static_cast<float>(field.rows - 1);
    return {(static_cast<float>(column) - half_x) * field.spacing, field.heights[std::size_t{row} * field.columns + column],
            (static_cast<float>(row) - half_z) * field.spacing};
}
void draw(const Pen& pen, const HeightField& field) {
    for (std::uint32_t row = 0; row < field.rows; ++row)
        for (std::uint32_t column = 0; column < field.columns; ++column) {
            const vec3 here = grid_point(field, column, row);
            if (column + 1 < field.columns) pen.line(here, grid_point(field, column + 1, row));
            if (row + 1 < field.rows) pen.line(here, grid_point(field, column, row + 1));
        }
}
void draw(const Pen& pen, const Compound& compound) {
    for (const Part& part : compound.parts) {
        Pen inner = pen.within(part.position, part.orientation);
        if (part.role == Role::sensor) inner.color = of_sensor;
        std::visit([&](const auto& shape) { draw(inner, shape); }, part.shape);
    }
}

// Boxes along the world's axes.
void draw_box_about(const Pen& pen, const std::vector<vec3>& points) {
    vec3 least(unlimited), most(-unlimited);
    for (const vec3& point : points) {
        least = glm::min(least, pen.out(point));
        most = glm::max(most, pen.out(point));
    }
    if (!points.empty()) Pen{pen.on, of_box, pen.segments}.box(least, most);
}
void draw_box(const Pen& pen, const SimpleShape& shape) {
    if (std::holds_alternative<Plane>(shape)) return;
    if (const auto* hull = std::get_if<Hull>(&shape)) {
        const std::vector<glm::dvec3>& vertices = hull->form->vertices;
        return draw_box_about(pen, {vertices.begin(), vertices.end()});
    }
    const glm::quat q = pen.turn;
    const vec3 half =
        physics::world_half_extents(static_cast<physics::uint>(shape.index()), record_size(shape), {q.x, q.y, q.z, q.w});
    Pen{pen.on, of_box, pen.segments}.box(pen.position - half, pen.position + half);
}
void draw_boxes(const Pen& pen, const Shape& shape) {
    if (const std::optional<SimpleShape> simple = simple_shape(shape)) return draw_box(pen, *simple);
    if (const auto* compound = std::get_if<Compound>(&shape))
        for (const Part& part : compound->parts) draw_box(pen.within(part.position, part.orientation), part.shape);
    if (const auto* mesh = std::get_if<Mesh>(&shape)) draw_box_about(pen, mesh->vertices);
    if (const auto* field = std::get_if<HeightField>(&shape)) {
        std::vector<vec3> points;
        for (std::uint32_t row = 0; row < field->rows; ++row)
            for (std::uint32_t column = 0; column < field->columns; ++column) points.push_back(grid_point(*field, column, row));
        draw_box_about(pen, points);
    }
}

vec3 color_of(const Body& body, const BodyState& state) {
    vec3 color = of_dynamic;
    if (body.motion == Motion::fixed) color = of_fixed;
    if (body.motion == Motion::kinematic) color = of_kinematic;
    if (body.role == Role::sensor) color = of_sensor;
    return body.color.value_or(color) * (state.asleep ? 0.6f : 1.0f);
}

void draw_contact(DebugDrawing& on, const ContactState& contact, const DebugWanted& wanted) {
    float sum = 0;
    for (std::uint32_t k = 0; k < contact.count; ++k) sum += contact.points[k].force;
    for (std::uint32_t k = 0; k < contact.count; ++k) {
        const ContactState::Point& point = contact.points[k];
        const bool touches = point.separation <= 0 || point.force > 0;
        on.points.push_back({point.position, touches ? of_touching : of_speculative});
        if (!touches) continue;
        const auto arrow = [&](vec3 way, vec3 color) {
            if (way != vec3(0)) on.lines.push_back({point.position, point.position + way, color});
        };
        arrow(contact.normal * wanted.line_length, of_normal);
        arrow(contact.normal * (point.force * wanted.force_length), of_force);
        // The friction of a contact is one vector: each point shows its share by its normal force.
        if (sum > 0) arrow(contact.friction * (point.force / sum * wanted.force_length), of_friction);
    }
}

void draw_joint(DebugDrawing& on, const Joint& joint, const std::vector<BodyState>& bodies, const DebugWanted& wanted) {
    const auto frame = [&](std::size_t body, vec3 anchor, vec4 turn) {
        const Pen world{on, of_lever, wanted.segments};
        const Pen at =
            (body == the_world ? world : world.within(bodies[body].position, bodies[body].orientation)).within(anchor, turn);
        if (body != the_world) on.lines.push_back({bodies[body].position, at.position, of_lever});
        at.point(vec3(0));
        return at;
    };
    Pen a = frame(joint.a, joint.anchor_a, joint.frame_a);
    const Pen b = frame(joint.b, joint.anchor_b, joint.frame_b);
    if (a.position != b.position) on.lines.push_back({a.position, b.position, of_gap});
    for (std::size_t k = 0; k < 3; ++k) {
        a.color = of_axes[k];
        a.line(vec3(0), std::array{x, y, z}[k] * wanted.line_length);
    }
}

void check(const DebugWanted& wanted, std::size_t bodies) {
    const auto holds = [](float value) { return value >= 0 && value <= 1e6f; };
    if (wanted.segments < 3 || wanted.segments > 360) throw std::invalid_argument("debug_drawing: segments must be 3 to 360");
    if (!holds(wanted.line_length)) throw std::invalid_argument("debug_drawing: line_length must be between 0 and 1000000 m");
    if (!holds(wanted.force_length)) throw std::invalid_argument("debug_drawing: force_length must be between 0 and 1000000 m/N");
    for (const std::size_t body : wanted.bodies)
        if (body >= bodies)
            throw std::out_of_range("debug_drawing: body " + std::to_string(body) + " of " + std::to_string(bodies));
}

}  // namespace

DebugDrawing debug_drawing(const World& world, const DebugWanted& wanted) {
    const std::vector<BodyState> states = world.bodies();
    const std::vector<Body>& bodies = world.scene().bodies;
    check(wanted, states.size());
    std::vector<bool> chosen(states.size(), wanted.bodies.empty());
    for (const std::size_t body : wanted.bodies) chosen[body] = true;
    const auto is_chosen = [&](std::size_t body) { return body != the_world && chosen[body]; };
    DebugDrawing made;
    const auto for_each_body = [&](const auto& visit) {
        for (std::size_t i = 0; i < states.size(); ++i)
            if (chosen[i] && states[i].exists)
                visit(Pen{made, color_of(bodies[i], states[i]), wanted.segments, states[i].position,
                          quaternion(states[i].orientation)},
                      bodies[i].shape);
    };
    if (wanted.shapes)
        for_each_body([](const Pen& pen, const Shape& shape) { std::visit([&](const auto& one) { draw(pen, one); }, shape); });
    if (wanted.contacts)
        for (const ContactState& contact : world.contacts())
            if (is_chosen(contact.a) || is_chosen(contact.b)) draw_contact(made, contact, wanted);
    if (wanted.joints && !world.scene().joints.empty()) {
        const std::vector<JointState> joints = world.joints();
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const Joint& joint = world.scene().joints[j];
            if (!joints[j].broken && (is_chosen(joint.a) || is_chosen(joint.b))) draw_joint(made, joint, states, wanted);
        }
    }
    if (wanted.boxes) for_each_body(draw_boxes);
    return made;
}

}  // namespace scree
