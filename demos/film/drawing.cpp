// Drawing of a world: the choice of the canvas, and the tables that it draws from.
#include "demos/film/drawing.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "compute/scene/meshes/mesh.h"
#include "compute/tables/state.h"
#include "demos/film/solid_meshes.h"
#include "demos/program/exit_status.h"
#include "host/device_error.h"
#include "shaders/physics/body/compound.h"

namespace scree::demos {

namespace {

// Rows grouped by shape and mesh.
class Instances {
public:
    explicit Instances(bool parts = false) : parts_(parts) {}
    void add(std::uint32_t row, const SimpleShape& shape) {
        std::visit([&](const auto& one) { draw(row, one); }, shape);
    }
    // Triangles in patches, drawn with the first triangle's row. The size is limited, because every solid is drawn
    // with the vertex count of the largest mesh.
    void add(std::uint32_t first_row, const MeshForm& form) {
        for (std::size_t k = 0; k < form.triangles.size(); k += triangles_of_patch) {
            const std::size_t last = std::min(k + triangles_of_patch, form.triangles.size());
            made.meshes.push_back(patch_mesh(form, k, last));
            add(first_row + static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(made.meshes.size() - 1));
        }
    }

    // Of a body, also of a removed one: shaders skip its row.
    void add(const Shape& shape, std::uint32_t row, std::uint32_t first_part) {
        if (const std::optional<SimpleShape> simple = simple_shape(shape)) add(row, *simple);
        if (const auto* compound = std::get_if<Compound>(&shape)) add(*compound, first_part);
        if (const MeshForm* form = mesh_form_of(shape)) add(first_part, *form);
    }

    host::ShapeInstances made;

private:
    void draw(std::uint32_t row, const Sphere&) { made.spheres.push_back(row); }
    void draw(std::uint32_t row, const Ellipsoid&) { made.spheres.push_back(row); }
    void draw(std::uint32_t row, const Capsule&) { made.capsules.push_back(row); }
    void draw(std::uint32_t row, const Box&) { made.boxes.push_back(row); }
    void draw(std::uint32_t row, const Plane&) { made.planes.push_back(row); }
    void draw(std::uint32_t row, const Cylinder&) { add(row, mesh_for(&cylinders_, cylinder_mesh)); }
    void draw(std::uint32_t row, const Cone&) { add(row, mesh_for(&cones_, cone_mesh)); }
    void draw(std::uint32_t row, const Hull& hull) {
        add(row, mesh_for(hull.form.get(), [&] { return hull_mesh(hull); }));
    }
    template <class Make>
    std::uint32_t mesh_for(const void* key, Make make) {
        const auto [mesh, fresh] = meshes_.try_emplace(key, static_cast<std::uint32_t>(made.meshes.size()));
        if (fresh) made.meshes.push_back(make());
        return mesh->second;
    }
    void add(std::uint32_t row, std::uint32_t mesh) {
        made.solids.push_back(row);
        made.solid_meshes.push_back(mesh);
    }

    void add(const Compound& compound, std::uint32_t first_part) {
        std::vector<std::uint32_t> skinned;
        for (std::uint32_t i = 0; i < compound.parts.size(); ++i) {
            const Part& one = compound.parts[i];
            if (one.role == Role::sensor) continue;
            if (one.skinned && !parts_ && !compound.skins.empty())
                skinned.push_back(i);
            else
                add(first_part + i, one.shape);
        }
        if (!skinned.empty()) add_skins(compound, skinned, first_part);
    }
    // In patches, each drawn with the row of one of the parts in whose place it is: a row has one mesh. Equal bodies share them.
    void add_skins(const Compound& compound, const std::vector<std::uint32_t>& skinned, std::uint32_t first_part) {
        std::size_t all = 0;
        std::vector<float> key;
        const auto placed = [&](vec3 position, vec4 turn) {
            key.insert(key.end(), {position.x, position.y, position.z, turn.x, turn.y, turn.z, turn.w});
        };
        std::vector<const void*> forms;
        for (const Skin& skin : compound.skins) {
            all += skin.mesh->form->triangles.size();
            forms.push_back(skin.mesh->form.get());
            placed(skin.position, skin.orientation);
        }
        for (const std::uint32_t i : skinned) placed(compound.parts[i].position, compound.parts[i].orientation);
        const std::size_t size = std::max(triangles_of_patch, (all + skinned.size() - 1) / skinned.size());
        const std::size_t count = (all + size - 1) / size;
        const auto [first, fresh] =
            skins_.try_emplace({std::move(forms), std::move(key)}, static_cast<std::uint32_t>(made.meshes.size()));
        for (std::size_t k = 0; fresh && k < count; ++k)
            made.meshes.push_back(patch_mesh(compound.skins, k * size, (k + 1) * size, compound.parts[skinned[k]]));
        for (std::uint32_t k = 0; k < count; ++k) add(first_part + skinned[k], first->second + k);
    }

