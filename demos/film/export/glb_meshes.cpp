// Shapes as triangles for files of animations.
#include "demos/film/export/glb_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <optional>
#include <variant>

#include "compute/scene/meshes/mesh.h"
#include "demos/film/solid_meshes.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr int meridians = 24, parallels = 12;

// A convex shape with a key that bodies alike share, and the scale that makes it of the mesh.
struct SharedShape {
    std::string key;
    vec3 scale{1};
    Triangles triangles;
};

Triangles of_corners(const host::SolidMesh& mesh) {
    Triangles made;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 2) {
        made.points.emplace_back(mesh.corners[i]);
        made.normals.push_back(glm::normalize(vec3(mesh.corners[i + 1])));
    }
    return made;
}

void add_triangle(Triangles& to, vec3 a, vec3 b, vec3 c, vec3 na, vec3 nb, vec3 nc) {
    to.points.insert(to.points.end(), {a, b, c});
    to.normals.insert(to.normals.end(), {na, nb, nc});
}

// A ball of this radius whose halves are apart along y by twice `half_height`.
Triangles round_mesh(float radius, float half_height) {
    constexpr float pi = std::numbers::pi_v<float>;
    const auto direction = [&](int ring, int k) {
        const float down = pi * static_cast<float>(ring) / parallels, around = 2 * pi * static_cast<float>(k) / meridians;
        return vec3(std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around));
    };
    Triangles made;
    const auto quad = [&](vec3 na, vec3 nb, vec3 nc, vec3 nd, float above, float below) {
        const auto at = [&](vec3 n, float height) { return n * radius + vec3(0, height, 0); };
        add_triangle(made, at(na, above), at(nb, above), at(nc, below), na, nb, nc);
        add_triangle(made, at(na, above), at(nc, below), at(nd, below), na, nc, nd);
    };
    for (int k = 0; k < meridians; ++k) {
        for (int ring = 0; ring < parallels; ++ring) {
            const float height = ring < parallels / 2 ? half_height : -half_height;
            quad(direction(ring, k), direction(ring, k + 1), direction(ring + 1, k + 1), direction(ring + 1, k), height, height);
        }
        const vec3 a = direction(parallels / 2, k), b = direction(parallels / 2, k + 1);
        if (half_height > 0) quad(a, b, b, a, half_height, -half_height);
    }
    return made;
}

Triangles cube_mesh() {
    Triangles made;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {1.0f, -1.0f}) {
            vec3 out(0), u(0), v(0);
            out[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = side;
            add_triangle(made, out - u - v, out + u - v, out + u + v, out, out, out);
            add_triangle(made, out - u - v, out + u + v, out - u + v, out, out, out);
        }
    return made;
}

SharedShape shared_shape(const Sphere& s) {
    return {"sphere", vec3(s.radius), round_mesh(1, 0)};
}
SharedShape shared_shape(const Ellipsoid& s) {
    return {"sphere", s.radii, round_mesh(1, 0)};
}
SharedShape shared_shape(const Capsule& s) {
    return {fmt::format("capsule {} {}", s.radius, s.half_height), vec3(1), round_mesh(s.radius, s.half_height)};
}
SharedShape shared_shape(const Box& s) {
    return {"box", s.half_extents, cube_mesh()};
}
SharedShape shared_shape(const Cylinder& s) {
    return {"cylinder", vec3(s.radius, s.half_height, s.radius), of_corners(cylinder_mesh())};
}
SharedShape shared_shape(const Cone& s) {
    return {"cone", vec3(s.radius, s.height, s.radius), of_corners(cone_mesh())};
}
SharedShape shared_shape(const Hull& s) {
    return {fmt::format("hull {}", static_cast<const void*>(s.form.get())), vec3(1), of_corners(hull_mesh(s))};
}
SharedShape shared_shape(const Plane&) {
    return {};
}

// Moved into a compound's frame.
void append(Triangles& to, const SharedShape& part, vec3 position, vec4 orientation) {
    for (const vec3& point : part.triangles.points)
        to.points.push_back(position + physics::rotate(orientation, point * part.scale));
    for (const vec3& normal : part.triangles.normals)
        to.normals.push_back(physics::rotate(orientation, glm::normalize(normal / part.scale)));
}

