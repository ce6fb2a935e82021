// Categories by name, and models as PLY files.
#include "demos/film/model_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <iterator>

#include "compute/scene/meshes/convex_hull.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

// Without a number at the end and what parts it from the word; "" of a number alone.
std::string word_of(const std::string& name) {
    const std::size_t word = name.find_last_not_of("0123456789");
    if (word == std::string::npos) return "";
    if (word + 1 == name.size()) return name;
    const std::size_t last = name.find_last_not_of(" _-.#:", word);
    return last == std::string::npos ? "" : name.substr(0, last + 1);
}

std::string mesh_file_of(const Shape& shape) {
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return std::filesystem::path(mesh->file).stem().string();
    const auto* compound = std::get_if<Compound>(&shape);
    if (!compound || compound->skins.empty() || !compound->skins[0].mesh) return "";
    return std::filesystem::path(compound->skins[0].mesh->file).stem().string();
}

glm::dquat turn_of(const vec4& q) {
    return glm::normalize(
        glm::dquat(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)));
}

// Triangles with each corner once.
struct Corners {
    std::vector<std::array<float, 6>> corners;  // mm, and unit normals
    std::vector<std::array<std::size_t, 3>> triangles;
};

Corners corners_of(const Triangles& mesh, vec3 scale, const BodyFrame& origin) {
    Corners made;
    std::map<std::array<float, 6>, std::size_t> known;
    const glm::dquat back = glm::conjugate(turn_of(origin.orientation));
    std::array<std::size_t, 3> triangle{};
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const glm::dvec3 at = back * (glm::dvec3(mesh.points[i] * scale) - glm::dvec3(origin.position)) * 1000.0;
        const glm::dvec3 normal = back * glm::normalize(glm::dvec3(mesh.normals[i]) / glm::dvec3(scale));
        std::array<float, 6> corner{};
        for (int k = 0; k < 3; ++k) {
            corner[static_cast<std::size_t>(k)] = static_cast<float>(at[k]) + 0.0f;  // no -0
            corner[static_cast<std::size_t>(k) + 3] = static_cast<float>(normal[k]) + 0.0f;
        }
        const auto [place, fresh] = known.try_emplace(corner, made.corners.size());
        if (fresh) made.corners.push_back(corner);
        triangle[i % 3] = place->second;
        if (i % 3 == 2) made.triangles.push_back(triangle);
    }
    return made;
}

// https://paulbourke.net/dataformats/ply/
std::string ply_of(const Corners& form) {
    std::string text = fmt::format(
        "ply\nformat ascii 1.0\ncomment millimetres\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nelement face {}\nproperty list uchar int vertex_indices\n"
        "end_header\n",
        form.corners.size(), form.triangles.size());
    for (const auto& c : form.corners)
        fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g} {:.7g} {:.5g} {:.5g} {:.5g}\n", c[0], c[1], c[2], c[3], c[4],
                       c[5]);
    for (const auto& t : form.triangles) fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

// Greatest distance of two points: of corners of their hull, unless they are flat.
double diameter_of(const std::vector<glm::dvec3>& points, double size) {
    std::vector<glm::dvec3> wide;
    for (const glm::dvec3& point : points) wide.push_back(point / std::max(size, 1e-9));
    std::vector<std::size_t> outer;
    const ConvexHull hull = convex_hull(wide, 1000, 1e-7);
    for (const std::uint32_t corner : hull.corners) outer.push_back(corner);
    if (hull.empty())
        for (std::size_t i = 0; i < points.size(); ++i) outer.push_back(i);
    double greatest = 0;
    for (std::size_t i = 0; i < outer.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) greatest = std::max(greatest, glm::distance(points[outer[i]], points[outer[k]]));
    return greatest;
}

ModelFiles::Model model_of(std::string name, const Corners& form) {
    ModelFiles::Model model;
    model.name = std::move(name);
    std::vector<glm::dvec3> points;
    for (const auto& c : form.corners) points.emplace_back(c[0], c[1], c[2]);
    if (points.empty()) return model;
    model.low = model.high = points[0];
    for (const glm::dvec3& point : points) {
        model.low = glm::min(model.low, point);
        model.high = glm::max(model.high, point);
    }
    model.diameter = diameter_of(points, glm::length(model.high - model.low));
    return model;
}

}  // namespace

std::string category_of(const Body& body) {
    if (const std::string stem = word_of(body.name); !stem.empty()) return stem;
    if (const std::string file = mesh_file_of(body.shape); !file.empty()) return file;
    return shape_name(body.shape);
}

int Categories::number_of(const Body& body) {
    std::string name = category_of(body);
    const auto [known, fresh] = numbers_.try_emplace(name, static_cast<int>(names_.size()) + 1);
    if (fresh) names_.push_back(std::move(name));
    return known->second;
}

int ModelFiles::number_of(const World& world, std::size_t body) {
    const auto [of_body, new_body] = of_bodies_.try_emplace({body, world.handle_of(body).generation}, 0);
    if (!new_body) return of_body->second;
    const Body& made = world.scene().bodies[body];
    const std::string name = category_of(made);
    const std::size_t before = meshes_.meshes().size();
    const Drawn drawn = meshes_.add(made.shape, 1, vec3(0));
    if (meshes_.meshes().size() > before) kept_.push_back(made.shape);
    const BodyFrame origin = made.origin.value_or(BodyFrame{});
    const vec3 at = origin.position;
    const vec4 turn = origin.orientation;
    const std::string form = fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", drawn.mesh, drawn.scale.x, drawn.scale.y,
                                         drawn.scale.z, at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w, name);
    const auto [of_form, new_form] = of_forms_.try_emplace(form, 0);
    if (new_form) {
        const Corners corners = corners_of(meshes_.meshes()[drawn.mesh], drawn.scale, origin);
        const std::string text = ply_of(corners);
        const auto [of_file, new_file] = of_files_.try_emplace({std::hash<std::string>()(text), text.size(), name}, 0);
        if (new_file) {
            models_.push_back(model_of(name, corners));
            of_file->second = static_cast<int>(models_.size());
            host::write_atomically(folder_ / fmt::format("obj_{:06}.ply", models_.size()), text);
        }
        of_form->second = of_file->second;
    }
    return of_body->second = of_form->second;
}

}  // namespace scree::demos
