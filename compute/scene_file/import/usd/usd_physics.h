// Parts of the translation of a USD scene.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "compute/scene_file/import/gltf/gltf_nodes.h"
#include "compute/scene_file/import/import_scene.h"
#include "compute/scene_file/import/model.h"
#include "compute/scene_file/import/usd/usd_stage.h"

namespace scree::imports {

struct UsdUnits {
    double meters = 0.01, kilograms = 1;  // of a unit
    bool z_up = false;
};
UsdUnits units_of(const UsdStage& stage);
// The stage's axes and units in metres, as they are turned with `axes`.
Placed root_of(const UsdUnits& units, const ImportOptions& options);

struct UsdCollider {
    const UsdPrim* prim;
    std::string path;  // of an instance of a point instancer INSTANCER[3]/...
    glm::dmat4 world;  // m
    std::size_t body;  // of the model
    std::string material;
    double density = 0;                // of what lies above it, kg/m^3; 0: none given; below 0: it is only drawn
    std::size_t group = 0;             // class of Model::collides
    std::size_t first = 0, count = 0;  // of the model's geometries of its body
};

struct UsdRigid {
    const UsdPrim* prim;
    std::string path;
    glm::dmat4 world, above;           // m; above: of its parent
    std::size_t carrier = no_carrier;  // of the bodies, that above which it lies
    bool resets = false;               // its transform leaves out what lies above
    // Of the root of a prototype of a point instancer: that, which instance it is, the instancer's transform, and its own within.
    const UsdPrim* instancer = nullptr;
    std::size_t instance = 0;
    glm::dmat4 of_instancer{1}, within{1};

    static constexpr std::size_t no_carrier = static_cast<std::size_t>(-1);
};

// What one walk over the prims finds.
struct UsdFound {
    std::vector<UsdCollider> colliders;
    std::vector<UsdRigid> bodies;  // of the model's bodies but for the first
    std::vector<const UsdPrim*> joints, groups, scenes;
    std::vector<const UsdPrim*> pairs;                     // prims with PhysicsFilteredPairsAPI
    std::unordered_map<std::string, std::size_t> body_at;  // of the model, by path
};
// Walks all prims that are there. Adds bodies, without shapes and masses, to the model; without one finds bodies alone.
UsdFound found_in(const UsdStage& stage, const UsdUnits& units, Model* model, Notes& notes, std::size_t most_bodies);

// Shapes and masses.
void add_usd_shapes(const UsdStage& stage, const UsdUnits& units, UsdFound& found, Model& model, Notes& notes);
void finish_usd_masses(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, const std::vector<SolidMass>& shapes,
                       Model& model, Notes& notes);
Material usd_material(const UsdStage& stage, const std::string& path);

// Classes of colliders, and which of them collide.
void add_usd_groups(const UsdStage& stage, UsdFound& found, Model& model, Notes& notes);
// The bodies of the scene that lie at a path or below it.
struct UsdIndex {
    std::vector<std::pair<std::string, std::size_t>> paths;  // sorted
    std::vector<std::size_t> below(const std::string& path) const;
};
UsdIndex index_of(const UsdFound& found, const Model& model);
void add_usd_pairs(const UsdStage& stage, const UsdFound& found, const UsdIndex& index, Scene& scene, Notes& notes);
void add_usd_joints(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, const UsdIndex& index,
                    const Model& model, const Placed& root, Scene& scene, Notes& notes);

}  // namespace scree::imports
