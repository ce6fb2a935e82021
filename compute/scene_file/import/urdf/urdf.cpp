// URDF: links and joints.
#include "compute/scene_file/import/urdf/urdf.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "compute/scene/portable_math.h"
#include "compute/scene_file/import/model.h"

namespace scree::imports {

namespace {

constexpr double usual_density = 1000;                        // kg/m^3, as of a scene's bodies
const dquat z_along_y(std::sqrt(0.5), std::sqrt(0.5), 0, 0);  // scree's cylinders lie along y, URDF's along z

class Urdf {
public:
    Urdf(Folder& folder, const ImportOptions& options, Notes& notes, std::size_t most_bodies)
        : folder_(folder), options_(options), notes_(notes), most_bodies_(most_bodies) {}
    SceneDocument read(const host::XmlElement& root);

private:
    struct Child {
        const host::XmlElement* joint;
        std::string link;
    };

    void read_names(const host::XmlElement& root);
    std::string root_link(const host::XmlElement& root) const;
    void add_link(const std::string& name, std::size_t parent, const host::XmlElement* joint);
    void finish_base();
    void read_mimics();
    void read_joint(const host::XmlElement& tree, ModelBody& body);
    void read_axis(const host::XmlElement& tree, ModelJoint& joint);
    void read_link(const host::XmlElement& tree, ModelBody& body);
    void read_shape(const host::XmlElement& tree, bool solid, ModelBody& body);
    bool read_mesh(Element& mesh, const Placed& at, const Geometry& like, ModelBody& body);
    std::optional<vec3> material(const host::XmlElement& tree);
    SolidMass inertial(const host::XmlElement& tree);
    Placed origin(const host::XmlElement& tree);

