// Records of fields: parameters, and the box or ellipsoid by which each body meets air and water.
#include <algorithm>
#include <cmath>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/scene/compound.h"
#include "compute/scene/portable_math.h"

namespace scree {

namespace {

// A box with the volume and, up to a common factor, the second moments of a body of that volume.
vec3 box_like(glm::dvec3 inertia, double volume) {
    const double sum = inertia.x + inertia.y + inertia.z;
    glm::dvec3 half = glm::sqrt(glm::max(1.5 * (glm::dvec3(sum) - 2.0 * inertia) / volume, glm::dvec3(1e-12)));
    half *= portable::cbrt(volume / (8 * half.x * half.y * half.z));
    return vec3(half);
}

}  // namespace

physics::Immersion SceneCompiler::immersion_of(const Body& body) {
    physics::Immersion made{};
    made.drag = body.drag;
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) made.half_extents = vec3(sphere->radius);
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&body.shape)) made.half_extents = ellipsoid->radii;
    made.is_round = made.half_extents.x > 0;
    if (auto* compound = std::get_if<Compound>(&body.shape)) {
        Compound even = *compound;
        for (Part& part : even.parts) part.density = 0;
        const WholeMass whole = mass_of(even, 1);
        made.volume = static_cast<float>(whole.mass);
        made.centre = vec3(whole.centre);
        if (whole.mass > 0)
            made.half_extents = box_like({whole.inertia[0][0], whole.inertia[1][1], whole.inertia[2][2]}, whole.mass);
        return made;
    }
    const MassProperties even = mass_properties(body.shape, 1);
    made.volume = even.mass;
    if (made.is_round == 0 && even.mass > 0) made.half_extents = box_like(even.inertia, static_cast<double>(even.mass));
    return made;
}

void SceneCompiler::set_fields(const Scene& scene) {
    const Fields& fields = scene.fields;
    physics::Parameters& p = state_.fixed();
    const Wind wind = fields.wind.value_or(Wind{vec3(0), 0});
    p.wind = wind.velocity;
    p.air_density = wind.density;
    const Water water = fields.water.value_or(Water{.density = 0});
    p.water_normal = water.normal;
    p.water_offset = water.offset;
    p.water_velocity = water.velocity;
    p.water_density = water.density;
    p.water_damping = water.damping;
    p.attractor_radius = fields.attractor_radius;
    p.attractors = static_cast<physics::uint>(fields.attractors.size());
    for (std::size_t i = 0; i < most_attractors; ++i)
        p.attractor[i] =
            i < fields.attractors.size() ? vec4(fields.attractors[i].position, fields.attractors[i].strength) : vec4(0);
    if (p.air_density + p.water_density == 0) {
        state_.immersions.clear();
        return;
    }
    if (state_.immersions.size() == scene.bodies.size()) return;
    state_.immersions.clear();
    for (const Body& body : scene.bodies) state_.immersions.push_back(immersion_of(body));
}

}  // namespace scree