    bool parts_;
    std::map<std::pair<std::vector<const void*>, std::vector<float>>, std::uint32_t> skins_;  // first mesh of each
    static constexpr std::size_t triangles_of_patch = 128;                                    // as many triangles as a cylinder
    std::map<const void*, std::uint32_t> meshes_;  // mesh index of cylinders, cones and each hull
    const char cylinders_ = 0, cones_ = 0;
};

}  // namespace

// The shape of a body that moves in a share, of which the scene may be elsewhere. Hulls by their place in the table of hulls.
SimpleShape shape_in(const physics::BodyProperties& body, const std::map<physics::uint, const Hull*>& hulls) {
    const vec3 size = body.size;
    switch (body.shape) {
        case physics::SHAPE_CAPSULE:
            return Capsule{size.x, size.y};
        case physics::SHAPE_BOX:
            return Box{size};
        case physics::SHAPE_CYLINDER:
            return Cylinder{size.x, size.y};
        case physics::SHAPE_CONE:
            return Cone{size.x, size.y};
        case physics::SHAPE_ELLIPSOID:
            return Ellipsoid{size};
        case physics::SHAPE_HULL:
            return *hulls.at(body.shape_data);
        default:
            return Sphere{size.x};
    }
}

host::ShapeInstances instances_of(const World::Share& share, bool with_still) {
    const State& state = share.state;
    std::map<physics::uint, const Hull*> hulls;
    for (const Hull& hull : share.hulls)
        if (const auto place = state.shape_places.hulls.find(hull.form); place != state.shape_places.hulls.end())
            hulls[place->second] = &hull;
    Instances instances;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row)
        if (state.is_owned(row) && (state.properties[row].flags & physics::ROW_SENSOR) == 0)
            instances.add(row, shape_in(state.properties[row], hulls));
    if (!with_still) return std::move(instances.made);
    std::map<std::uint32_t, std::uint32_t> first_parts;  // by row of the body
    for (std::uint32_t row = state.fixed().bodies; row-- > state.fixed().first_part;)
        if (physics::is_part(state.properties[row])) first_parts[state.properties[row].owner] = row;
    for (const auto& [id, body] : share.still) {
        if (body.role == Role::sensor) continue;
        const std::uint32_t row = state.row_of(id);
        const auto part = first_parts.find(row);
        instances.add(body.shape, row, part == first_parts.end() ? 0 : part->second);
    }
    // The light maps, which planes need too, are placed where there are bodies: if need be, an empty row.
    const host::ShapeInstances& made = instances.made;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        if (!(made.spheres.empty() && made.capsules.empty() && made.boxes.empty() && made.solids.empty())) break;
        if (physics::is_absent(state.properties[row].motion)) instances.made.spheres.push_back(row);
    }
    return std::move(instances.made);
}

host::ShapeInstances instances_of(const World& world, const CopiesShown& shown, bool parts) {
    const Scene& scene = world.scene();
    const State& state = world.state();
    Instances instances(parts);
    const std::vector<std::size_t> first_parts = world.first_part_rows();
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        const Shape& shape = scene.bodies[i].shape;
        if (scene.bodies[i].role == Role::sensor) continue;
        const std::size_t copy = i / world.bodies_of_copy();
        if (!shown.shows(copy) || (copy > shown.first && std::holds_alternative<Plane>(shape))) continue;
        instances.add(shape, state.row_of(i), static_cast<std::uint32_t>(first_parts[i]));
    }
    return std::move(instances.made);
}

host::BodyTables tables_of(const State& state) {
    const std::uint32_t contacts = state.counted().contacts;
    host::BodyTables tables{state.properties,
                            state.poses,
                            state.velocities,
                            std::span(state.contacts).first(contacts),
                            std::span(state.impulses).first(contacts),
                            contacts};
    tables.slot_ends = state.slot_ends;
    tables.slot_sides = state.slot_sides;
    tables.sleep_states = state.sleep_states;
    tables.bounds = state.bounds;
    tables.ids = state.ids;
    tables.joints = state.joints;
    tables.joint_count = static_cast<std::uint32_t>(state.joints.size());
    return tables;
}