    Folder& folder_;
    const ImportOptions& options_;
    Notes& notes_;
    std::size_t most_bodies_;
    Model model_;
    std::map<std::string, const host::XmlElement*> links_;
    std::map<std::string, std::vector<Child>> children_;
    std::set<std::string> is_child_;
    std::map<std::string, vec3> colors_;  // sRGB, of materials by name
    struct Mimic {
        const host::XmlElement* element;
        std::string joint;
    };
    std::map<std::string, ModelCoupling::Term> joints_;  // with one axis
    std::vector<Mimic> mimics_;
    int depth_ = 0;
};

const host::XmlElement* child_of(const host::XmlElement& tree, const char* name) {
    for (const host::XmlElement& child : tree.children)
        if (child.name == name) return &child;
    return nullptr;
}

std::string attribute_of(const host::XmlElement& tree, const char* name) {
    for (const host::XmlAttribute& one : tree.attributes)
        if (one.name == name) return one.value;
    return "";
}

std::array<double, 3> xyz_of(Element& element, const char* key, const std::array<double, 3>& otherwise) {
    return element.numbers<3>(key, otherwise);
}

Placed Urdf::origin(const host::XmlElement& tree) {
    const host::XmlElement* found = child_of(tree, "origin");
    if (!found) return {};
    Element element(*found, notes_);
    const auto at = xyz_of(element, "xyz", {0, 0, 0}), turns = xyz_of(element, "rpy", {0, 0, 0});
    element.finish();
    const dquat turn = portable::turn_about(dvec3(0, 0, 1), turns[2]) * portable::turn_about(dvec3(0, 1, 0), turns[1]) *
                       portable::turn_about(dvec3(1, 0, 0), turns[0]);
    return {{at[0], at[1], at[2]}, glm::normalize(turn)};
}

SolidMass Urdf::inertial(const host::XmlElement& tree) {
    const host::XmlElement *mass = child_of(tree, "mass"), *inertia = child_of(tree, "inertia");
    SolidMass own;
    if (mass) {
        Element element(*mass, notes_);
        own.mass = element.number("value", -1);
        if (!(own.mass >= 0)) element.refuse("value", "is missing or below 0 kg");
        element.finish();
    }
    if (inertia) {
        Element element(*inertia, notes_);
        const auto at = [&](const char* key) { return element.number(key, 0); };
        const double xx = at("ixx"), yy = at("iyy"), zz = at("izz"), xy = at("ixy"), xz = at("ixz"), yz = at("iyz");
        own.inertia = {xx, xy, xz, xy, yy, yz, xz, yz, zz};
        element.finish();
    }
    return placed_mass(own, origin(tree));
}

bool Urdf::read_mesh(Element& mesh, const Placed& at, const Geometry& like, ModelBody& body) {
    const std::string file = mesh.text("filename");
    if (file.empty()) mesh.refuse("names no \"filename\"");
    const auto scale = xyz_of(mesh, "scale", {1, 1, 1});
    const std::size_t dot = std::min(file.rfind('.'), file.size());
    std::string ending = file.substr(dot);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!like.solid && ending != ".stl" && ending != ".obj" && ending != ".gltf" && ending != ".glb") {
        mesh.note("filename", "of another kind than .stl, .obj, .gltf and .glb is not drawn");
        return false;
    }
    const auto solid = folder_.mesh(mesh.origin(), file, {diagonal(dvec3(scale[0], scale[1], scale[2]))}, true, like.solid);
    mesh.finish();
    if (solid->hulls.empty()) {
        if (like.solid) mesh.refuse("\"" + file + "\" has no convex hull: " + solid->flaw);
        mesh.note("filename", "has no convex hull and is not drawn: " + solid->flaw);
        return false;
    }
    if (!solid->remark.empty()) mesh.note("filename", solid->remark);
    mesh.note("", like.solid ? "collides as the convex hull of each of its groups"
                             : "is drawn as the convex hull of each of its groups");
    if (like.solid) body.mass_of_shapes = sum_of(body.mass_of_shapes, placed_mass(scaled_mass(solid->mass, usual_density), at));
    if (!like.solid && !like.color && !solid->lost_colors.empty()) mesh.note("filename", "has no colours: " + solid->lost_colors);
    for (std::size_t i = 0; i < solid->hulls.size(); ++i) {
        Geometry one = like;
        one.shape = Hull{solid->hulls[i]};
        one.parts = solid->parts[i];
        one.placed = at;
        if (!like.solid && !one.color) one.color = solid->colors[i];
        body.geometries.push_back(std::move(one));
    }
    return true;
}

// The colour of a material, which has its own or is that of its name elsewhere in the file.
std::optional<vec3> Urdf::material(const host::XmlElement& tree) {
    Element element(tree, notes_);
    const std::string name = element.text("name");
    element.finish();
    std::optional<vec3> color;
    for (const host::XmlElement& child : tree.children) {
        Element inside(child, notes_);
        if (child.name != "color") {
            inside.note("", "is left out; bodies have colours and no textures");
            continue;
        }
        const std::vector<double> rgba = inside.numbers("rgba", 3, 4);
        if (rgba.empty()) inside.refuse("has no \"rgba\"");
        color = glm::clamp(vec3(dvec3(rgba[0], rgba[1], rgba[2])), 0.0f, 1.0f);
        inside.finish();
    }
    if (color && !name.empty()) colors_.try_emplace(name, *color);
    if (const auto known = colors_.find(name); !color && known != colors_.end()) color = known->second;
    if (!color && tree.children.empty()) element.note("", "has no colour, and no material of this name was described before");
    return color;
}

void Urdf::read_shape(const host::XmlElement& tree, bool solid, ModelBody& body) {
    Element whole(tree, notes_);
    Geometry geometry;
    geometry.origin = whole.origin();
    geometry.name = whole.text("name", body.name);
    geometry.solid = solid;
    const Placed at = origin(tree);
    geometry.placed = at;
    whole.finish();
    const host::XmlElement* inside = child_of(tree, "geometry");
    if (!inside || inside->children.empty()) whole.refuse("has no <geometry>");
    if (inside->children.size() > 1) Element(*inside, notes_).refuse("has more than one shape");
    for (const host::XmlElement& child : tree.children) {
        if (child.name == "material")
            geometry.color = material(child);
        else if (child.name != "origin" && child.name != "geometry")
            Element(child, notes_).note("", "is unknown here and left out");
    }
    Element shape(inside->children[0], notes_);
    const auto size = [&](const char* key) {
        const double value = shape.number(key, 0);
        if (!(value > 0)) shape.refuse(key, "must be above 0 m");
        return static_cast<float>(value);
    };
    if (shape.tag() == "mesh") {
        read_mesh(shape, at, geometry, body);
        return;
    }
    if (shape.tag() == "box") {
        const auto full = xyz_of(shape, "size", {0, 0, 0});
        if (!(full[0] > 0 && full[1] > 0 && full[2] > 0)) shape.refuse("size", "must be three numbers above 0 m");
        geometry.shape = Box{vec3(0.5 * dvec3(full[0], full[1], full[2]))};
    } else if (shape.tag() == "sphere") {
        geometry.shape = Sphere{size("radius")};
    } else if (shape.tag() == "cylinder") {
        geometry.shape = Cylinder{size("radius"), 0.5f * size("length")};
        geometry.placed.turn = at.turn * z_along_y;
    } else if (shape.tag() == "capsule") {
        geometry.shape = Capsule{size("radius"), 0.5f * size("length")};
        geometry.placed.turn = at.turn * z_along_y;
    } else {
        shape.refuse("is no shape of URDF; known: box, sphere, cylinder, capsule, mesh");
    }
    shape.finish();
    if (solid)
        body.mass_of_shapes =
            sum_of(body.mass_of_shapes, placed_mass(scaled_mass(primitive_mass(geometry.shape), usual_density), geometry.placed));
    body.geometries.push_back(std::move(geometry));
}

void Urdf::read_link(const host::XmlElement& tree, ModelBody& body) {
    Element link(tree, notes_);
    body.origin = link.origin();
    link.finish();
    for (const host::XmlElement& child : tree.children) {
        if (child.name == "inertial") {
            body.mass = sum_of(body.mass, inertial(child));
        } else if (child.name == "collision" || child.name == "visual") {
            read_shape(child, child.name == "collision", body);
        } else {
            Element(child, notes_).note("", "is left out");
        }
    }
    // What collides has no colour in a URDF; it takes that of what is drawn.
    std::optional<vec3> first;
    for (const Geometry& one : body.geometries)
        if (!first) first = one.color;
    for (Geometry& one : body.geometries)
        if (!one.color) one.color = first;
}

void Urdf::read_axis(const host::XmlElement& tree, ModelJoint& joint) {
    if (const host::XmlElement* found = child_of(tree, "axis")) {
        Element element(*found, notes_);
        const auto xyz = xyz_of(element, "xyz", {1, 0, 0});
        joint.axis = {xyz[0], xyz[1], xyz[2]};
        if (!(glm::length(joint.axis) > 1e-9)) element.refuse("xyz", "is a vector of length 0");
        element.finish();
    } else {
        joint.axis = {1, 0, 0};
    }
    if (const host::XmlElement* found = child_of(tree, "dynamics")) {
        Element element(*found, notes_);
        joint.damping = element.number("damping", 0), joint.friction = element.number("friction", 0);
        if (joint.damping < 0 || joint.friction < 0) element.refuse("damping and friction must not be below 0");
        element.finish();
    }
}

void Urdf::read_joint(const host::XmlElement& tree, ModelBody& body) {
    Element element(tree, notes_);
    const std::size_t type = element.word("type", {"fixed", "revolute", "continuous", "prismatic", "floating", "planar"}, 6);
    if (type == 6) element.refuse("has no \"type\"");
    element.finish();
    static const std::vector<std::string> known = {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"};
    for (const host::XmlElement& child : tree.children) {
        if (std::find(known.begin(), known.end(), child.name) == known.end())
            Element(child, notes_).note("", "is left out; it is for controllers");
    }
    body.placed = origin(tree);
    if (type == 0) return;
    if (type == 4) {  // it joins nothing
        body.free = true;
        return;
    }
    ModelJoint joint;
    joint.origin = element.origin();
    joint.name = element.text("name");
    joint.kind = type == 3 ? ModelJoint::Kind::slide : ModelJoint::Kind::hinge;
    read_axis(tree, joint);
    if (type == 5) {  // along two axes of its plane, and about its normal
        const dvec3 normal = glm::normalize(joint.axis);
        ModelJoint slide = joint;
        slide.kind = ModelJoint::Kind::slide;
        slide.axis = std::abs(normal.x) < 0.9 ? glm::normalize(glm::cross(normal, dvec3(1, 0, 0)))
                                              : glm::normalize(glm::cross(normal, dvec3(0, 1, 0)));
        body.joints.push_back(slide);
        slide.axis = glm::cross(normal, slide.axis);
        body.joints.push_back(slide);
    }
    const host::XmlElement* limit = child_of(tree, "limit");
    if (!limit && (type == 1 || type == 3)) element.refuse("needs a <limit>");
    if (limit) {
        Element bounds(*limit, notes_);
        const double lower = bounds.number("lower", 0), upper = bounds.number("upper", 0), effort = bounds.number("effort", 0);
        if (lower > upper) bounds.refuse("lower", "is above the upper limit");
        if (effort < 0) bounds.refuse("effort", "must not be below 0");
        if (type == 1 || type == 3) joint.limits = {lower, upper};
        bounds.ignore({"velocity"}, "is left out: no motor is faster than it is told to be");
        bounds.finish();
        if (effort > 0 && type != 5) joint.effort = effort;
        if (effort > 0 && type == 5) bounds.note("effort", "of a planar joint is left out; give drives a max_force");
    }
    const host::XmlElement* mimic = child_of(tree, "mimic");
    if (type != 5)
        joints_[joint.name] = {model_.bodies.size(), 0};
    else if (mimic)
        Element(*mimic, notes_).note("", "of a planar joint is left out: it moves by itself");
    if (mimic && type != 5) mimics_.push_back({mimic, joint.name});
    body.joints.push_back(std::move(joint));
}

// A joint's coordinate is multiplier times another's, plus the offset.
void Urdf::read_mimics() {
    for (const Mimic& mimic : mimics_) {
        Element element(*mimic.element, notes_);
        const std::string name = element.text("joint");
        if (name.empty()) element.refuse("names no \"joint\"");
        const double multiplier = element.number("multiplier", 1);
        ModelCoupling coupling;
        coupling.origin = element.origin();
        coupling.name = mimic.joint + " mimics " + name;
        coupling.offset = element.number("offset", 0);
        element.finish();
        if (name == mimic.joint) element.refuse("joint", "is the joint itself");
        const auto found = joints_.find(name);
        if (found == joints_.end()) element.refuse("joint", "there is no joint \"" + name + "\" with one axis");
        const ModelCoupling::Term& own = joints_.at(mimic.joint);
        coupling.terms.push_back({own.body, own.joint, 1});
        if (multiplier != 0) coupling.terms.push_back({found->second.body, found->second.joint, -multiplier});
        model_.couplings.push_back(std::move(coupling));
    }
}

void Urdf::add_link(const std::string& name, std::size_t parent, const host::XmlElement* joint) {
    const host::XmlElement& tree = *links_.at(name);
    const Origin at{*tree.file, tree.line, "link \"" + name + "\""};
    if (model_.bodies.size() >= most_bodies_) refuse(at, "there are more links than fit into memory");
    if (++depth_ > 1000) refuse(at, "more than 1000 links hang on each other");
    const std::size_t index = model_.bodies.size();
    ModelBody body;
    body.name = name;
    body.parent = parent;
    read_link(tree, body);
    if (joint) read_joint(*joint, body);
    model_.bodies.push_back(std::move(body));
    for (const Child& child : children_[name]) add_link(child.link, index, child.joint);
    --depth_;
}

// The root with all that fixed joints join to it stands still, or is free where the options say so and it has a mass.
void Urdf::finish_base() {
    ModelBody& base = model_.bodies[1];
    double mass = 0;
    bool shown = false, carries = false;  // whether it has geometry, and whether other links hang on it
    std::vector<bool> joined(model_.bodies.size());
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
        const ModelBody& body = model_.bodies[b];
        joined[b] = (b == 1 || joined[body.parent]) && body.joints.empty() && !body.free;
        carries = carries || (!body.joints.empty() && joined[body.parent]);
        if (!joined[b]) continue;
        mass += body.mass.mass + body.mass_of_shapes.mass;
        shown = shown || !body.geometries.empty();
    }
    const bool of_world = base.name == "world", wanted = options_.base == ImportedBase::free;
    if (wanted && of_world) notes_.add(base.origin, "", "is the world by its name: it stays fixed, with what is fixed to it");
    if (wanted && !of_world && !(mass > 0) && (shown || carries))
        refuse(base.origin, "is to be free (--base free, base=\"free\"), but it and what is fixed to it have no mass");
    base.free = wanted && !of_world && mass > 0;
    if (base.free) return;
    if (options_.base == ImportedBase::usual && !of_world && mass > 0)
        notes_.add(
            base.origin, "",
            "is the root and fixed to the world; --base free lets it move, --base fixed says the same (in Python base=\"free\", "
            "\"fixed\")");
    base.shapeless = mass > 0 && !shown;
}

void Urdf::read_names(const host::XmlElement& root) {
    for (const host::XmlElement& child : root.children) {
        Element element(child, notes_);
        if (child.name == "link") {
            const std::string name = element.text("name");
            if (name.empty()) element.refuse("has no name");
            if (!links_.try_emplace(name, &child).second) element.refuse("there are two links of this name");
        } else if (child.name == "material") {
            (void)material(child);
        } else if (child.name.starts_with("xacro:")) {
            element.refuse("is xacro; write the file with the program xacro first");
        } else if (child.name != "joint") {
            element.note("", "is left out; it is for controllers and other simulators");
        }
    }
    for (const host::XmlElement& child : root.children) {
        if (child.name != "joint") continue;
        Element element(child, notes_);
        if (child.children.empty()) element.refuse("has no <parent> and <child>");
        std::string ends[2];
        for (int k = 0; k < 2; ++k) {
            const host::XmlElement* end = child_of(child, k == 0 ? "parent" : "child");
            if (!end) element.refuse(k == 0 ? "has no <parent>" : "has no <child>");
            ends[k] = attribute_of(*end, "link");
            if (!links_.contains(ends[k])) Element(*end, notes_).refuse("there is no link \"" + ends[k] + "\"");
        }
        if (!is_child_.insert(ends[1]).second) element.refuse("the link \"" + ends[1] + "\" has two parents");
        children_[ends[0]].push_back({&child, ends[1]});
    }
}

std::string Urdf::root_link(const host::XmlElement& root) const {
    std::string found;
    for (const host::XmlElement& child : root.children) {
        const std::string name = attribute_of(child, "name");
        if (child.name != "link" || is_child_.contains(name)) continue;
        if (!found.empty())
            refuse({*child.file, child.line, "link \"" + name + "\""}, "hangs on no joint, and nor does \"" + found + "\"");
        found = name;
    }
    if (found.empty())
        refuse({*root.file, root.line, root.name}, links_.empty() ? "has no link" : "its links hang on each other in a circle");
    return found;
}

SceneDocument Urdf::read(const host::XmlElement& root) {
    Element element(root, notes_);
    element.pass({"version"});
    for (const host::XmlAttribute& one : root.attributes)
        if (one.name.starts_with("xmlns")) element.pass({one.name.c_str()});
    element.finish();
    read_names(root);
    const std::string first = root_link(root);
    model_.joined_to_world_collide = false;
    add_link(first, world_body, nullptr);
    if (model_.bodies.size() != links_.size() + 1)
        element.refuse(std::to_string(links_.size() + 1 - model_.bodies.size()) + " links hang on each other in a circle");
    finish_base();
    read_mimics();
    SceneDocument document;
    document.scene = assemble(model_, options_, notes_);
    return document;
}

}  // namespace

SceneDocument scene_of_urdf(const host::XmlElement& root, Folder& folder, const ImportOptions& options, Notes& notes,
                            std::size_t most_bodies) {
    return Urdf(folder, options, notes, most_bodies).read(root);
}

}  // namespace scree::imports
