// Validation of a periodic cell.
#include "compute/scene/validation/periodic_validation.h"

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "compute/scene/meshes/mesh.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/scene.h"

namespace scree {

namespace {

constexpr float least_period = 0.01f;  // m
constexpr const char* axis_names[] = {"x", "y", "z"};

// `is_wall`: it may be wide, since grains meet it at one image.
void check_body(const Examination& at, const Body& body, const PeriodicCell& cell, int k, bool is_wall) {
    const std::string along = std::string(" along ") + axis_names[k] + ", where the cell is periodic";
    if (const auto* plane = std::get_if<Plane>(&body.shape)) {
        if (std::abs(plane->normal[k]) > 1e-6f) at.refuse("/shape/plane/normal", "a plane must not face" + along);
        return;
    }
    const float size = cell.size[k], reach = bounding_radius(body.shape);
    if (body.motion == Motion::fixed && std::abs(body.position[k] - cell.centre[k]) > 0.5f * size)
        at.refuse("/position/" + std::to_string(k),
                  "a fixed body must be within the " + text_of(size) + " m of the cell" + along);
    const bool has_parts = std::holds_alternative<Compound>(body.shape) || mesh_form_of(body.shape);
    if (reach <= 0.25f * size || (is_wall && !has_parts)) return;
    at.refuse("/shape", "it reaches " + text_of(reach) + " m from its centre, more than a quarter of the cell's " +
                            text_of(size) + " m" + along + "; a single shape may if it is fixed, kinematic or on a joint");
}

void check_sizes(const Examination& at, const PeriodicCell& cell) {
    for (int k = 0; k < 3; ++k) {
        const std::string axis = std::to_string(k);
        if (cell.size[k] > 0 && cell.size[k] < least_period)
            at.refuse("/size/" + axis,
                      "must be 0 or at least " + text_of(least_period) + " m, is " + text_of(cell.size[k]) + " m");
        if (cell.rate[k] != 0 && cell.size[k] == 0)
            at.refuse("/rate/" + axis, "the cell is not periodic along " + std::string(axis_names[k]) + ": give it a size there");
    }
}

}  // namespace

void check_periodic_cell(const Scene& scene) {
    const PeriodicCell& cell = scene.periodic;
    const Examination whole, at = whole / "periodic";
    schema::check_fields(at, cell);
    check_sizes(at, cell);
    if (!cell.any()) return;
    if (cell.rate != vec3(0) && !scene.joints.empty())
        at.refuse("/rate", "a cell with joints cannot stretch: move its walls instead (servo_walls)");
    std::vector<bool> on_joint(scene.bodies.size());
    for (const Joint& joint : scene.joints)
        for (const std::size_t body : {joint.a, joint.b})
            if (body < on_joint.size()) on_joint[body] = true;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& body = scene.bodies[i];
        for (int k = 0; k < 3; ++k)
            if (cell.size[k] > 0)
                check_body(Examination("bodies", "body", i, body.name), body, cell, k,
                           body.motion != Motion::dynamic || on_joint[i]);
    }
}

}  // namespace scree
