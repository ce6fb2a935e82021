// Materials and filters of glTF physics.
#include "compute/scene_file/import/gltf/gltf_materials.h"

#include <algorithm>

namespace scree::imports {

std::vector<Material> gltf_materials(const GltfValue& materials) {
    std::vector<Material> all;
    static const std::vector<std::string> rules = {"average", "minimum", "maximum", "multiply"};
    // Of two rules the earlier of these counts in glTF.
    static const CombineRule of[] = {CombineRule::overriding_average, CombineRule::overriding_minimum, CombineRule::maximum,
                                     CombineRule::multiply};
    for (std::size_t i = 0; i < materials.size(); ++i) {
        GltfValue one = materials.at(i);
        Material material;
        material.static_friction = static_cast<float>(one.number("staticFriction", 0.6));
        material.friction = static_cast<float>(one.number("dynamicFriction", 0.6));
        material.restitution = static_cast<float>(one.number("restitution", 0));
        material.friction_rule = of[one.word("frictionCombine", rules, 0)];
        material.restitution_rule = of[one.word("restitutionCombine", rules, 0)];
        one.finish();
        all.push_back(material);
    }
    return all;
}

std::vector<std::vector<bool>> gltf_filters(const GltfValue& filters) {
    struct Systems {
        std::set<std::string> in, with, without;
        bool says_with = false;
    };
    std::vector<Systems> all(1);
    if (filters.size() > 30) filters.refuse("has more than 30 filters, which is what scree has");
    for (std::size_t i = 0; i < filters.size(); ++i) {
        GltfValue one = filters.at(i);
        Systems& systems = all.emplace_back();
        const auto names = [&](const char* key, std::set<std::string>& into) {
            const GltfValue list = one.at(key);
            for (std::size_t k = 0; k < list.size(); ++k) {
                if (!list.at(k).json().is_string()) list.refuse("must be an array of strings");
                into.insert(list.at(k).json().get<std::string>());
            }
            return static_cast<bool>(list);
        };
        names("collisionSystems", systems.in);
        systems.says_with = names("collideWithSystems", systems.with);
        names("notCollideWithSystems", systems.without);
        one.finish();
    }
    const auto allows = [](const Systems& a, const Systems& b) {
        const auto shares = [&](const std::set<std::string>& with) {
            return std::any_of(b.in.begin(), b.in.end(), [&](const std::string& name) { return with.contains(name); });
        };
        return a.says_with ? shares(a.with) : !shares(a.without);
    };
    std::vector<std::vector<bool>> collides(all.size(), std::vector<bool>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < all.size(); ++j) collides[i][j] = allows(all[i], all[j]) && allows(all[j], all[i]);
    return collides;
}

}  // namespace scree::imports
