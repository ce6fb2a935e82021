// MJCF: geoms, their meshes, surfaces and classes of collision.
#include <algorithm>
#include <cmath>

#include "compute/scene_file/import/mjcf/mjcf.h"

namespace scree::imports {

namespace {

enum GeomType : std::size_t { plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh, sdf };
const std::vector<std::string> geom_types = {"plane",    "hfield", "sphere", "capsule", "ellipsoid",
                                             "cylinder", "box",    "mesh",   "sdf"};

// scree's capsules and cylinders lie along y, MuJoCo's along z.
const dquat y_to_z(std::sqrt(0.5), std::sqrt(0.5), 0, 0);

float size_at(Element& geom, const std::vector<double>& size, std::size_t k) {
    if (k >= size.size()) geom.refuse("size", "needs more numbers");
    if (!(size[k] > 0)) geom.refuse("size", "must be above 0 m");
    return static_cast<float>(size[k]);
}

std::vector<glm::uvec3> faces_of(Element& asset, std::size_t points) {
    const auto numbers = numbers_in(asset.text("face"), 6'000'000);
    if (!numbers || numbers->size() % 3 != 0) asset.refuse("face", "must be three indices of vertices each");
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i < numbers->size(); i += 3) {
        for (std::size_t k = i; k < i + 3; ++k)
            if (!((*numbers)[k] >= 0 && (*numbers)[k] < static_cast<double>(points)) ||
                (*numbers)[k] != std::floor((*numbers)[k]))
                asset.refuse("face", "has an index of no vertex");
        triangles.emplace_back((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2]);
    }
    return triangles;
}

}  // namespace

void Mjcf::give_size(Element& geom, std::size_t type, Geometry& geometry) {
    std::vector<double> size = geom.numbers("size", 1, 3);
    if (const auto ends = geom.numbers("fromto", 6, 6); !ends.empty()) {
        const dvec3 a(ends[0], ends[1], ends[2]), b(ends[3], ends[4], ends[5]);
        if (type != capsule && type != cylinder && type != box && type != ellipsoid)
            geom.refuse("fromto", "is for capsules, cylinders, boxes and ellipsoids");
        if (!(glm::length(b - a) > 1e-9)) geom.refuse("fromto", "has ends at one point");
        // MuJoCo's z axis points from the second end to the first.
        geometry.placed = {0.5 * (a + b), turn_between({0, 0, 1}, glm::normalize(a - b))};
        const double half = 0.5 * glm::length(b - a);
        if (size.empty()) geom.refuse("size", "is missing: the radius");
        size = type == capsule || type == cylinder ? std::vector<double>{size[0], half}
                                                   : std::vector<double>{size[0], size[0], half};
    }
    const auto at = [&](std::size_t k) { return size_at(geom, size, k); };
    if (type == plane) {
        geometry.shape = Plane{vec3(0, 0, 1), 0};  // infinite, as in MuJoCo, whose size is for pictures
    } else if (type == sphere) {
        geometry.shape = Sphere{at(0)};
    } else if (type == capsule) {
        geometry.shape = Capsule{at(0), at(1)};
    } else if (type == cylinder) {
        geometry.shape = Cylinder{at(0), at(1)};
    } else if (type == box) {
        geometry.shape = Box{vec3(at(0), at(1), at(2))};
    } else {
        geometry.shape = Ellipsoid{vec3(at(0), at(1), at(2))};
    }
    if (type == capsule || type == cylinder) geometry.placed.turn = geometry.placed.turn * y_to_z;
}

// As mjCMesh::ApplyTransformations: from the reference point, turned back, then scaled along the turned axes.
MeshMap Mjcf::map_of(Element& asset) {
    const auto scale = asset.numbers<3>("scale", {1, 1, 1});
    const auto from = asset.numbers<3>("refpos", {0, 0, 0});
    const auto q = asset.numbers<4>("refquat", {1, 0, 0, 0});
    const dquat reference(q[0], q[1], q[2], q[3]);
    if (!(glm::length(reference) > 1e-12)) asset.refuse("refquat", "is of length 0");
    const dmat3 linear =
        diagonal(dvec3(scale[0], scale[1], scale[2])) * glm::mat3_cast(glm::conjugate(glm::normalize(reference)));
    return {linear, linear * -dvec3(from[0], from[1], from[2])};
}

