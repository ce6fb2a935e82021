// Pictures of a run.
#include "demos/film/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>

#include "compute/distributed/ranks.h"
#include "compute/scene_file/hex_color.h"
#include "compute/tables/state.h"
#include "demos/film/annotations.h"
#include "demos/film/camera.h"
#include "demos/film/camera_track.h"
#include "demos/film/channel_writer.h"
#include "demos/film/drawing.h"
#include "demos/film/motion_blur.h"
#include "demos/film/rank_parts.h"
#include "demos/film/style.h"
#include "demos/program/options/option_parsing.h"
#include "host/canvas/canvas.h"
#include "host/canvas/overlay.h"
#include "host/files/file.h"
#include "host/pictures/frame_writer.h"
#include "shaders/physics/sleep/sleep.h"

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

int factor_of(const PictureOptions& options) {
    return static_cast<int>(std::lround(std::sqrt(options.samples)));
}

}  // namespace

void show_overlays(const PictureStyle& style, const World& world, host::CanvasOptions& canvas) {
    canvas.marks = shows(style, Overlay::contacts);
    canvas.velocities = shows(style, Overlay::velocities);
    canvas.boxes = shows(style, Overlay::boxes);
    canvas.cells = shows(style, Overlay::cells);
    canvas.joints = shows(style, Overlay::joints);
    canvas.sleep = shows(style, Overlay::sleep);
    canvas.parts = shows(style, Overlay::parts);
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
}

namespace {

host::CanvasOptions canvas_of(const PictureOptions& options, const PictureStyle& style, const World& world) {
    host::CanvasOptions canvas;
    canvas.width = options.width * factor_of(options);
    canvas.height = options.height * factor_of(options);
    canvas.bits = options.drawn_bits();
    canvas.background = options.background == "sky";
    if (const auto color = color_of_hex(options.background)) canvas.backdrop = host::linear_from_srgb(*color);
    canvas.legend = options.legend;
    canvas.smooth = options.samples == 1;  // averaged pictures are smooth
    show_overlays(style, world, canvas);
    show_light(style, canvas);
    return canvas;
}

bool can_be_parts(const PictureOptions& options, const LoadedScene& subject, World& world) {
    if (style_of(options, subject.style).color == ShownQuantity::own) return false;  // ranks do not have them
    return world.runner().ranks() && options.canvas != "vulkan" && options.shutter == 0 && options.channels.empty() &&
           options.annotations.empty() && options.background == "sky";
}

// All ranks draw with one sample a pixel, as parts of pictures are, so that pictures of the whole world look alike.
host::CanvasOptions canvas_for(const PictureOptions& options, const LoadedScene& subject, World& world) {
    host::CanvasOptions canvas = canvas_of(options, style_of(options, subject.style), world);
    if (can_be_parts(options, subject, world)) canvas.samples = 1;
    return canvas;
}

constexpr int CAPTION_LINES = 3;

// A fitted scene is above legend and caption.
CameraMan camera_of(const PictureOptions& options, const LoadedScene& subject) {
    const float strip = host::overlay_height(options.width, options.height, options.legend, options.caption ? CAPTION_LINES : 0);
    const auto width = static_cast<float>(options.width), height = static_cast<float>(options.height);
    return {options.camera, subject, width / height, std::min(strip / height, 0.4f)};
}

}  // namespace

