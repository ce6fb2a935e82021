// Pictures of a run.
#include "demos/film/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>

#include "compute/step/state.h"
#include "demos/film/camera.h"
#include "demos/film/color_range.h"
#include "demos/film/drawing.h"
#include "demos/program/exit_status.h"
#include "demos/program/option_parsing.h"
#include "host/canvas/canvas.h"
#include "host/pictures/frame_writer.h"
#include "shaders/physics/extra/sleep.h"

namespace scree::demos {

namespace {

// Adds the duration of the work, s.
template <class Work>
decltype(auto) timed(double& seconds, Work&& work) {
    struct Watch {
        double& seconds;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Watch() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
    } const watch{seconds};
    return work();
}

// Materials of the dynamic bodies by falling frequency, up to the number of distinct colours.
std::vector<host::Material> materials_of(const Scene& scene) {
    std::map<std::array<float, 3>, std::size_t> found;
    for (const Body& body : scene.bodies) {
        if (body.motion == Motion::dynamic) ++found[{body.friction, body.restitution, body.density}];
    }
    std::vector<std::pair<std::size_t, std::array<float, 3>>> sorted;
    for (const auto& [material, count] : found) sorted.emplace_back(count, material);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<host::Material> materials;
    for (std::size_t i = 0; i < std::min<std::size_t>(sorted.size(), 8); ++i) {
        const std::array<float, 3>& m = sorted[i].second;
        materials.push_back({{m[0], m[1], m[2]}, fmt::format("µ {:.3g}  e {:.3g}  {:.4g} kg/m³", m[0], m[1], m[2])});
    }
    return materials;
}

host::CanvasOptions canvas_of(const PictureOptions& options, const World& world) {
    host::CanvasOptions canvas;
    canvas.width = options.width;
    canvas.height = options.height;
    canvas.bits = options.bits;
    canvas.legend = options.legend;
    canvas.marks = options.shows("contacts");
    canvas.velocities = options.shows("velocities");
    canvas.boxes = options.shows("boxes");
    canvas.cells = options.shows("cells");
    canvas.joints = options.shows("joints");
    canvas.sleep = options.shows("sleep");
    const physics::Parameters& fixed = world.state().fixed();
    canvas.cell = fixed.cell;
    canvas.step_seconds = fixed.dt;
    canvas.sleep_steps = fixed.sleep_steps == physics::NO_SLEEP ? 0 : fixed.sleep_steps;
    // Velocity that gravity adds in a substep.
    const Settings& settings = world.settings();
    const float gravity = glm::length(world.scene().gravity);
    const float weight = gravity / (settings.rate * static_cast<float>(settings.substeps));
    if (weight > 0) canvas.mark_push = weight;
    if (gravity > 0) canvas.joint_pull = gravity;
    return canvas;
}

}  // namespace

host::ColorScale scale_of(const PictureOptions& options, const LoadedScene& subject, const Settings& settings) {
    host::ColorScale scale;
    scale.by = host::color_by_named(options.color).value();
    scale.map = host::color_map_named(options.color_map).value();
    std::pair<float, float> range = color_range(subject, settings, options.color);
    if (options.logarithmic) range = logarithmic_range(range);
    std::tie(scale.low, scale.high) = options.color_range.value_or(range);
    scale.logarithmic = options.logarithmic && host::has_scale(scale.by);
    if (scale.logarithmic && scale.low <= 0) {
        throw UsageError(
            fmt::format("--color-scale log: a logarithmic scale begins above 0, and the range begins at {:g}; say "
                        "--color-range LOW:HIGH",
                        scale.low));
    }
    if (scale.by == host::ColorBy::material) scale.materials = materials_of(subject.scene);
    return scale;
}

struct Pictures::Impl {
    World& world;
    std::optional<Drawing> drawing;
    std::unique_ptr<host::FrameWriter> writer;
    CameraMan camera;
    host::ColorScale scale;
    std::string name;
    vec3 low, high;
    double fps;
    bool captioned;
    PictureTimes times;
    int begun = 0;             // pictures
    int before = 0;            // of those, due before a resumed run
    bool drawing_one = false;  // the last one is being drawn, concurrently with later steps

    // Passes the pending picture to the encoders.
    void take() {
        if (!drawing_one) return;
        drawing_one = false;
        host::Image picture = timed(times.draw, [&] { return drawing->canvas().finish(); });
        timed(times.encode_wait, [&] { writer->add(std::move(picture)); });
    }

    std::string caption() const {
        if (!captioned) return "";
        return fmt::format("{} · {:.2f} s\n{}, {}\n{}", name, world.time(), counted(world.bodies_there(), "body", "bodies"),
                           counted(drawing->contacts(), "contact", "contacts"), world.runner().device());
    }
};

Pictures::Pictures(const PictureOptions& options, const Backend& machine, const LoadedScene& subject, World& world)
    : interior_(
          new Impl{world,
                   {},
                   nullptr,
                   CameraMan(options.camera, subject, static_cast<float>(options.width) / static_cast<float>(options.height)),
                   scale_of(options, subject, world.settings()),
                   subject.name,
                   subject.low,
                   subject.high,
                   options.fps,
                   options.caption,
                   {}}) {
    Impl& in = *interior_;
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
    in.drawing.emplace(options.canvas, machine, world, canvas_of(options, world));
    if (world.steps() > 0) {
        const double half_step = 0.5 / world.settings().rate;
        in.begun = in.before = static_cast<int>(std::ceil((world.time() + half_step) * in.fps));
    }
}

Pictures::~Pictures() = default;

void Pictures::after_step() {
    Impl& in = *interior_;
    // Picture n, due at n / fps, is drawn after the nearest step.
    const double half_step = 0.5 / in.world.settings().rate;
    if (in.world.time() + half_step <= in.begun / in.fps) return;
    in.take();
    timed(in.times.draw, [&] {
        in.drawing->update();
        const std::optional<std::size_t> body = in.camera.followed();
        const host::Camera camera = in.camera.at(in.world.time(), body ? in.drawing->position_of(*body) : vec3(0));
        in.drawing->canvas().begin(camera, in.scale, in.caption(), in.low, in.high);
    });
    in.drawing_one = true;
    ++in.begun;
    if (!in.drawing->beside_steps()) in.take();
}

void Pictures::finish() {
    interior_->take();
    timed(interior_->times.encode_wait, [&] { interior_->writer->finish(); });
}

PictureTimes Pictures::times() const {
    return interior_->times;
}

int Pictures::count() const {
    return interior_->begun - interior_->before;
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
