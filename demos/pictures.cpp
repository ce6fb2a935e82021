// Drawing a run through the canvas.
#include "demos/pictures.h"

#include <fmt/format.h>

#include "compute/device_runner.h"
#include "demos/color_range.h"
#include "host/canvas.h"
#include "host/frame_writer.h"
#include "shaders/physics/records.h"

namespace scree::demos {

namespace {

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

// What a canvas reads of a body that the processor simulates.
physics::Traits traits_of(const Body& body) {
    physics::Traits traits{};
    traits.shape = static_cast<std::uint32_t>(body.shape.index());  // as SHAPE_*
    traits.motion = static_cast<std::uint32_t>(body.motion);        // as MOTION_*
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) traits.size = vec3(sphere->radius, 0, 0);
    if (const auto* capsule = std::get_if<Capsule>(&body.shape)) traits.size = vec3(capsule->radius, capsule->half_height, 0);
    if (const auto* box = std::get_if<Box>(&body.shape)) traits.size = box->half_extents;
    if (const auto* plane = std::get_if<Plane>(&body.shape)) traits.size = plane->normal;
    if (body.motion != Motion::dynamic) return traits;
    const MassProperties mass = mass_properties(body.shape, body.density);
    traits.inverse_mass = 1 / mass.mass;
    traits.inverse_inertia = 1.0f / mass.inertia;
    return traits;
}

// The bodies of a world on the processor, copied to a device to be drawn.
struct Copies {
    host::Buffer traits, poses, velocities;

    Copies(const std::shared_ptr<host::Device>& device, const Scene& scene) {
        const std::size_t count = scene.bodies.size();
        traits = host::Buffer(device, "drawn traits", std::max<std::size_t>(count, 1) * sizeof(physics::Traits));
        poses = host::Buffer(device, "drawn poses", std::max<std::size_t>(count, 1) * sizeof(physics::Pose));
        velocities = host::Buffer(device, "drawn velocities", std::max<std::size_t>(count, 1) * sizeof(physics::Velocity));
        std::vector<physics::Traits> values;
        values.reserve(count);
        for (const Body& body : scene.bodies) values.push_back(traits_of(body));
        if (count) traits.write(values.data(), count * sizeof(physics::Traits));
    }
    void update(const World& world) {
        const std::vector<BodyState> bodies = world.bodies();
        std::vector<physics::Pose> at(bodies.size());
        std::vector<physics::Velocity> moving(bodies.size());
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const auto* plane = std::get_if<Plane>(&world.scene().bodies[i].shape);
            at[i] = {plane ? plane->normal * plane->offset : bodies[i].position, 0, bodies[i].orientation};
            moving[i] = {bodies[i].velocity, 0, bodies[i].angular_velocity, 0};
        }
        if (bodies.empty()) return;
        poses.write(at.data(), at.size() * sizeof(physics::Pose));
        velocities.write(moving.data(), moving.size() * sizeof(physics::Velocity));
    }
};

host::Camera camera_of(const Viewpoint& view) {
    host::Camera camera;
    camera.eye = view.eye;
    camera.target = view.target;
    camera.vertical_fov = view.vertical_fov;
    const vec3 along = view.target - view.eye;
    if (std::abs(along.y) > 0.999f * glm::length(along)) camera.up = {0, 0, -1};  // straight down or up
    return camera;
}

host::ColorScale scale_of(const PictureOptions& options, const Subject& subject) {
    host::ColorScale scale;
    scale.by = host::color_by_named(options.color).value();
    scale.map = host::color_map_named(options.color_map).value();
    std::tie(scale.low, scale.high) = options.color_range.value_or(color_range(subject, options.color));
    return scale;
}

}  // namespace

struct Pictures::Interior {
    World& world;
    DeviceRunner* runner;  // null on the processor
    std::shared_ptr<host::Device> device;
    std::optional<Copies> copies;
    std::optional<host::Canvas> canvas;
    std::unique_ptr<host::FrameWriter> writer;
    host::Camera camera;
    host::ColorScale scale;
    std::string name;
    vec3 low, high;
    double fps;

    host::BodyTables tables() {
        if (runner) return {&runner->traits(), &runner->poses(), &runner->velocities()};
        copies->update(world);
        return {&copies->traits, &copies->poses, &copies->velocities};
    }
};

Pictures::Pictures(const PictureOptions& options, const Machine& machine, const Subject& subject, World& world)
    : interior_(new Interior{world,
                             dynamic_cast<DeviceRunner*>(&world.runner()),
                             device_for_pictures(machine),
                             {},
                             {},
                             nullptr,
                             camera_of(subject.viewpoint),
                             scale_of(options, subject),
                             subject.name,
                             subject.low,
                             subject.high,
                             options.fps}) {
    Interior& in = *interior_;
    host::FrameWriterOptions writer;
    writer.folder = options.frames;
    writer.video = options.video;
    writer.frames_per_second = options.fps;
    writer.width = options.width;
    writer.height = options.height;
    in.writer = std::make_unique<host::FrameWriter>(writer);
    if (!in.runner) in.copies.emplace(in.device, world.scene());
    host::CanvasOptions canvas;
    canvas.width = options.width;
    canvas.height = options.height;
    canvas.legend = options.legend;
    in.canvas.emplace(in.device, instances_of(world.scene()), in.tables(), canvas);
}

Pictures::~Pictures() = default;

void Pictures::after_step() {
    Interior& in = *interior_;
    // The picture of moment n / fps is taken at the nearest step.
    const double half_step = 0.5 / in.world.settings().rate;
    if (in.world.time() + half_step <= in.writer->frames() / in.fps) return;
    in.canvas->set_tables(in.tables());
    const std::string caption = fmt::format("{}\n{} bodies, {:.2f} s", in.name, in.world.scene().bodies.size(), in.world.time());
    in.writer->add(in.canvas->draw(in.camera, in.scale, caption, in.low, in.high));
}

void Pictures::finish() {
    interior_->writer->finish();
}

int Pictures::count() const {
    return interior_->writer->frames();
}

const std::vector<std::string>& color_words() {
    return host::color_by_names();
}

const std::vector<std::string>& color_map_words() {
    return host::color_map_names();
}

}  // namespace scree::demos
