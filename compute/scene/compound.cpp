// Mass of a compound: masses, centres and inertias of its parts, summed in double precision.
#include "compute/scene/compound.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "compute/scene/meshes/hull.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dquat;
using glm::dvec3;

dquat turn_of(const Part& part) {
    return glm::normalize(dquat(part.orientation.w, part.orientation.x, part.orientation.y, part.orientation.z));
}

double reach_of(const Compound& compound) {
    double reach = 0;
    for (const Part& part : compound.parts) reach = std::max(reach, glm::length(dvec3(part.position)));
    return reach;
}

}  // namespace

void move_skins(Compound& compound, const dvec3& centre, const dquat& back) {
    for (Skin& skin : compound.skins) {
        skin.position = vec3(back * (dvec3(skin.position) - centre));
        const dquat turn = glm::normalize(
            back * glm::normalize(dquat(skin.orientation.w, skin.orientation.x, skin.orientation.y, skin.orientation.z)));
        skin.orientation = vec4(glm::dvec4(turn.x, turn.y, turn.z, turn.w));
    }
}

WholeMass mass_of(const Compound& compound, float density) {
    WholeMass whole;
    std::vector<MassProperties> parts;
    for (const Part& part : compound.parts) {
        if (part.role != Role::solid) {
            parts.emplace_back();
            continue;
        }
        parts.push_back(mass_properties(whole_shape(part.shape), part.density > 0 ? part.density : density));
        whole.mass += parts.back().mass;
        whole.centre += dvec3(part.position) * static_cast<double>(parts.back().mass);
    }
    if (whole.mass > 0) whole.centre /= whole.mass;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const dmat3 turn = glm::mat3_cast(turn_of(compound.parts[i]));
        dmat3 own(0);
        for (int k = 0; k < 3; ++k) own[k][k] = parts[i].inertia[k];
        // Parallel axis theorem (Steiner): plus m (|r|^2 1 - r r^T).
        const dvec3 r = dvec3(compound.parts[i].position) - whole.centre;
        whole.inertia += turn * own * glm::transpose(turn) +
                         static_cast<double>(parts[i].mass) * (glm::dot(r, r) * dmat3(1) - glm::outerProduct(r, r));
    }
    return whole;
}

double solid_volume_of(const Body& body) {
    const auto* compound = std::get_if<Compound>(&body.shape);
    if (!compound) return static_cast<double>(mass_properties(body.shape, 1).mass);
    Compound even = *compound;
    for (Part& part : even.parts) part.density = 0;
    return mass_of(even, 1).mass;
}

Recentred bring_to_centre(Compound& compound, float density) {
    Recentred before;
    const WholeMass whole = mass_of(compound, density);
    const dmat3 axes = principal_axes(whole.inertia);
    const double rounding = 1e-6 * (reach_of(compound) + 1e-3);
    if (axes == dmat3(1) && glm::length(whole.centre) <= rounding) return before;
    before.centre = whole.centre;
    before.axes = glm::normalize(glm::quat_cast(axes));
    const dquat back = glm::conjugate(before.axes);
    for (Part& part : compound.parts) {
        part.position = vec3(back * (dvec3(part.position) - whole.centre));
        const dquat turn = glm::normalize(back * turn_of(part));
        if (axes != dmat3(1)) part.orientation = vec4(glm::dvec4(turn.x, turn.y, turn.z, turn.w));
    }
    move_skins(compound, whole.centre, back);
    return before;
}

}  // namespace scree
