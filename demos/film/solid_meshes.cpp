// Triangle meshes of cylinders, cones, hulls and meshes.
#include "demos/film/solid_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"

namespace scree::demos {

namespace {

constexpr int sides = 32;  // sides of a circle

void add(host::SolidMesh& mesh, vec3 point, vec3 normal, float edges = 0, float to_edge = 0) {
    mesh.corners.emplace_back(point, edges);
    mesh.corners.emplace_back(normal, to_edge);
}
vec3 on_circle(int k) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / sides;
    return {std::cos(angle), 0, std::sin(angle)};
}
// A disc at a height, facing up or down.
void add_disc(host::SolidMesh& mesh, float height, float up) {
    const vec3 lift(0, height, 0), normal(0, up, 0);
    for (int k = 0; k < sides; ++k) {
        add(mesh, lift, normal);
        add(mesh, lift + on_circle(up > 0 ? k + 1 : k), normal);
        add(mesh, lift + on_circle(up > 0 ? k : k + 1), normal);
    }
}

}  // namespace

host::SolidMesh cylinder_mesh() {
    host::SolidMesh mesh{true, {}};
    add_disc(mesh, 1, 1);
    add_disc(mesh, -1, -1);
    for (int k = 0; k < sides; ++k) {
        const vec3 a = on_circle(k), b = on_circle(k + 1), up(0, 1, 0);
        add(mesh, a - up, a);
        add(mesh, a + up, a);
        add(mesh, b + up, b);
        add(mesh, a - up, a);
        add(mesh, b + up, b);
        add(mesh, b - up, b);
    }
    return mesh;
}

host::SolidMesh cone_mesh() {
    host::SolidMesh mesh{true, {}};
    add_disc(mesh, -0.25f, -1);
    for (int k = 0; k < sides; ++k) {
        const vec3 a = on_circle(k), b = on_circle(k + 1), up(0, 1, 0);
        add(mesh, a - up * 0.25f, a + up);
        add(mesh, up * 0.75f, (a + b) * 0.5f + up);
        add(mesh, b - up * 0.25f, b + up);
    }
    return mesh;
}

host::SolidMesh hull_mesh(const Hull& hull) {
    host::SolidMesh mesh;
    // Edges as those of boxes: 14% of the thinnest half width, at most 6 cm.
    float thinnest = std::numeric_limits<float>::max();
    for (const HullForm::Face& face : hull.form->faces)
        thinnest = std::min(thinnest, static_cast<float>(glm::dot(face.normal, hull.form->vertices[face.corners[0]])));
    const float edges = std::clamp(0.14f * thinnest, 1e-6f, 0.06f);
    for (const HullForm::Face& face : hull.form->faces) {
        // Triangles from the middle of the face to each edge.
        const std::size_t count = face.corners.size();
        const auto corner = [&](std::size_t k) { return vec3(hull.form->vertices[face.corners[k % count]]); };
        vec3 middle(0);
        for (std::size_t k = 0; k < count; ++k) middle += corner(k) / static_cast<float>(count);
        for (std::size_t k = 0; k < count; ++k) {
            const vec3 a = corner(k), b = corner(k + 1), along = b - a;
            const float length = std::max(glm::length(along), 1e-12f);
            add(mesh, middle, vec3(face.normal), edges, glm::length(glm::cross(middle - a, along)) / length);
            add(mesh, a, vec3(face.normal), edges, 0);
            add(mesh, b, vec3(face.normal), edges, 0);
        }
    }
    return mesh;
}

host::SolidMesh patch_mesh(const MeshForm& form, std::size_t first, std::size_t last) {
    host::SolidMesh mesh;
    for (std::size_t k = first; k < last; ++k) {
        const MeshForm::Triangle& triangle = form.triangles[k];
        for (const vec3& corner : triangle.corners)
            add(mesh, triangle.middle + corner - form.triangles[first].middle, triangle.normal);
    }
    return mesh;
}

host::SolidMesh patch_mesh(const std::vector<Skin>& skins, std::size_t first, std::size_t last, const Part& part) {
    const auto turn_of = [](vec4 q) { return glm::quat(q.w, q.x, q.y, q.z); };
    const glm::quat back = glm::conjugate(turn_of(part.orientation));
    host::SolidMesh mesh;
    std::size_t before = 0;
    for (const Skin& skin : skins) {
        const glm::quat turn = turn_of(skin.orientation);
        const std::vector<MeshForm::Triangle>& all = skin.mesh->form->triangles;
        for (std::size_t k = std::max(first, before); k < std::min(last, before + all.size()); ++k) {
            const MeshForm::Triangle& one = all[k - before];
            for (const vec3& corner : one.corners)
                add(mesh, back * (skin.position + turn * (one.middle + corner) - part.position), back * (turn * one.normal));
        }
        before += all.size();
    }
    return mesh;
}

}  // namespace scree::demos
