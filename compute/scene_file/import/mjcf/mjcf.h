// MJCF, the XML of MuJoCo, as a model.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "compute/scene_file/import/element.h"
#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/import/model.h"
#include "compute/scene_file/scene_json.h"

namespace scree::imports {

// The scene of a document whose root is <mujoco>.
SceneDocument scene_of_mjcf(host::XmlElement root, Folder& folder, const ImportOptions& options, Notes& notes,
                            std::size_t most_bodies);

class Mjcf {
public:
    Mjcf(Folder& folder, const ImportOptions& options, Notes& notes, std::size_t most_bodies)
        : folder_(folder), options_(options), notes_(notes), most_bodies_(most_bodies) {}
    SceneDocument read(host::XmlElement root);

private:
    using OfTags = std::map<std::string, Defaults>;
    struct Compiler {
        bool degrees = true, autolimits = true, balance = false, strip = false, discard_visual = false, fuse_static = false;
        int from_geoms = 2;  // no, yes, auto
        std::string euler = "xyz", meshes, assets;
        double least_mass = 0, least_inertia = 0, total_mass = -1;
        long first_group = 0, last_group = 5;
    };
    struct MeshAsset {
        const host::XmlElement* element;
        std::string childclass;
    };
    struct JointPlace {
        std::size_t body, joint;  // joint: npos of a free one
    };
    struct Where {  // of elements in the tree of bodies
        std::size_t body = world_body;
        Placed frame;  // of enclosing <frame>s in the body
        std::string childclass, suffix;
    };
    struct GeomClass {
        std::uint32_t type, affinity;
        std::string alone;  // name of a geom with explicit pairs
        bool operator==(const GeomClass& o) const { return type == o.type && affinity == o.affinity && alone == o.alone; }
    };

    // mjcf.cpp: the document
    void include(host::XmlElement& element, int depth);
    void read_compiler(const host::XmlElement& tree);
    void read_option(const host::XmlElement& tree);
    void read_flags(const host::XmlElement& tree);
    void read_defaults(const host::XmlElement& tree, const std::string& parent, int depth);
    void read_assets(const host::XmlElement& tree);
    void read_terrain(const host::XmlElement& tree);
    void read_material(const host::XmlElement& tree);
    void note_section(const host::XmlElement& tree);
    Element element(const host::XmlElement& tree, const Where& where) { return element(tree, where, tree.name); }
    Element element(const host::XmlElement& tree, const Where& where, const std::string& tag);  // of these defaults
    const OfTags& defaults_of(const Element& element, const std::string& name);
    // mjcf_bodies.cpp: the tree of bodies
    void read_children(const host::XmlElement& tree, const Where& where);
    void read_body(const host::XmlElement& tree, const Where& where);
    void read_frame(const host::XmlElement& tree, const Where& where);
    void read_replicas(const host::XmlElement& tree, const Where& where);
    void read_inertial(const host::XmlElement& tree, std::size_t body);
    void read_joint(const host::XmlElement& tree, const Where& where);
    void finish_mass(std::size_t body);
    void scale_masses();
    dquat turn(Element& element);
    bool limited(Element& element, const char* key, const char* range);
    double angle(double given) const { return compiler_.degrees ? given * 0.017453292519943295 : given; }
    // mjcf_geoms.cpp
    void read_geom(const host::XmlElement& tree, const Where& where);
    void give_size(Element& element, std::size_t type, Geometry& geometry);
    MeshMap map_of(Element& asset);
    std::shared_ptr<const MeshSolid> mesh_of(Element& geom, bool parts);
    std::shared_ptr<const Shape> terrain_of(Element& geom, Placed& placed);
    void give_surface(Element& element, Geometry& geometry);
    std::size_t class_of(Element& element, bool& solid);
    void relate_classes(const host::XmlElement& root);
    void note_pairs(const host::XmlElement& tree);
    // mjcf_relations.cpp
    void read_contact(const host::XmlElement& tree);
    void read_equality(const host::XmlElement& tree);
    std::size_t body_named(Element& element, const char* attribute, bool optional = false);
    void read_keyframes(const host::XmlElement& tree);
    void take_keyframe();
    // mjcf_tendons.cpp
    ModelCoupling::Term joint_term(Element& element, const char* attribute, double factor);
    void read_tendons(const host::XmlElement& tree);
    void read_tendon(const host::XmlElement& tree);
    std::size_t tendon_named(Element& element, const char* attribute);
    void read_coupling(const host::XmlElement& tree);
    void finish_tendons();
    // mjcf_actuators.cpp
    void read_actuators(const host::XmlElement& tree);
    void read_actuator(const host::XmlElement& tree);
    double reflected_inertia(const JointPlace& place) const;
    double reflected_inertia(const ModelCoupling& tendon) const;
    ModelJoint& driven_joint(Element& actuator, const std::string& name);

    Folder& folder_;
    const ImportOptions& options_;
    Notes& notes_;
    std::size_t most_bodies_;
    Model model_;
    Settings settings_{};
    Compiler compiler_;
    std::map<std::string, OfTags> defaults_{{"main", {}}};
    std::map<std::string, MeshAsset> meshes_;
    std::map<std::string, std::optional<vec3>> materials_;  // their colours, sRGB
    std::map<std::string, const host::XmlElement*> terrains_;
    std::set<std::string> included_;
    std::size_t elements_ = 0, inherited_ = 0, geoms_ = 0;
    bool timestep_ = false;
    std::map<std::string, std::size_t> bodies_named_;
    std::map<std::string, JointPlace> joints_named_;
    std::vector<ModelCoupling> tendons_;
    std::map<std::string, std::size_t> tendons_named_;
    std::vector<bool> has_inertial_;
    std::vector<GeomClass> classes_{{1, 1, ""}};
    std::set<std::string> paired_;
    std::vector<std::pair<std::string, std::string>> pairs_;
    std::vector<const host::XmlElement*> keyframes_;
    std::vector<double> controls_;  // of the chosen keyframe
    std::size_t actuators_ = 0;
    bool contacts_ = true, gravity_ = true, limits_ = true, frictions_ = true, springs_ = true, dampers_ = true,
         equalities_ = true, actuation_ = true;
};

// Orientations: quaternions w x y z; of a rotation from x, y and z axes.
dquat turn_between(const dvec3& from, const dvec3& to);  // unit vectors

}  // namespace scree::imports