// The mesh that a geom names.
std::shared_ptr<const MeshSolid> Mjcf::mesh_of(Element& geom, bool parts) {
    const std::string name = geom.text("mesh");
    const auto found = meshes_.find(name);
    if (found == meshes_.end()) geom.refuse("mesh", "there is no mesh \"" + name + "\"");
    Element asset = element(*found->second.element, {});
    const MeshMap map = map_of(asset);
    asset.ignore({"texcoord", "smoothnormal", "material"}, "is not drawn");
    asset.ignore({"maxhullvert", "inertia", "octree_maxdepth"}, "is left out; hulls have at most 64 corners, and mass by volume");
    asset.pass({"content_type", "normal", "user"});
    if (asset.has("builtin") || asset.has("plugin")) asset.refuse("is made by MuJoCo; save it as a file");
    std::string file = asset.text("file");
    if (file.empty()) {
        const auto numbers = numbers_in(asset.text("vertex"), 3'000'000);
        if (!numbers || numbers->size() < 12) asset.refuse("has neither a \"file\" nor \"vertex\" with four points or more");
        if (numbers->size() % 3 != 0) asset.refuse("vertex", "must be three numbers for each point");
        std::vector<vec3> points;
        for (std::size_t i = 0; i + 2 < numbers->size(); i += 3)
            points.push_back(vec3(dvec3((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2])));
        std::vector<glm::uvec3> triangles = faces_of(asset, points.size());
        const bool cloud = triangles.empty();  // whose hull is meant
        for (std::uint32_t i = 0; cloud && i < points.size(); ++i) triangles.emplace_back(i, i, i);
        asset.finish();
        map_mesh(map, points, triangles);
        MeshSolid solid = mesh_solid(points, triangles, {0}, parts && !cloud);
        solid.encloses = solid.encloses || cloud;
        return std::make_shared<MeshSolid>(std::move(solid));
    }
    if (compiler_.strip) file = file.substr(file.find_last_of("/\\") + 1);
    const std::string& folder = compiler_.meshes.empty() ? compiler_.assets : compiler_.meshes;
    if (!folder.empty() && !file.starts_with('/')) file = folder + "/" + file;
    asset.finish();
    return folder_.mesh(asset.origin(), file, map, false, parts);
}

void Mjcf::give_surface(Element& geom, Geometry& geometry) {
    std::vector<double> friction = {1, 0.005, 0.0001};
    const auto given = geom.numbers("friction", 1, 3);
    std::copy(given.begin(), given.end(), friction.begin());
    for (const double one : friction)
        if (one < 0) geom.refuse("friction", "must not be below 0");
    const long dimensions = geom.whole("condim", 3);
    if (dimensions != 1 && dimensions != 3 && dimensions != 4 && dimensions != 6) geom.refuse("condim", "must be 1, 3, 4 or 6");
    Material& material = geometry.material;
    material.friction = dimensions == 1 ? 0 : static_cast<float>(std::min(friction[0], 100.0));
    if (dimensions >= 4) material.spinning_resistance = static_cast<float>(friction[1]);
    if (dimensions == 6) material.rolling_resistance = static_cast<float>(friction[2]);
    material.friction_rule = CombineRule::maximum;
    geom.ignore({"priority", "solmix", "solref", "solimp", "margin", "gap"}, "is of MuJoCo's contacts; scree has its own");
    geom.ignore({"fluidshape", "fluidcoef"}, "is for fluids, which are refused");
}

std::size_t Mjcf::class_of(Element& geom, bool& solid) {
    GeomClass own{static_cast<std::uint32_t>(geom.whole("contype", 1)), static_cast<std::uint32_t>(geom.whole("conaffinity", 1)),
                  ""};
    const std::string name = geom.text("name");
    if (paired_.contains(name)) own.alone = name;
    solid = contacts_ && (own.type != 0 || own.affinity != 0 || !own.alone.empty());
    if (!solid) return 0;
    const auto found = std::find(classes_.begin(), classes_.end(), own);
    const auto index = static_cast<std::size_t>(found - classes_.begin());
    if (found == classes_.end()) {
        if (classes_.size() == 31)
            geom.refuse("it would be the 32nd class of collision (contype, conaffinity, pairs); scree has 31");
        classes_.push_back(own);
    }
    return index;
}

void Mjcf::relate_classes(const host::XmlElement&) {
    const std::size_t count = classes_.size();
    model_.collides.assign(count, std::vector<bool>(count));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            const GeomClass &a = classes_[i], &b = classes_[j];
            bool meet = (a.type & b.affinity) != 0 || (b.type & a.affinity) != 0;
            for (const auto& [first, second] : pairs_)
                meet = meet || (a.alone == first && b.alone == second) || (a.alone == second && b.alone == first);
            model_.collides[i][j] = meet;
        }
    }
}

