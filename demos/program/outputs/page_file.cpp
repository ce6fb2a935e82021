// Pages of scree run.
#include "demos/program/outputs/page_file.h"

#include <utility>

#include "compute/tables/state.h"
#include "demos/film/camera.h"
#include "demos/film/pages/page_parts.h"
#include "demos/film/style.h"
#include "demos/program/exit_status.h"
#include "host/canvas/canvas.h"
#include "host/canvas/overlay.h"

namespace scree::demos {

namespace {

constexpr int usual_width = 1280, usual_height = 720;  // of pictures, for a camera that sees the whole scene

std::function<host::Camera(double)> camera_of(const PictureOptions& options, const LoadedScene& subject, const World& world) {
    constexpr auto width = static_cast<float>(usual_width), height = static_cast<float>(usual_height);
    const float strip = host::overlay_height(usual_width, usual_height, true, 3) / height;
    auto man = std::make_shared<CameraMan>(options.camera, subject, width / height, strip);
    return [man, &world](double seconds) {
        const std::optional<std::size_t> body = man->followed();
        return man->at(seconds, body ? world.state().poses[world.row_of(*body)].position : vec3(0));
    };
}

}  // namespace

PageOptions page_options(const PictureOptions& options, const LoadedScene& subject, World& world, bool rehearses) {
    PageOptions page;
    page.title = subject.title();
    page.fps = options.fps;
    page.style = style_of(options, subject.style);
    take_look(page, subject, world.settings(), rehearses);
    page.camera = camera_of(options, subject, world);
    page.events = world.runner().ranks() == nullptr;
    page.contacts = shows(page.style, Overlay::contacts) || world.scene().bodies.size() <= most_with_contacts;
    return page;
}

std::unique_ptr<PageRecording> make_page(const PictureOptions& options, const CopiesShown& shown, const LoadedScene& subject,
                                         World& world) {
    if (!PageRecording::is_possible()) throw UsageError("--html: " + PageRecording::why_not());
    PageOptions page = page_options(options, subject, world);
    page.shown = shown;
    return std::make_unique<PageRecording>(options.html, world, std::move(page));
}

}  // namespace scree::demos