struct Pictures::Impl {
    World& world;
    std::optional<Drawing> drawing;
    std::unique_ptr<host::FrameWriter> writer;
    CameraMan camera;
    host::ColorScale scale;
    std::string name;
    vec3 low, high;
    double fps;
    double from;                  // s, of the first picture
    std::optional<double> until;  // of the last
    bool captioned;
    int factor;  // by which pictures are drawn larger
    CameraTrack track;
    std::string cameras;  // file; may be empty
    std::optional<ChannelWriter> channels;
    std::optional<DrawnLabels> labels{};   // of `drawing`
    std::vector<host::ExrLayer> layers{};  // of the picture that is being drawn
    std::unique_ptr<Annotations> annotations{};
    PictureTimes times;
    std::optional<PastPoses> past{};  // for motion blur
    double shutter = 0;               // s
    int blurred = 0;                  // pictures that are averaged
    int begun = 0;                    // pictures
    int before = 0;                   // of those, due before a resumed run
    bool drawing_one = false;         // the last one is being drawn, concurrently with later steps
    std::function<void()> make_drawing{};
    std::unique_ptr<PartDrawing> part{};  // on several ranks
    bool is_first() const {
        const Ranks* ranks = world.runner().ranks();
        return !ranks || ranks->exchange().rank() == 0;
    }

    host::Image finished() {
        host::Image drawn = drawing->canvas().finish();
        return factor > 1 ? host::reduced(drawn, factor) : std::move(drawn);
    }

    // Passes the pending picture to the encoders.
    void take() {
        if (!drawing_one) return;
        drawing_one = false;
        host::Image picture = timed(times.draw, [&] { return finished(); });
        timed(times.encode_wait, [&] { writer->add(std::move(picture), std::move(layers)); });
    }

    void draw(const host::Camera& view) {
        drawing->canvas().begin(view, scale, caption(), low, high);
        drawing_one = true;
    }

    // The mean of pictures of moments while the shutter was open, which it is until now.
    void draw_blurred(const host::Camera& view) {
        host::MeanImage mean;
        for (int i = 0; i < blurred; ++i) {
            drawing->update(past->at(shutter * (i + 0.5) / blurred));
            drawing->canvas().begin(view, scale, caption(), low, high);
            mean.add(finished());
        }
        timed(times.encode_wait, [&] { writer->add(mean.image(), std::move(layers)); });
    }

    // A part of a picture, on every rank.
    void draw_part() {
        take();
        labels.reset();
        drawing.reset();  // of the whole world
        const PartDrawing::Moment moment = part->look(camera.followed());
        const host::Camera view = camera.at(world.time(), moment.followed);
        if (!cameras.empty()) track.add(world.time(), view);
        host::Image drawn = part->draw(view, scale, is_first() ? caption(moment.contacts) : "", low, high);
        if (!is_first()) return;
        if (factor > 1) drawn = host::reduced(drawn, factor);
        timed(times.encode_wait, [&] { writer->add(std::move(drawn)); });
    }

    std::string caption() const { return caption(drawing->contacts()); }
    std::string caption(std::uint32_t contacts) const {
        if (!captioned) return "";
        const std::string copies = world.copies() > 1 ? fmt::format("{} copies, ", world.copies()) : "";
        return fmt::format("{} · {:.2f} s\n{}{}, {}\n{}", name, world.time(), copies,
                           counted(world.bodies_there(), "body", "bodies"), counted(contacts, "contact", "contacts"),
                           world.runner().device());
    }
};

