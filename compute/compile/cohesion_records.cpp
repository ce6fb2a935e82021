// Records of cohesion: the radius of the ball that has a body's volume.
#include <algorithm>
#include <numbers>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/scene/compound.h"
#include "compute/scene/portable_math.h"

namespace scree {

namespace {

bool is_cohesive(const Body& body) {
    if (body.cohesion > 0) return true;
    const auto* compound = std::get_if<Compound>(&body.shape);
    return compound && std::any_of(compound->parts.begin(), compound->parts.end(),
                                   [](const Part& part) { return part.material && part.material->cohesion > 0; });
}

double volume_of(const Body& body) {
    const auto* compound = std::get_if<Compound>(&body.shape);
    if (!compound) return static_cast<double>(mass_properties(body.shape, 1).mass);
    Compound even = *compound;
    for (Part& part : even.parts) part.density = 0;
    return mass_of(even, 1).mass;
}

}  // namespace

float SceneCompiler::curvature_of(const Body& body) {
    if (!is_cohesive(body) || std::holds_alternative<Sphere>(body.shape)) return 0;
    const double volume = volume_of(body);
    return volume > 0 ? static_cast<float>(portable::cbrt(4 * std::numbers::pi / (3 * volume))) : 0;
}

}  // namespace scree
