// Where a world is drawn: the choice between the two canvases, and the tables that the chosen one draws from.
#include "demos/drawing.h"

#include <span>

#include "compute/state.h"
#include "demos/failure.h"
#include "host/device_error.h"

namespace scree::demos {

host::ShapeInstances instances_of(const Scene& scene) {
    host::ShapeInstances instances;
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        // In the order of Shape's alternatives.
        std::vector<std::uint32_t>* const lists[] = {&instances.spheres, &instances.capsules, &instances.boxes,
                                                     &instances.planes};
        lists[scene.bodies[i].shape.index()]->push_back(i);
    }
    return instances;
}

host::BodyTables tables_of(const State& state) {
    const std::uint32_t contacts = state.counted().contacts;
    host::BodyTables tables{state.traits,
                            state.poses,
                            state.velocities,
                            std::span(state.contacts).first(contacts),
                            std::span(state.impulses).first(contacts),
                            contacts};
    tables.slot_ends = state.slot_ends;
    tables.slot_sides = state.slot_sides;
    tables.rests = state.rests;
    tables.bounds = state.bounds;
    return tables;
}

namespace {

// On whatever is there. OpenGL ES first: a processor draws a frame in 5% less time than with Vulkan (llvmpipe and lavapipe, 3,000
// bodies at 1280x720).
std::unique_ptr<host::Canvas> any_canvas(const Machine& machine, const host::ShapeInstances& instances,
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

Drawing::Drawing(const std::string& canvas, const Machine& machine, World& world, const host::CanvasOptions& options)
    : world_(world), word_(canvas), machine_(machine), options_(options) {
    from_device_ = (canvas == "vulkan" || canvas == "auto") && machine.device;
    update();
}

std::unique_ptr<host::Canvas> Drawing::make_canvas() const {
    const host::ShapeInstances instances = instances_of(world_.scene());
    try {
        if (word_ == "vulkan" || from_device_) return make_vulkan_canvas(machine_, instances, options_);
        return word_ == "gl" ? host::make_gl_canvas(instances, options_) : any_canvas(machine_, instances, options_);
    } catch (const host::DeviceError& error) {
        throw UsageError(error.what());
    }
}

void Drawing::update() {
    if (!canvas_ || bodies_ != world_.scene().bodies.size()) {
        canvas_.reset();
        canvas_ = make_canvas();
        bodies_ = world_.scene().bodies.size();
    }
    const host::BodyTables tables = from_device_ ? tables_on_device(world_.runner()) : tables_of(world_.state());
    contacts_ = tables.touch_count;
    canvas_->set_tables(tables);
}

std::uint32_t Drawing::contacts() const {
    return contacts_;
}

vec3 Drawing::position_of(std::size_t body) const {
    return from_device_ ? position_on_device(world_.runner(), body) : world_.state().poses.at(body).position;
}

}  // namespace scree::demos
