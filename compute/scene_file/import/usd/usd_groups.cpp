// Collision groups and filtered pairs of UsdPhysics.
#include <algorithm>
#include <set>
#include <unordered_map>

#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

constexpr std::size_t most_classes = 31;  // of colliders with equal groups; a filter has 32 bits

struct Group {
    std::string name;  // of those that are merged with it, or its path
    std::vector<std::string> includes, excludes, filtered;
    bool inverted = false;
};

// Groups by the paths that they include or exclude.
using ByPath = std::unordered_map<std::string, std::vector<std::size_t>>;

// Of a path and all above it.
std::set<std::size_t> groups_at(const ByPath& known, const std::string& path) {
    std::set<std::size_t> groups;
    for (std::size_t end = path.size(); end > 0 && end != path.npos; end = path.find_last_of("/[", end - 1)) {
        const auto found = known.find(path.substr(0, end));
        if (found != known.end()) groups.insert(found->second.begin(), found->second.end());
    }
    return groups;
}

std::vector<Group> groups_of(const UsdStage& stage, const UsdFound& found) {
    std::vector<Group> groups;
    std::map<std::string, std::string> names;  // by path
    for (const UsdPrim* prim : found.groups) {
        const std::string merged = stage.text(*prim, "physics:mergeGroup", "");
        Group& group = groups.emplace_back();
        group.name = names[prim->path] = merged.empty() ? prim->path : "merged " + merged;
        group.includes = stage.targets(*prim, "collection:colliders:includes");
        group.excludes = stage.targets(*prim, "collection:colliders:excludes");
        group.filtered = stage.targets(*prim, "physics:filteredGroups");
        group.inverted = stage.flag(*prim, "physics:invertFilteredGroups", false);
    }
    for (Group& group : groups)
        for (std::string& other : group.filtered)
            if (const auto known = names.find(other); known != names.end()) other = known->second;
    return groups;
}

// Whether colliders of the groups a and b do not meet.
bool filters(const std::vector<Group>& groups, const std::set<std::string>& a, const std::set<std::string>& b) {
    for (const Group& group : groups) {
        if (!a.contains(group.name)) continue;
        for (const std::string& other : b)
            if ((std::find(group.filtered.begin(), group.filtered.end(), other) != group.filtered.end()) != group.inverted)
                return true;
    }
    return false;
}

}  // namespace

void add_usd_groups(const UsdStage& stage, UsdFound& found, Model& model, Notes& notes) {
    if (found.groups.empty()) return;
    constexpr std::size_t most_groups = 1000;
    if (found.groups.size() > most_groups) refuse(stage.at(*found.groups[0]), "is one of more than 1000 collision groups");
    const std::vector<Group> groups = groups_of(stage, found);
    std::vector<std::set<std::string>> classes{{}};
    ByPath includes, excludes;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        for (const std::string& path : groups[i].includes) includes[path].push_back(i);
        for (const std::string& path : groups[i].excludes) excludes[path].push_back(i);
    }
    for (UsdCollider& collider : found.colliders) {
        std::set<std::string> in;
        const std::set<std::size_t> without = groups_at(excludes, collider.path);
        for (const std::size_t group : groups_at(includes, collider.path))
            if (!without.contains(group)) in.insert(groups[group].name);
        collider.group = static_cast<std::size_t>(std::find(classes.begin(), classes.end(), in) - classes.begin());
        if (collider.group == classes.size()) classes.push_back(in);
        if (classes.size() > most_classes)
            refuse(stage.at(*collider.prim), "colliders are in more than 30 combinations of groups, which is what scree has");
    }
    model.collides.assign(classes.size(), std::vector<bool>(classes.size(), true));
    for (std::size_t i = 0; i < classes.size(); ++i)
        for (std::size_t j = 0; j < classes.size(); ++j)
            if (filters(groups, classes[i], classes[j]) || filters(groups, classes[j], classes[i])) model.collides[i][j] = false;
    for (const UsdPrim* prim : found.groups)
        if (stage.targets(*prim, "collection:colliders:includes").empty())
            notes.add(stage.at(*prim), "PhysicsCollisionGroup", "has no colliders");
}

std::vector<std::size_t> UsdIndex::below(const std::string& path) const {
    std::vector<std::size_t> bodies;
    // What lies below comes before path + '0', the letter after '/'; instances "[0]" come later.
    for (const char* next : {"", "/", "["}) {
        const std::string from = path + next;
        for (auto one = std::lower_bound(paths.begin(), paths.end(), std::pair{from, std::size_t{0}});
             one != paths.end() && (*next ? one->first.starts_with(from) : one->first == from); ++one)
            bodies.push_back(one->second);
    }
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    return bodies;
}

// Shapes that nothing moves are the first bodies, one each; then come those that move.
UsdIndex index_of(const UsdFound& found, const Model& model) {
    UsdIndex index;
    const std::size_t fixed = model.bodies[world_body].geometries.size();
    for (std::size_t i = 0; i < found.bodies.size(); ++i) index.paths.emplace_back(found.bodies[i].path, fixed + i);
    for (const UsdCollider& one : found.colliders) {
        if (one.body != world_body) {
            index.paths.emplace_back(one.path, fixed + one.body - 1);
            continue;
        }
        for (std::size_t k = 0; k < one.count; ++k) index.paths.emplace_back(one.path, one.first + k);
    }
    std::sort(index.paths.begin(), index.paths.end());
    return index;
}

void add_usd_pairs(const UsdStage& stage, const UsdFound& found, const UsdIndex& index, Scene& scene, Notes& notes) {
    constexpr std::size_t most_pairs = 10'000'000;
    std::size_t pairs = 0;
    std::set<std::pair<std::size_t, std::size_t>> all;
    for (const UsdPrim* prim : found.pairs) {
        const std::vector<std::size_t> own = index.below(prim->path);
        for (const std::string& target : stage.targets(*prim, "physics:filteredPairs")) {
            const std::vector<std::size_t> others = index.below(target);
            if (others.empty()) notes.add(stage.at(*prim), "filteredPairs", "names a prim without bodies and colliders");
            for (const std::size_t a : own)
                for (const std::size_t b : others) {
                    if (++pairs > most_pairs) refuse(stage.at(*prim), "with it more than 10000000 pairs are filtered");
                    const bool moves = scene.bodies[a].motion != Motion::fixed || scene.bodies[b].motion != Motion::fixed;
                    if (a != b && moves) all.insert(std::minmax(a, b));
                }
        }
    }
    for (const auto& [a, b] : all) scene.exclusions.push_back({a, b});
}

}  // namespace scree::imports
