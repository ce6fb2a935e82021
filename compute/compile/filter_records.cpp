// Records of collision filters: a row of filters for each body and part, and lists of excluded partners.
#include <algorithm>
#include <optional>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/scene/fracture.h"

namespace scree {

namespace {

physics::uvec4 record_of(const Filter& filter, physics::uint excluded) {
    return {filter.category, filter.mask, static_cast<physics::uint>(filter.group), excluded};
}

}  // namespace

bool has_filter(const Body& body) {
    if (body.filter) return true;
    const auto* compound = std::get_if<Compound>(&body.shape);
    return compound &&
           std::any_of(compound->parts.begin(), compound->parts.end(), [](const Part& part) { return part.filter.has_value(); });
}

// Parts are in the order of their bodies, as append_parts makes them, unless bodies were added or removed since: a part's
// number within its body follows from its predecessors.
void SceneCompiler::filter(const Scene& scene) {
    state_.filters.clear();
    state_.exclusions.clear();
    if (scene.exclusions.empty() && std::none_of(scene.bodies.begin(), scene.bodies.end(), has_filter)) return;
    const physics::Parameters& p = state_.fixed();
    state_.filters.assign(p.bodies, no_filter);
    std::vector<physics::uint> heads(scene.bodies.size(), physics::NONE);
    const auto exclude = [&](std::size_t body, std::size_t partner) {
        state_.exclusions.emplace_back(static_cast<physics::uint>(partner), heads[body], 0u, 0u);
        heads[body] = static_cast<physics::uint>(state_.exclusions.size() - 1);
    };
    // Fragments exclude what their body does, and are excluded with it.
    const auto exclude_all = [&](std::size_t body, std::size_t partner) {
        exclude(body, partner);
        for (const std::size_t fragment : fragments_of(scene, partner)) exclude(body, fragment);
    };
    for (const Exclusion& pair : scene.exclusions) exclude_all(pair.a, pair.b), exclude_all(pair.b, pair.a);
    for (std::size_t id = 0; !scene.exclusions.empty() && id < scene.bodies.size(); ++id)
        for (const std::size_t fragment : scene.bodies[id].piece_of == no_body && scene.bodies[id].fracture
                                              ? fragments_of(scene, id)
                                              : std::vector<std::size_t>{})
            heads[fragment] = heads[id];
    for (std::size_t id = 0; id < scene.bodies.size(); ++id) {
        const Body& body = scene.bodies[id];
        state_.filters[state_.row_of(id)] = record_of(body.filter.value_or(Filter{}), heads[id]);
    }
    std::uint32_t owner = physics::NONE, part = 0;
    for (std::uint32_t row = p.first_part; row < p.bodies; ++row) {
        const physics::BodyProperties& properties = state_.properties[row];
        if ((properties.motion & physics::MOTION_OF_PART) == 0) continue;  // a spare row
        part = properties.owner == owner ? part + 1 : 0;
        owner = properties.owner;
        const std::uint32_t id = state_.id_of(owner);
        state_.filters[row] = state_.filters[owner];
        const auto* compound = std::get_if<Compound>(&scene.bodies[id].shape);
        if (compound && compound->parts[part].filter) state_.filters[row] = record_of(*compound->parts[part].filter, heads[id]);
    }
}

}  // namespace scree
