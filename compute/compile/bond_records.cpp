// Records of bonds, and where the bonds of each body have their changes.
#include <numbers>

#include "compute/compile/scene_compiler.h"

namespace scree {

void SceneCompiler::bond(const Scene& scene) {
    physics::Parameters& p = state_.fixed();
    p.bonds = static_cast<physics::uint>(scene.bonds.size());
    p.bonded = p.bonds > 0 ? p.first_part : 0;
    std::vector<physics::uint> counts(p.bonded), places(p.bonded);
    for (const Bond& bond : scene.bonds) ++counts[bond.a], ++counts[bond.b];
    state_.bonds.clear();
    state_.bond_states.clear();
    state_.bond_ends.clear();
    physics::uint end = 0;
    for (std::size_t id = 0; id < p.bonded; ++id) {
        places[id] = end;
        state_.bond_ends.push_back(end += counts[id]);
    }
    for (const Bond& bond : scene.bonds) {
        physics::Bond record{};
        record.arm_a = bond.anchor_a;
        record.arm_b = bond.anchor_b;
        record.a = static_cast<physics::uint>(bond.a);
        record.b = static_cast<physics::uint>(bond.b);
        record.frame_a = bond.frame_a;
        record.frame_b = bond.frame_b;
        const double radius = bond.radius, area = std::numbers::pi * radius * radius;
        const double stretch = bond.stiffness * area / bond.length;
        record.stretch = static_cast<float>(stretch);
        record.bend = static_cast<float>(stretch * radius * radius / 4);
        record.damping = bond.damping;
        record.inverse_radius = static_cast<float>(1 / radius);
        record.tension = bond.tension;
        record.shear = bond.shear;
        record.place_a = places[bond.a]++;
        record.place_b = places[bond.b]++;
        record.bonds_of_a = static_cast<float>(counts[bond.a]);
        record.bonds_of_b = static_cast<float>(counts[bond.b]);
        state_.bonds.push_back(record);
        state_.bond_states.push_back(bond.broken);
    }
}

}  // namespace scree
