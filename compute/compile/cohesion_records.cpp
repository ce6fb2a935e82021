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

}  // namespace

float SceneCompiler::curvature_of(const Body& body) {
    if (!is_cohesive(body) || std::holds_alternative<Sphere>(body.shape)) return 0;
    const double volume = solid_volume_of(body);
    return volume > 0 ? static_cast<float>(portable::cbrt(4 * std::numbers::pi / (3 * volume))) : 0;
}

}  // namespace scree
