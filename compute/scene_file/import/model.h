// A mechanism as files of robots say it: a tree of bodies with joints to their parents. assemble() makes a scene of it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene.h"
#include "compute/scene_file/import/import_options.h"
#include "compute/scene_file/import/notes.h"
#include "compute/scene_file/import/solid_mass.h"

namespace scree::imports {

constexpr std::size_t world_body = 0;  // of a model

struct Geometry {
    Origin origin;
    std::string name;
    SimpleShape shape = Box{};
    std::shared_ptr<const Compound> parts{};  // instead of it, convex parts of a mesh, which is their skin; null: none
    std::shared_ptr<const Shape> terrain{};   // instead of it, a height field or mesh, of nothing dynamic; null: none
    Placed placed;                            // the shape's own frame in the body
    bool solid = true;                        // else only drawn, or
    bool sensor = false;                      // a sensor
    Material material{};
    std::optional<vec3> color{};  // sRGB
    std::size_t collides_as = 0;  // class of Model::collides
};

// A hinge or slide to the parent, in the body's frame while its coordinate is 0.
struct ModelJoint {
    Origin origin;
    std::string name;
    enum class Kind { hinge, slide, ball } kind = Kind::hinge;
    dvec3 anchor{0}, axis{0, 0, 1};                     // axis of any length but 0
    std::optional<std::pair<double, double>> limits{};  // m or rad; of a ball the second is its greatest angle
    double stiffness = 0, damping = 0, rest = 0;
    double greatest_force = static_cast<double>(unlimited);  // of its springs
    double friction = 0;
    double armature = 0;  // kg or kg m^2
    std::optional<Motor> motor{};
    double effort = static_cast<double>(unlimited);  // of a drive that is yet to come, N or N m
    double reference = 0;                            // what the file calls the coordinate where it is 0 here
    double start = 0;                                // coordinate at the beginning, m or rad
    dquat start_turn{1, 0, 0, 0};                    // of a ball
    double start_speed = 0;                          // m/s or rad/s
};

struct ModelBody {
    Origin origin;
    std::string name;
    std::size_t parent = world_body;
    Placed placed;  // in its parent, all coordinates 0
    std::vector<ModelJoint> joints;
    bool free = false, kinematic = false;
    bool shapeless = false;         // without geometry it is a fixed body all the same
    std::optional<Placed> start{};  // of those, at the beginning, in the parent; none: as placed
    std::vector<Geometry> geometries;
    SolidMass mass;              // in the body's frame
    SolidMass mass_of_shapes;    // at a usual density, for what moves with no mass or no moments of inertia of its own
    dvec3 velocity{0}, spin{0};  // of a free or kinematic body: m/s; rad/s, its own axes
    float gravity_scale = 1;
};

// Two bodies whose frames coincide where they are at coordinates 0: by a point, or wholly.
struct ModelTie {
    Origin origin;
    std::string name;
    std::size_t a = world_body, b = world_body;
    dvec3 anchor{0};  // in a
    bool welded = false;
    std::optional<Placed> b_in_a{};  // of a weld; none: as they are
};

// The sum of factor times coordinate of joints, less the offset, is 0; or moves by limits and springs, those of `sum`.
struct ModelCoupling {
    struct Term {
        std::size_t body = 0, joint = 0;
        double factor = 1;
    };
    Origin origin;
    std::string name;
    std::vector<Term> terms;
    std::vector<double> curve;  // of the last in place of its factor: coefficients of the first power and higher ones
    double offset = 0;
    bool locked = true;
    ModelJoint sum{};
};

struct Model {
    std::vector<ModelBody> bodies{ModelBody{}};  // the first is the world; parents come first
    std::vector<ModelTie> ties;
    std::vector<ModelCoupling> couplings;
    std::vector<std::pair<std::size_t, std::size_t>> exclusions;
    std::vector<std::vector<bool>> collides{{true}};  // of each two classes of geometry; symmetric
    dvec3 gravity{0, 0, -9.81};                       // m/s^2
    bool joined_collide = false;                      // whether a body collides with its parent
    bool joined_to_world_collide = true;              // and with one that nothing moves
    bool z_up = true;
};

// Checks what it makes. Throws ImportError with the place of a body or joint that cannot be.
Scene assemble(const Model& model, const ImportOptions& options, Notes& notes);

// ---- parts of assemble()
struct Assembly {
    const Model& model;
    Notes& notes;
    Placed root;                                   // the file's world in the scene's
    std::vector<Placed> zero;                      // poses of the model's bodies with all coordinates 0, file's world
    std::vector<std::size_t> owner;                // the body that carries each rigidly; world_body: nothing moves it
    std::vector<std::vector<std::size_t>> bodies;  // of each of the model's bodies: indices in the scene
    std::vector<Placed> frames;                    // of an owner: the scene body's frame, until it is checked, in its own
    std::vector<Origin> origins, joint_origins;    // of the scene's bodies and joints
    struct JointPlace {
        std::size_t joint = 0;
        JointAxis axis = JointAxis::twist;
        double sign = 1;  // -1: the scene's axis points the other way
    };
    std::map<std::pair<std::size_t, std::size_t>, JointPlace> places{};  // of a body's joint in the scene
    Scene scene{};
};
void add_joints(Assembly& assembly);  // and ties, and exclusions
// A body between two joints of one body: as heavy as a hundredth of it. Returns its index in the scene.
std::size_t add_link(Assembly& assembly, std::size_t body, const Placed& start);

// Motion of a body's frame, from that of its parent, after the first `joints` of its joints.
struct ModelMotion {
    Placed placed;
    dvec3 spin{0}, sweep{0};  // rad/s; m/s, of the point of the body that is at the origin
    dvec3 velocity_at(const dvec3& point) const { return sweep + glm::cross(spin, point); }
};
ModelMotion moved(const ModelMotion& parent, const ModelBody& body, bool at_start, std::size_t joints);
std::vector<ModelMotion> motions_of(const Model& model, bool at_start);

}  // namespace scree::imports