// Fragments have the colour of what they are of.
std::vector<glm::vec4> colors_of(const Scene& scene) {
    std::vector<glm::vec4> colors(std::max<std::size_t>(1, scene.bodies.size()), glm::vec4(0));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& body = scene.bodies[i];
        if (body.piece_of < i) colors[i] = colors[body.piece_of];
        if (!body.color) continue;
        colors[i] = glm::vec4(host::linear_from_srgb(*body.color), 1);
    }
    return colors;
}

namespace {

// Any available canvas. OpenGL ES first, because llvmpipe draws a frame in 5% less time than lavapipe (3,000 bodies
// at 1280x720).
std::unique_ptr<host::Canvas> any_canvas(const Backend& machine, const host::ShapeInstances& instances,
                                         const host::CanvasOptions& options) {
    std::string missing;
    try {
        return host::make_gl_canvas(instances, options);
    } catch (const host::DeviceError& error) {
        missing = error.what();
    }
    try {
        return make_vulkan_canvas(machine, instances, options);
    } catch (const host::DeviceError& error) {
        throw UsageError("--frames and --video need OpenGL ES or Vulkan, though the simulation does not: " + missing + "; or " +
                         error.what());
    }
}

}  // namespace

Drawing::Drawing(const std::string& canvas, const Backend& machine, World& world, const host::CanvasOptions& options,
                 const CopiesShown& shown, bool from_host)
    : world_(world), word_(canvas), machine_(machine), options_(options), shown_(shown) {
    const bool by_vulkan = (canvas == "vulkan" && machine.device) || (canvas == "auto" && machine.draws());
    from_device_ = by_vulkan && shown.count == 0 && !from_host;
    if (from_host && by_vulkan) word_ = "vulkan";
    update();
}

std::unique_ptr<host::Canvas> Drawing::make_canvas() const {
    const host::ShapeInstances instances = instances_of(world_, shown_, options_.parts);
    try {
        if (word_ == "vulkan" || from_device_) return make_vulkan_canvas(machine_, instances, options_);
        return word_ == "gl" ? host::make_gl_canvas(instances, options_) : any_canvas(machine_, instances, options_);
    } catch (const host::DeviceLost&) {
        throw;
    } catch (const host::DeviceError& error) {
        throw UsageError(error.what());
    }
}

void Drawing::update() {
    if (!canvas_ || arrangements_ != world_.arrangements()) {
        canvas_.reset();
        canvas_ = make_canvas();
        arrangements_ = world_.arrangements();
        colors_ = colors_of(world_.scene());
    }
    host::BodyTables tables = from_device_       ? tables_on_device(world_.runner())
                              : shown_.count > 0 ? tables_of_copies(world_.state().poses)
                                                 : tables_of(world_.state());
    tables.colors = colors_;
    contacts_ = tables.touch_count;
    canvas_->set_tables(tables);
}

void Drawing::update(const std::vector<physics::Pose>& poses) {
    update();
    host::BodyTables tables = shown_.count > 0 ? tables_of_copies(poses) : tables_of(world_.state());
    if (shown_.count == 0) tables.poses = poses;
    tables.colors = colors_;
    canvas_->set_tables(tables);
}

// Contacts and joints of copies that are not shown have no points, and are broken.
host::BodyTables Drawing::tables_of_copies(const std::vector<physics::Pose>& poses) {
    const State& state = world_.state();
    host::BodyTables tables = tables_of(state);
    poses_ = poses;
    bounds_ = state.bounds;
    contacts_shown_.assign(state.contacts.begin(), state.contacts.begin() + tables.touch_count);
    for (std::uint32_t row = 0; row < poses_.size(); ++row) {
        const vec3 offset = shown_.offset(state.copy_of(row));
        poses_[row].position += offset;
        if (row >= bounds_.size()) continue;
        bounds_[row].lower += offset;
        bounds_[row].upper += offset;
    }
    for (physics::Contact& contact : contacts_shown_)
        if (!shown_.shows(state.copy_of(contact.a))) contact.count = 0;
    joints_ = state.joints;
    for (physics::Joint& joint : joints_) {
        const physics::uint body = joint.a != physics::NONE ? joint.a : joint.b;
        if (body != physics::NONE && !shown_.shows(state.copy_of(body))) joint.broken = 1;
    }
    tables.poses = poses_;
    tables.bounds = bounds_;
    tables.touches = contacts_shown_;
    tables.joints = joints_;
    return tables;
}

std::uint32_t Drawing::contacts() const {
    return contacts_;
}

vec3 Drawing::position_of(std::size_t body) const {
    const std::size_t row = world_.row_of(body);
    return from_device_ ? position_on_device(world_.runner(), row) : world_.state().poses[row].position;
}

}  // namespace scree::demos