// Triangles of forms, put in order by their materials.
class SkinTriangles {
public:
    void add(const MeshForm& form, vec3 position, const glm::quat& turn) {
        for (std::size_t i = 0; i < form.triangles.size(); ++i) {
            const TriangleLook look = look_of(form, i);
            Triangles& to = place_of(look);
            for (const vec3& corner : form.triangles[i].corners)
                to.points.push_back(position + turn * (form.triangles[i].middle + corner));
            to.normals.insert(to.normals.end(), 3, turn * form.triangles[i].normal);
            to.at.insert(to.at.end(), look.at.begin(), look.at.end());
            to.colors.insert(to.colors.end(), look.colors.begin(), look.colors.end());
        }
    }
    // Behind others.
    Triangles finish(Triangles all = {}) {
        all.points.insert(all.points.end(), plain_.points.begin(), plain_.points.end());
        all.normals.insert(all.normals.end(), plain_.normals.begin(), plain_.normals.end());
        if (!materials_.empty()) all.at.resize(all.points.size()), all.colors.resize(all.points.size());
        for (std::size_t k = 0; k < materials_.size(); ++k) {
            Triangles& one = of_materials_[k];
            all.ranges.push_back({*materials_[k], all.points.size()});
            all.points.insert(all.points.end(), one.points.begin(), one.points.end());
            all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
            all.at.insert(all.at.end(), one.at.begin(), one.at.end());
            all.colors.insert(all.colors.end(), one.colors.begin(), one.colors.end());
        }
        return all;
    }

private:
    Triangles& place_of(const TriangleLook& look) {
        if (look.material == nullptr) return plain_;
        const auto known =
            std::find_if(materials_.begin(), materials_.end(), [&](const auto* one) { return *one == *look.material; });
        if (known != materials_.end()) return of_materials_[static_cast<std::size_t>(known - materials_.begin())];
        materials_.push_back(look.material);
        return of_materials_.emplace_back();
    }
    Triangles plain_;
    std::vector<const host::SurfaceMaterial*> materials_;
    std::deque<Triangles> of_materials_;
};

Triangles plane_mesh(const Plane& plane, float reach, vec3 middle) {
    const vec3 n = plane.normal, centre = middle + n * (plane.offset - glm::dot(n, middle));
    const vec3 u = glm::normalize(glm::cross(std::abs(n.y) < 0.9f ? vec3(0, 1, 0) : vec3(0, 0, 1), n)) * reach,
               v = glm::normalize(glm::cross(n, u)) * reach;
    Triangles made;
    add_triangle(made, centre - u - v, centre + u - v, centre + u + v, n, n, n);
    add_triangle(made, centre - u - v, centre + u + v, centre - u + v, n, n, n);
    return made;
}

}  // namespace

Drawn MeshCollection::shared(const std::string& key, vec3 scale, Triangles&& made) {
    const auto [found, fresh] = known_.try_emplace(key, meshes_.size());
    if (fresh) meshes_.push_back(std::move(made));
    return {found->second, scale};
}

Drawn MeshCollection::add(const Shape& shape, float plane_reach, vec3 middle) {
    if (const auto* plane = std::get_if<Plane>(&shape)) {
        meshes_.push_back(plane_mesh(*plane, plane_reach, middle));
        return {meshes_.size() - 1, vec3(1)};
    }
    if (const std::optional<SimpleShape> simple = simple_shape(shape)) {
        SharedShape made = std::visit([](const auto& one) { return shared_shape(one); }, *simple);
        return shared(made.key, made.scale, std::move(made.triangles));
    }
    if (const MeshForm* form = mesh_form_of(shape)) {
        SkinTriangles made;
        made.add(*form, vec3(0), glm::quat(1, 0, 0, 0));
        return shared(fmt::format("mesh {}", static_cast<const void*>(form)), vec3(1), made.finish());
    }
    Triangles parts;
    SkinTriangles skins;
    std::string key = "compound";
    const auto& compound = std::get<Compound>(shape);
    for (const Skin& skin : compound.skins) {
        const glm::quat turn(skin.orientation.w, skin.orientation.x, skin.orientation.y, skin.orientation.z);
        skins.add(*skin.mesh->form, skin.position, turn);
        key += fmt::format(" skin {} {} {} {} {} {} {} {}", static_cast<const void*>(skin.mesh->form.get()), skin.position.x,
                           skin.position.y, skin.position.z, skin.orientation.x, skin.orientation.y, skin.orientation.z,
                           skin.orientation.w);
    }
    for (const Part& part : compound.parts) {
        if (part.skinned && !compound.skins.empty()) continue;
        const SharedShape one = std::visit([](const auto& convex) { return shared_shape(convex); }, part.shape);
        append(parts, one, part.position, part.orientation);
        key += fmt::format(" {} {} {} {} {} {} {} {} {} {} {}", one.key, one.scale.x, one.scale.y, one.scale.z, part.position.x,
                           part.position.y, part.position.z, part.orientation.x, part.orientation.y, part.orientation.z,
                           part.orientation.w);
    }
    return shared(key, vec3(1), skins.finish(std::move(parts)));
}

}  // namespace scree::demos