void Mjcf::read_geom(const host::XmlElement& tree, const Where& where) {
    Element geom = element(tree, where);
    if (++geoms_ > std::min<std::size_t>(most_bodies_, 1'000'000)) geom.refuse("there are more geoms than fit into memory");
    Geometry geometry;
    geometry.origin = geom.origin();
    geometry.name = geom.text("name") + where.suffix;
    const std::size_t type = geom.word("type", geom_types, geom.has("mesh") ? mesh : sphere);
    ModelBody& body = model_.bodies[where.body];
    if (type == sdf) geom.refuse("type", "\"sdf\" is not read");
    if (type == plane && (where.body != world_body || body.kinematic)) {
        std::size_t above = where.body;
        while (above != world_body && model_.bodies[above].joints.empty() && !model_.bodies[above].free &&
               !model_.bodies[above].kinematic)
            above = model_.bodies[above].parent;
        if (above != world_body) geom.refuse("a plane is infinite and cannot move");
    }
    if (type != mesh && geom.has("mesh"))
        geom.refuse("mesh", "is fitted by a shape in MuJoCo; write the shape's size, or type=\"mesh\"");
    const auto at = geom.numbers<3>("pos", {0, 0, 0});
    geometry.placed = {{at[0], at[1], at[2]}, turn(geom)};
    give_surface(geom, geometry);
    geometry.collides_as = class_of(geom, geometry.solid);
    SolidMass mass;
    std::shared_ptr<const MeshSolid> solid;
    if (type == mesh) {
        solid = mesh_of(geom, geometry.solid);
        geom.pass({"size", "fromto"});
        if (solid->hulls.empty()) {
            if (geometry.solid) geom.refuse("mesh", "has no convex hull: " + solid->flaw);
            geom.note("mesh", "has no convex hull and is not drawn: " + solid->flaw);
        } else {
            geometry.shape = Hull{solid->hulls[0]};
            geometry.parts = solid->parts[0];
            if (!solid->remark.empty()) geom.note("mesh", solid->remark);
            mass = solid->mass;
            if (!solid->encloses) geom.note("mesh", "is open, or faces inwards; its mass is that of its hull");
            if (!geometry.solid) geom.note("mesh", "is drawn as its convex hull");
        }
    } else if (type == hfield) {
        Placed inside;
        geometry.terrain = terrain_of(geom, inside);
        geometry.placed = geometry.placed * inside;
        geom.pass({"size"});
    } else {
        give_size(geom, type, geometry);
        mass = primitive_mass(geometry.shape);
    }
    geometry.placed = where.frame * geometry.placed;
    const long group = geom.whole("group", 0);
    const double density = geom.number("density", 1000), given = geom.number("mass", -1);
    if (density < 0 || (geom.has("mass") && given < 0)) geom.refuse("mass or density is below 0");
    if (geom.flag("shellinertia", false)) geom.refuse("shellinertia", "is not read; give the body an inertial");
    const bool counts = group >= compiler_.first_group && group <= compiler_.last_group && mass.mass > 0 && type != plane &&
                        (compiler_.from_geoms == 1 || (compiler_.from_geoms == 2 && !has_inertial_[where.body]));
    if (counts) {
        const double factor = geom.has("mass") ? given / mass.mass : density;
        body.mass = sum_of(body.mass, placed_mass(scaled_mass(mass, factor), geometry.placed));
    }
    if (const std::vector<double> rgba = geom.numbers("rgba", 3, 4); !rgba.empty())
        geometry.color = glm::clamp(vec3(dvec3(rgba[0], rgba[1], rgba[2])), 0.0f, 1.0f);
    if (const std::string name = geom.text("material"); !name.empty()) {
        const auto material = materials_.find(name);
        if (material == materials_.end()) geom.refuse("material", "there is no material \"" + name + "\"");
        if (!geometry.color) geometry.color = material->second;
    }
    geom.ignore({"user", "fitscale"}, "is left out; no motion depends on it");
    geom.finish();
    const bool shown = geometry.solid || !compiler_.discard_visual;
    if (shown && (!solid || !solid->hulls.empty())) body.geometries.push_back(std::move(geometry));
}

}  // namespace scree::imports
