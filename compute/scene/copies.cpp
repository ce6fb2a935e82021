// Copies of a scene: indices moved by those of the copies before.
#include "compute/scene/copies.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/scene/meshes/mesh.h"

namespace scree {

namespace {

struct Moved {
    std::size_t bodies = 0, joints = 0;

    void operator()(std::size_t& body) const {
        if (body != no_body) body += bodies;
    }
    void operator()(Body& body) const {
        (*this)(body.piece_of);
        if (body.fracture) (*this)(body.fracture->first_piece);
    }
    void operator()(Joint& joint) const {
        (*this)(joint.a);  // the_world is no_body
        (*this)(joint.b);
        if (auto* coupling = std::get_if<Coupling>(&joint.kind))
            for (CoupledAxis& term : coupling->joints) term.joint += joints;
    }
    void operator()(Vehicle& vehicle) const {
        (*this)(vehicle.chassis);
        for (Wheel& wheel : vehicle.wheels) wheel.joint += joints;
    }
    void operator()(Exclusion& pair) const {
        (*this)(pair.a);
        (*this)(pair.b);
    }
    void operator()(Bond& bond) const {
        (*this)(bond.a);
        (*this)(bond.b);
    }
};
static_assert(the_world == no_body);

template <class Item>
void append_moved(std::vector<Item>& to, const std::vector<Item>& from, const Moved& moved) {
    for (const Item& item : from) moved(to.emplace_back(item));
}
Scene without_fragments(Scene scene) {
    std::erase_if(scene.bodies, [](const Body& body) { return body.piece_of != no_body; });
    for (Body& body : scene.bodies)
        if (body.fracture) body.fracture->first_piece = no_body;
    return scene;
}

std::size_t parts_of(const Body& body) {
    if (const auto* compound = std::get_if<Compound>(&body.shape)) return compound->parts.size();
    const MeshForm* mesh = mesh_form_of(body.shape);
    return mesh ? mesh->triangles.size() : 0;
}

bool equal(const Fields& x, const Fields& y) {
    const auto same = [](const auto& one, const auto& other, const auto& test) {
        return one.has_value() == other.has_value() && (!one || test(*one, *other));
    };
    return same(x.wind, y.wind,
                [](const Wind& a, const Wind& b) { return a.velocity == b.velocity && a.density == b.density; }) &&
           same(x.water, y.water,
                [](const Water& a, const Water& b) {
                    return a.normal == b.normal && a.offset == b.offset && a.density == b.density && a.velocity == b.velocity &&
                           a.damping == b.damping;
                }) &&
           x.attractor_radius == y.attractor_radius &&
           std::equal(
               x.attractors.begin(), x.attractors.end(), y.attractors.begin(), y.attractors.end(),
               [](const Attractor& a, const Attractor& b) { return a.position == b.position && a.strength == b.strength; });
}

// Rows of a copy are found by counting, and fields and the periodic cell are of all.
void require_alike(const Scene& one, const Scene& varied, std::size_t copy) {
    const auto refuse = [&](const std::string& what) {
        throw std::invalid_argument("copy " + std::to_string(copy) + " of the scene has " + what +
                                    "; copies differ in the values of bodies, joints and vehicles, not in their number");
    };
    const auto require_count = [&](std::size_t is, std::size_t first, const char* what) {
        if (is != first) refuse(std::to_string(is) + " " + what + " instead of " + std::to_string(first));
    };
    require_count(varied.bodies.size(), one.bodies.size(), "bodies, fragments included,");
    require_count(varied.joints.size(), one.joints.size(), "joints");
    require_count(varied.vehicles.size(), one.vehicles.size(), "vehicles");
    require_count(varied.exclusions.size(), one.exclusions.size(), "exclusions");
    require_count(varied.bonds.size(), one.bonds.size(), "bonds");
    for (std::size_t i = 0; i < one.bodies.size(); ++i) {
        const std::size_t parts = parts_of(varied.bodies[i]), first = parts_of(one.bodies[i]);
        if (parts != first)
            refuse("a body " + std::to_string(i) + " of " + std::to_string(parts) + " parts instead of " + std::to_string(first));
        if (varied.bodies[i].piece_of != one.bodies[i].piece_of)
            refuse("a body " + std::to_string(i) + " that is a fragment of another body");
    }
    if (!equal(one.fields, varied.fields)) refuse("wind, water or attractors of its own");
    const PeriodicCell &cell = one.periodic, &other = varied.periodic;
    if (cell.size != other.size || cell.centre != other.centre || cell.rate != other.rate) refuse("a periodic cell of its own");
}

}  // namespace

CopiedScene copied(const Scene& one, std::size_t copies, const std::function<void(std::size_t, Scene&)>& vary) {
    CopiedScene made;
    Scene& all = made.scene;
    const Scene plain = vary ? without_fragments(one) : Scene{};
    for (std::size_t copy = 0; copy < copies; ++copy) {
        Scene varied;
        if (vary) {
            varied = plain;
            vary(copy, varied);
            varied = checked(std::move(varied));
            require_alike(one, varied, copy);
            made.gravities.push_back(varied.gravity);
        }
        const Scene& next = vary ? varied : one;
        if (copy == 0) {
            all.gravity = next.gravity;
            all.fields = next.fields;
            all.periodic = next.periodic;
            all.bodies.reserve(copies * next.bodies.size());
        }
        const Moved moved{copy * one.bodies.size(), copy * one.joints.size()};
        append_moved(all.bodies, next.bodies, moved);
        append_moved(all.joints, next.joints, moved);
        append_moved(all.vehicles, next.vehicles, moved);
        append_moved(all.exclusions, next.exclusions, moved);
        append_moved(all.bonds, next.bonds, moved);
    }
    const bool alike = std::all_of(made.gravities.begin(), made.gravities.end(), [&](vec3 g) { return g == all.gravity; });
    if (alike) made.gravities.clear();
    return made;
}

}  // namespace scree
