// The window with its session, interaction, drawing and panel.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "demos/film/color_range.h"
#include "demos/film/drawing.h"
#include "demos/play/interaction.h"
#include "demos/program/backend.h"
#include "demos/program/options/options.h"
#include "demos/program/window/detail.h"
#include "demos/program/window/film.h"
#include "demos/program/window/panel.h"
#include "host/window/window.h"

namespace scree::demos {

struct ViewOptions {
    SceneOptions scene;
    MachineOptions machine;
    std::string size = "1280x720";
    Extent extent;
    PictureOptions pictures;  // --color and --show
    std::string record, report;
    float text_scale = 1;
};

// What a picture of the scene depends on, but for the window's size and overlays.
struct Shown {
    host::Camera camera;
    host::ColorScale scale;
    std::uint64_t step = 0, beginning = 0;
    std::size_t acts = 0;
    bool operator==(const Shown&) const = default;
};

class Viewer {
public:
    Viewer(const ViewOptions& options, const host::Display& display, Backend machine);
    void run();
    void write_report();
    void write_recordings();  // all that were not written yet, with that of the present world

private:
    bool is_over();
    void take_events(double wait);
    bool make_drawing();
    void press_key(const host::Event& event);
    void write_recording(const Input& input);
    void write_earlier();
    void choose_style();
    void measure_range(double seconds);
    void draw();
    void grant(const Wishes& wishes);
    void write_picture();
    void draw_film();
    void begin_or_end_film();
    void end_film();

    const ViewOptions& options_;
    Backend machine_;
    Session session_;
    Interaction interaction_;
    Panel panel_;
    host::Window window_;
    std::unique_ptr<Drawing> drawing_;
    std::uint64_t drawn_beginning_ = 0;
    Extent drawn_extent_{0, 0};
    std::vector<Overlay> drawn_overlays_;
    std::array<float, 3> drawn_light_{};
    PictureStyle style_;
    std::string styled_;  // the scene that style_ is of
    std::optional<host::ColorScale> scale_;
    PictureStyle scaled_;  // the style that scale_ is of
    MeasuredRange range_;
    double least_of_range_ = 0;  // so that what rests is not coloured by its last tremor
    double measured_ = 0;        // s since the range was looked at
    PictureDetail detail_;
    host::View view_;
    std::optional<Shown> drawn_;           // in the picture that the canvas has
    std::vector<std::string> recordings_;  // files, for the message at the end
    std::size_t earlier_ = 0;              // of the session's earlier recordings, those that are written
    std::unique_ptr<Film> film_;
    Rates rates_;
    std::uint64_t pictures_ = 0;
    std::optional<std::uint64_t> last_step_;  // step at which the window closes by itself
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace scree::demos
