// Drawing a run through the canvas.
#include "demos/pictures.h"

#include <fmt/format.h>

#include "demos/color_range.h"
#include "demos/drawing.h"
#include "host/canvas.h"
#include "host/frame_writer.h"

namespace scree::demos {

namespace {

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

host::CanvasOptions canvas_of(const PictureOptions& options, const World& world) {
    host::CanvasOptions canvas;
    canvas.width = options.width;
    canvas.height = options.height;
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
    std::optional<Drawing> drawing;
    std::unique_ptr<host::FrameWriter> writer;
    host::Camera camera;
    host::ColorScale scale;
    std::string name;
    vec3 low, high;
    double fps;
    bool shows_contacts;

    std::string caption() const {
        const std::string contacts = shows_contacts ? fmt::format("{} contacts, ", drawing->contacts()) : "";
        return fmt::format("{}\n{} bodies, {}{:.2f} s", name, world.scene().bodies.size(), contacts, world.time());
    }
};

Pictures::Pictures(const PictureOptions& options, const Machine& machine, const Subject& subject, World& world)
    : interior_(new Interior{world,
                             {},
                             nullptr,
                             camera_of(subject.viewpoint),
                             scale_of(options, subject),
                             subject.name,
                             subject.low,
                             subject.high,
                             options.fps,
                             options.shows_contacts()}) {
    Interior& in = *interior_;
    host::FrameWriterOptions writer;
    writer.folder = options.frames;
    writer.video = options.video;
    writer.frames_per_second = options.fps;
    writer.width = options.width;
    writer.height = options.height;
    in.writer = std::make_unique<host::FrameWriter>(writer);
    in.drawing.emplace(options.canvas, machine, world, canvas_of(options, world));
}

Pictures::~Pictures() = default;

void Pictures::after_step() {
    Interior& in = *interior_;
    // The picture of moment n / fps is taken at the nearest step.
    const double half_step = 0.5 / in.world.settings().rate;
    if (in.world.time() + half_step <= in.writer->frames() / in.fps) return;
    in.drawing->update();
    in.writer->add(in.drawing->canvas().draw(in.camera, in.scale, in.caption(), in.low, in.high));
}

void Pictures::finish() {
    interior_->writer->finish();
}

int Pictures::count() const {
    return interior_->writer->frames();
}

std::string Pictures::canvas() const {
    return interior_->drawing->canvas().name();
}

const std::vector<std::string>& color_words() {
    return host::color_by_names();
}

const std::vector<std::string>& color_map_words() {
    return host::color_map_names();
}

}  // namespace scree::demos