Pictures::Pictures(const PictureOptions& options, const Backend& machine, const LoadedScene& subject, World& world,
                   const CopiesShown& shown)
    : interior_(new Impl{world,
                         {},
                         nullptr,
                         camera_of(options, subject),
                         scale_of(style_of(options, subject.style), subject, world.settings()),
                         subject.title(),
                         subject.low,
                         subject.high,
                         options.fps,
                         options.from,
                         options.until,
                         options.caption,
                         factor_of(options),
                         CameraTrack(options.width, options.height),
                         options.cameras,
                         {},
                         {},
                         {}}) {
    Impl& in = *interior_;
    host::FrameWriterOptions writer;
    writer.folder = folder_of_frames(options);
    writer.name = name_of_frames(options);
    writer.video = options.video;
    writer.preview = options.preview;
    writer.raw = options.raw;
    writer.frames_per_second = options.fps;
    writer.width = options.width;
    writer.height = options.height;
    writer.bits = options.drawn_bits();
    writer.exr = options.frame_files == "exr";
    writer.alpha = options.background == "none";
    writer.overwrite = options.overwrite;
    const host::CanvasOptions canvas = canvas_for(options, subject, world);
    if (can_be_parts(options, subject, world)) in.part = PartDrawing::make(world, canvas);
    in.make_drawing = [&in, canvas, machine, shown, word = in.part ? "gl" : options.canvas, from_host = options.shutter > 0] {
        in.labels.reset();
        in.drawing.emplace(word, machine, in.world, canvas, shown, from_host);
        in.labels.emplace(in.world, *in.drawing, canvas.parts);
    };
    if (in.is_first()) in.writer = std::make_unique<host::FrameWriter>(writer);
    if (in.is_first() && !in.part) in.make_drawing();
    if (!in.is_first()) in.cameras.clear();
    in.shutter = static_cast<double>(options.shutter) / in.fps;
    in.blurred = options.shutter_samples;
    if (options.shutter > 0) in.past.emplace(in.shutter);
    if (!options.channels.empty() && in.is_first()) in.channels.emplace(options, world);
    if (in.is_first()) in.annotations = make_annotations(options);
    if (world.steps() > 0) {
        const double half_step = 0.5 / world.settings().rate;
        in.begun = in.before = std::max(0, static_cast<int>(std::ceil((world.time() + half_step - in.from) * in.fps)));
    }
}

Pictures::~Pictures() = default;

void Pictures::after_step() {
    Impl& in = *interior_;
    const bool shares = in.world.runner().ranks() != nullptr;
    if (in.past && shares) (void)in.world.state();
    if (in.past && in.is_first()) in.past->keep(in.world);
    // Picture n, due at n / fps, is drawn after the nearest step.
    const double half_step = 0.5 / in.world.settings().rate;
    const double due = in.from + in.begun / in.fps;
    if (in.world.time() + half_step <= due || (in.until && due > *in.until + 1e-9)) return;
    if (in.part) in.world.share_out();
    if (in.part && in.world.share()) {
        timed(in.times.draw, [&] { in.draw_part(); });
        ++in.begun;
        return;
    }
    if (shares) (void)in.world.state();  // on all ranks, for the first
    if (!in.is_first()) {
        const std::optional<std::size_t> body = in.camera.followed();
        (void)in.camera.at(in.world.time(), body ? in.world.state().poses[in.world.row_of(*body)].position : vec3(0));
        ++in.begun;
        return;
    }
    in.take();
    timed(in.times.draw, [&] {
        if (!in.drawing) in.make_drawing();
        in.drawing->update();
        const std::optional<std::size_t> body = in.camera.followed();
        const host::Camera camera = in.camera.at(in.world.time(), body ? in.drawing->position_of(*body) : vec3(0));
        if (!in.cameras.empty()) in.track.add(in.world.time(), camera);
        if (!in.past) in.draw(camera);
        if (in.channels) in.layers = in.channels->add(*in.labels, camera);
        if (in.annotations) in.annotations->add(*in.labels, camera);
        if (in.past) in.draw_blurred(camera);
    });
    ++in.begun;
    if (!in.drawing->beside_steps()) in.take();
}

void Pictures::finish() {
    if (!interior_->is_first()) return;
    interior_->take();
    timed(interior_->times.encode_wait, [&] { interior_->writer->finish(); });
    if (interior_->annotations) interior_->annotations->finish();
    if (!interior_->cameras.empty()) host::write_atomically(interior_->cameras, interior_->track.json());
}

PictureTimes Pictures::times() const {
    return interior_->times;
}

int Pictures::count() const {
    return interior_->begun - interior_->before;
}

std::string Pictures::canvas() const {
    if (interior_->part) return interior_->part->canvas();
    return interior_->drawing ? interior_->drawing->canvas().name() : "";
}

}  // namespace scree::demos
