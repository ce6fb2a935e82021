// Parts of the translation of a USD scene.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "compute/scene_file/import/gltf_nodes.h"
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
    glm::dmat4 world, above;  // m; above: of its parent
};

// What one walk over the prims finds.
struct UsdFound {
    std::vector<UsdCollider> colliders;
    std::vector<UsdRigid> bodies;  // of the model's bodies but for the first
    std::vector<const UsdPrim*> joints, groups, scenes;
    std::vector<const UsdPrim*> pairs;                     // prims with PhysicsFilteredPairsAPI
    std::unordered_map<std::string, std::size_t> body_at;  // of the model, by path
};
// Walks all prims that are there. Adds bodies, without shapes and masses, to the model.
UsdFound found_in(const UsdStage& stage, const UsdUnits& units, Model& model, Notes& notes, std::size_t most_bodies);

// A walk for others: the prims with a rigid body, each with its own transform and that of what lies above it, m.
struct UsdPlace {
    const UsdPrim& prim;
    const std::string& path;
    const glm::dmat4 &world, &above;
};
using UsdVisit = std::function<void(const UsdPlace&)>;
void visit_usd(const UsdStage& stage, const UsdUnits& units, Notes& notes, std::size_t most, const UsdVisit& visit);

// Shapes and masses.
void add_usd_shapes(const UsdStage& stage, const UsdUnits& units, UsdFound& found, Model& model, Notes& notes);
void finish_usd_masses(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, const std::vector<SolidMass>& shapes,
                       Model& model, Notes& notes);
Material usd_material(const UsdStage& stage, const std::string& path, Notes& notes);

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
