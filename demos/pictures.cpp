// Drawing a run through the canvas.
#include "demos/pictures.h"

#include <fmt/format.h>

#include <chrono>

#include "compute/device_runner.h"
#include "compute/state.h"
#include "demos/camera.h"
#include "demos/color_range.h"
#include "demos/failure.h"
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

// Adds the time that the work takes, s.
template <class Work>
decltype(auto) timed(double& seconds, Work&& work) {
    struct Watch {
        double& seconds;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Watch() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
    } const watch{seconds};
    return work();
}

host::BodyTables tables_of(const DeviceRunner& runner, std::uint32_t contacts) {
    return {&runner.traits(), &runner.poses(), &runner.velocities(), &runner.contacts(), &runner.impulses(), contacts};
}

host::BodyTables tables_of(const State& state) {
    const std::uint32_t contacts = state.counted().contacts;
    return {state.traits,
            state.poses,
            state.velocities,
            std::span(state.contacts).first(contacts),
            std::span(state.impulses).first(contacts),
            contacts};
}

host::ColorScale scale_of(const PictureOptions& options, const Subject& subject) {
    host::ColorScale scale;
    scale.by = host::color_by_named(options.color).value();
    scale.map = host::color_map_named(options.color_map).value();
    std::tie(scale.low, scale.high) = options.color_range.value_or(color_range(subject, options.color));
    return scale;
}

host::CanvasOptions canvas_of(const PictureOptions& options, const World& world) {
    host::CanvasOptions canvas;
    canvas.width = options.width;
    canvas.height = options.height;
    canvas.bits = options.bits;
    canvas.legend = options.legend;
    canvas.marks = options.shows_contacts();
    // What a body's weight gives it in a substep.
    const Settings& settings = world.settings();
    const float weight = glm::length(world.scene().gravity) / (settings.rate * static_cast<float>(settings.substeps));
    if (weight > 0) canvas.mark_push = weight;
    return canvas;
}

}  // namespace

struct Pictures::Interior {
    World& world;
    DeviceRunner* runner;  // null on the processor
    std::shared_ptr<host::Device> device;
    std::unique_ptr<host::Canvas> canvas;
    std::unique_ptr<host::FrameWriter> writer;
    CameraMan camera;
    host::ColorScale scale;
    std::string name;
    vec3 low, high;
    double fps;
    bool shows_contacts;
    PictureTimes times;

    host::BodyTables tables() const {
        return runner ? tables_of(*runner, shows_contacts ? contact_count() : 0) : tables_of(world.state());
    }
    std::uint32_t contact_count() const {
        if (!runner) return world.state().counted().contacts;
        physics::Counts counts{};
        runner->counts().read(&counts, sizeof counts);
        return counts.contacts;
    }
    vec3 followed_position() {
        const std::optional<std::size_t> body = camera.followed();
        if (!body) return vec3(0);
        if (!runner) return world.bodies()[*body].position;
        physics::Pose pose{};
        runner->poses().read(&pose, sizeof pose, *body * sizeof pose);
        return pose.position;
    }
    std::string caption() const {
        const std::string contacts = shows_contacts ? fmt::format("{} contacts, ", contact_count()) : "";
        return fmt::format("{}\n{} bodies, {}{:.2f} s", name, world.scene().bodies.size(), contacts, world.time());
    }
};

Pictures::Pictures(const PictureOptions& options, const Machine& machine, const Subject& subject, World& world)
    : interior_(
          new Interior{world,
                       dynamic_cast<DeviceRunner*>(&world.runner()),
                       device_for_pictures(machine),
                       nullptr,
                       nullptr,
                       CameraMan(options.camera, subject, static_cast<float>(options.width) / static_cast<float>(options.height)),
                       scale_of(options, subject),
                       subject.name,
                       subject.low,
                       subject.high,
                       options.fps,
                       options.shows_contacts(),
                       {}}) {
    Interior& in = *interior_;
    host::FrameWriterOptions writer;
    writer.folder = options.frames;
    writer.video = options.video;
    writer.preview = options.preview;
    writer.raw = options.raw;
    writer.frames_per_second = options.fps;
    writer.width = options.width;
    writer.height = options.height;
    writer.bits = options.bits;
    in.writer = std::make_unique<host::FrameWriter>(writer);
    in.canvas = host::make_vulkan_canvas(in.device, instances_of(world.scene()), canvas_of(options, world));
}

Pictures::~Pictures() = default;

void Pictures::after_step() {
    Interior& in = *interior_;
    // The picture of moment n / fps is taken at the nearest step.
    const double half_step = 0.5 / in.world.settings().rate;
    if (in.world.time() + half_step <= in.writer->frames() / in.fps) return;
    host::Image picture = timed(in.times.draw, [&] {
        in.canvas->set_tables(in.tables());
        const host::Camera camera = in.camera.at(in.world.time(), in.followed_position());
        return in.canvas->draw(camera, in.scale, in.caption(), in.low, in.high);
    });
    timed(in.times.encode_wait, [&] { in.writer->add(std::move(picture)); });
}

void Pictures::finish() {
    timed(interior_->times.encode_wait, [&] { interior_->writer->finish(); });
}

PictureTimes Pictures::times() const {
    return interior_->times;
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
