// MJCF: the document, its includes, defaults, compiler and options.
#include "compute/scene_file/import/mjcf/mjcf.h"

#include <algorithm>
#include <cmath>

#include "compute/schema/settings.h"

namespace scree::imports {

namespace {

constexpr std::size_t most_elements = 2'000'000;
constexpr const char* own_solver = "is of MuJoCo's solver; scree has its own";

// Defaults of actuators hold for all kinds of them.
const std::vector<std::string> actuator_tags = {"general", "motor",    "position", "velocity", "intvelocity",
                                                "damper",  "cylinder", "muscle",   "adhesion", "plugin"};

}  // namespace

Element Mjcf::element(const host::XmlElement& tree, const Where& where, const std::string& tag) {
    const std::string* chosen = nullptr;
    for (const host::XmlAttribute& one : tree.attributes)
        if (one.name == "class") chosen = &one.value;
    Element bare(tree, notes_);
    const OfTags& tags = defaults_of(bare, chosen ? *chosen : where.childclass.empty() ? "main" : where.childclass);
    const auto found = tags.find(tag);
    Element result(tree, notes_, found == tags.end() ? nullptr : &found->second);
    result.pass({"class"});
    return result;
}

const Mjcf::OfTags& Mjcf::defaults_of(const Element& at, const std::string& name) {
    const auto found = defaults_.find(name);
    if (found == defaults_.end()) at.refuse("there is no default class \"" + name + "\"");
    return found->second;
}

void Mjcf::include(host::XmlElement& tree, int depth) {
    if (depth > 100) refuse({*tree.file, tree.line, tree.name}, "is nested deeper than 100 elements and files");
    if (++elements_ > most_elements) refuse({*tree.file, tree.line, ""}, "the model has more than 2000000 elements");
    std::vector<host::XmlElement> children;
    for (host::XmlElement& child : tree.children) {
        if (child.name != "include") {
            include(child, depth + 1);
            children.push_back(std::move(child));
            continue;
        }
        Element element(child, notes_);
        const std::string name = element.text("file");
        if (name.empty()) element.refuse("names no \"file\"");
        element.finish();
        const std::string path = folder_.path_of(element.origin(), name);
        if (!included_.insert(path).second) element.refuse("\"" + name + "\" is included before; a file can be once");
        host::XmlElement root;
        try {
            root = host::xml_of(folder_.bytes(element.origin(), name), path);
        } catch (const host::FileError& error) {
            throw ImportError(error.what());
        }
        include(root, depth + 1);
        for (host::XmlElement& inner : root.children) children.push_back(std::move(inner));
    }
    tree.children = std::move(children);
}

void Mjcf::read_compiler(const host::XmlElement& tree) {
    Element element(tree, notes_);
    Compiler& c = compiler_;
    c.degrees = element.word("angle", {"radian", "degree"}, c.degrees) == 1;
    if (element.word("coordinate", {"local", "global"}, 0) == 1)
        element.refuse("coordinate", "\"global\" is no longer part of MJCF; save the model with a newer MuJoCo");
    c.autolimits = element.flag("autolimits", c.autolimits);
    c.from_geoms =
        static_cast<int>(element.word("inertiafromgeom", {"false", "true", "auto"}, static_cast<std::size_t>(c.from_geoms)));
    c.balance = element.flag("balanceinertia", c.balance);
    c.strip = element.flag("strippath", c.strip);
    c.discard_visual = element.flag("discardvisual", c.discard_visual);
    c.fuse_static = element.flag("fusestatic", c.fuse_static);  // bodies without joints are always one with their parents
    c.euler = element.text("eulerseq", c.euler);
    if (c.euler.size() != 3 || c.euler.find_first_not_of("xyzXYZ") != c.euler.npos)
        element.refuse("eulerseq", "must be three of x, y, z, X, Y, Z");
    c.meshes = element.text("meshdir", c.meshes);
    c.assets = element.text("assetdir", c.assets);
    c.least_mass = element.number("boundmass", c.least_mass);
    c.least_inertia = element.number("boundinertia", c.least_inertia);
    c.total_mass = element.number("settotalmass", c.total_mass);
    if (const auto range = element.numbers("inertiagrouprange", 2, 2); !range.empty())
        c.first_group = std::lround(range[0]), c.last_group = std::lround(range[1]);
    element.pass({"usethread", "texturedir"});
    element.ignore({"fitaabb", "exactmeshinertia", "alignfree", "saveinertial", "inertiatol"}, "is left out");
    for (const host::XmlElement& child : tree.children) Element(child, notes_).note("", "is left out");
    element.finish();
}

void Mjcf::read_flags(const host::XmlElement& tree) {
    Element element(tree, notes_);
    const auto is_on = [&](const char* key, bool otherwise) { return element.word(key, {"disable", "enable"}, otherwise) == 1; };
    contacts_ = is_on("contact", contacts_);
    gravity_ = is_on("gravity", gravity_);
    limits_ = is_on("limit", limits_);
    frictions_ = is_on("frictionloss", frictions_);
    springs_ = is_on("spring", is_on("passive", springs_));
    dampers_ = is_on("damper", is_on("passive", dampers_));
    equalities_ = is_on("equality", equalities_);
    actuation_ = is_on("actuation", actuation_);
    model_.joined_collide = !is_on("filterparent", !model_.joined_collide);
    if (!is_on("constraint", true)) contacts_ = limits_ = frictions_ = equalities_ = false;
    element.ignore({"clampctrl", "warmstart", "refsafe", "sensor", "midphase", "nativeccd", "eulerdamp", "autoreset", "override",
                    "energy", "fwdinv", "invdiscrete", "multiccd", "island", "sleep", "sensornoise"},
                   own_solver);
    element.finish();
}

void Mjcf::read_option(const host::XmlElement& tree) {
    Element element(tree, notes_);
    if (const double step = element.number("timestep", 0); element.has("timestep")) {
        if (!(step > 0)) element.refuse("timestep", "must be above 0 s");
        timestep_ = true;
        settings_.rate = static_cast<float>(std::clamp(1 / step, 10.0, 1000.0));
        if (1 / step > 1000.5 || 1 / step < 9.99)
            element.note("timestep",
                         "is out of range; there are " + std::to_string(std::lround(settings_.rate)) + " steps a second");
        // At least as many substeps a second as a scene has by default; joints are solved in each.
        settings_.substeps = std::clamp(static_cast<int>(std::ceil(480 / settings_.rate)), 2, 48);
    }
    const auto g = element.numbers<3>("gravity", {model_.gravity.x, model_.gravity.y, model_.gravity.z});
    model_.gravity = {g[0], g[1], g[2]};
    const auto wind = element.numbers<3>("wind", {0, 0, 0});
    if (element.number("density", 0) != 0 || element.number("viscosity", 0) != 0)
        element.refuse("has a fluid all around, which scree has not; leave out density and viscosity");
    (void)wind;  // without a fluid it means nothing
    element.ignore({"magnetic"}, "is for sensors, which scree has not");
    element.ignore(
        {"impratio",       "tolerance",      "ls_tolerance",   "noslip_tolerance", "mpr_tolerance",     "ccd_tolerance",
         "o_margin",       "o_solref",       "o_solimp",       "o_friction",       "integrator",        "cone",
         "jacobian",       "solver",         "iterations",     "ls_iterations",    "noslip_iterations", "mpr_iterations",
         "ccd_iterations", "sdf_iterations", "sdf_initpoints", "collision",        "apirate",           "actuatorgroupdisable",
         "sleep_tolerance"},
        own_solver);
    for (const host::XmlElement& child : tree.children) {
        if (child.name == "flag")
            read_flags(child);
        else
            Element(child, notes_).note("", "is unknown here and left out");
    }
    element.finish();
}

void Mjcf::read_defaults(const host::XmlElement& tree, const std::string& parent, int depth) {
    Element element(tree, notes_);
    const std::string name = element.text("class", depth == 0 ? "main" : "");
    if (name.empty()) element.refuse("has no \"class\"");
    if (depth > 0) {
        if (defaults_.contains(name)) element.refuse("class", "\"" + name + "\" is defined twice");
        defaults_[name] = defaults_[parent];
        for (const auto& [tag, attributes] : defaults_[name]) inherited_ += attributes.size();
        if (inherited_ > most_elements) element.refuse("the default classes inherit more than 2000000 attributes");
    } else if (name != "main") {
        defaults_.try_emplace(name, defaults_["main"]);
    }
    element.finish();
    const bool outermost = depth == 0 && name != "main";
    OfTags& tags = defaults_[name];
    for (const host::XmlElement& child : tree.children) {
        if (child.name == "default") continue;
        const bool actuates = std::find(actuator_tags.begin(), actuator_tags.end(), child.name) != actuator_tags.end();
        for (const host::XmlAttribute& one : child.attributes) {
            tags[child.name].insert_or_assign(one.name, one);
            if (outermost) defaults_["main"][child.name].insert_or_assign(one.name, one);
            const bool common = one.name == "ctrlrange" || one.name == "forcerange" || one.name == "gear" ||
                                one.name == "ctrllimited" || one.name == "forcelimited";
            if (actuates && common)
                for (const std::string& other : actuator_tags) tags[other].insert_or_assign(one.name, one);
        }
    }
    for (const host::XmlElement& child : tree.children)
        if (child.name == "default") read_defaults(child, name, depth + 1);
}

void Mjcf::read_assets(const host::XmlElement& tree) {
    for (const host::XmlElement& child : tree.children) {
        if (child.name != "mesh") {
            if (child.name == "hfield") {
                read_terrain(child);
                continue;
            }
            if (child.name == "material") {
                read_material(child);
                continue;
            }
            Element(child, notes_).note("", "is not drawn");
            if (child.name == "model") Element(child, notes_).refuse("models in models are not read; include the file");
            continue;
        }
        Element element = this->element(child, {});
        std::string name = element.text("name");
        if (name.empty()) name = std::filesystem::path(element.text("file")).stem().string();
        if (name.empty()) element.refuse("has neither name nor file");
        if (!meshes_.try_emplace(name, MeshAsset{&child, ""}).second) element.refuse("there are two of this name");
    }
}

void Mjcf::read_material(const host::XmlElement& tree) {
    Element element = this->element(tree, {});
    const std::string name = element.text("name");
    if (name.empty()) element.refuse("has no name");
    std::optional<vec3> color;
    if (const std::vector<double> rgba = element.numbers("rgba", 3, 4); !rgba.empty())
        color = glm::clamp(vec3(dvec3(rgba[0], rgba[1], rgba[2])), 0.0f, 1.0f);
    element.ignore({"texture"}, "is left out; bodies have colours and no textures");
    element.pass({"texrepeat", "texuniform", "emission", "specular", "shininess", "reflectance", "metallic", "roughness"});
    element.finish();
    if (!materials_.try_emplace(name, color).second) element.refuse("there are two of this name");
}

void Mjcf::note_section(const host::XmlElement& tree) {
    Element element(tree, notes_);
    if (tree.name == "deformable")
        for (const host::XmlElement& child : tree.children)
            Element(child, notes_).refuse("scree has none; remove it and what refers to it");
    if (tree.name == "extension")
        for (const host::XmlElement& child : tree.children) Element(child, notes_).refuse("plugins are not read");
    static const std::vector<std::string> known = {"statistic", "visual", "size", "sensor", "custom"};
    for (const host::XmlElement& child : tree.children) {
        if (tree.name == "sensor")
            Element(child, notes_).note("", "scree has none of MuJoCo's sensors; World's queries tell as much");
    }
    if (tree.name == "sensor" || tree.name == "deformable" || tree.name == "extension") return;
    if (std::find(known.begin(), known.end(), tree.name) != known.end())
        element.note("", "is left out; no motion depends on it");
    else
        element.note("", "is unknown here and left out");
}

SceneDocument Mjcf::read(host::XmlElement root) {
    include(root, 0);
    static const std::vector<std::string> read_here = {"compiler", "option",   "default",  "asset",    "worldbody",
                                                       "contact",  "equality", "actuator", "keyframe", "tendon"};
    // In the order in which they depend on each other, wherever they stand.
    const auto each = [&](const char* name, const auto& take) {
        for (const host::XmlElement& child : root.children)
            if (child.name == name) take(child);
    };
    for (const host::XmlElement& child : root.children)
        if (std::find(read_here.begin(), read_here.end(), child.name) == read_here.end()) note_section(child);
    each("compiler", [&](const auto& tree) { read_compiler(tree); });
    each("option", [&](const auto& tree) { read_option(tree); });
    each("default", [&](const auto& tree) { read_defaults(tree, "main", 0); });
    each("asset", [&](const auto& tree) { read_assets(tree); });
    each("contact", [&](const auto& tree) { note_pairs(tree); });
    has_inertial_.push_back(false);
    each("worldbody", [&](const auto& tree) { read_children(tree, {}); });
    relate_classes(root);
    scale_masses();
    each("contact", [&](const auto& tree) { read_contact(tree); });
    each("tendon", [&](const auto& tree) { read_tendons(tree); });
    each("equality", [&](const auto& tree) { read_equality(tree); });
    each("keyframe", [&](const auto& tree) { read_keyframes(tree); });
    take_keyframe();
    each("actuator", [&](const auto& tree) { read_actuators(tree); });
    finish_tendons();
    if (!gravity_) model_.gravity = dvec3(0);
    SceneDocument document;
    document.scene = assemble(model_, options_, notes_);
    if (timestep_) document.settings = settings_;
    return document;
}

SceneDocument scene_of_mjcf(host::XmlElement root, Folder& folder, const ImportOptions& options, Notes& notes,
                            std::size_t most_bodies) {
    return Mjcf(folder, options, notes, most_bodies).read(std::move(root));
}

}  // namespace scree::imports
