// A video of what the window shows.
#include "demos/program/window/film.h"

#include <utility>

#include "demos/film/pictures.h"
#include "demos/film/style.h"

namespace scree::demos {

namespace {

constexpr double pictures_a_second = 30;

host::FrameWriterOptions writer_for(const std::string& file, Extent extent) {
    host::FrameWriterOptions options;
    options.video = file;
    options.frames_per_second = pictures_a_second;
    options.width = extent.width;
    options.height = extent.height;
    return options;
}

host::CanvasOptions canvas_for(Extent extent, const PictureStyle& style, const World& world) {
    host::CanvasOptions canvas;
    canvas.width = extent.width;
    canvas.height = extent.height;
    show_overlays(style, world, canvas);
    show_light(style, canvas);
    return canvas;
}

}  // namespace

Film::Film(std::string file, Extent extent, const PictureStyle& style, const Backend& machine, World& world,
           std::uint64_t beginning)
    : file_(std::move(file)),
      writer_(writer_for(file_, extent)),
      drawing_("vulkan", machine, world, canvas_for(extent, style, world)),
      beginning_(beginning),
      next_(world.time()) {}

// A window that draws fewer pictures than that has each of them for as long as it was seen.
void Film::look(const World& world, const host::View& view) {
    if (world.time() < next_) return;
    drawing_.update();
    const host::Image image = drawing_.canvas().draw(view.camera, view.scale, view.caption, view.low, view.high);
    for (; next_ <= world.time(); next_ += 1 / pictures_a_second) writer_.add(image);
}

void Film::finish() {
    writer_.finish();
}

}  // namespace scree::demos
