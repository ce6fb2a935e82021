// The window's panel: clock, rates, settings, overlays, graphs, and data of the selected body.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/film/style.h"
#include "demos/play/contact_points.h"
#include "demos/play/history.h"
#include "demos/play/interaction.h"
#include "demos/program/window/file_chooser.h"
#include "host/canvas/colors.h"

namespace scree::demos {

struct Rates {
    double steps = 0;     // steps per second of wall clock
    double pictures = 0;  // pictures per second
    double step_ms = 0;   // time of a step
};

// What the panel asks of the window.
struct Wishes {
    bool picture = false;    // write the next picture to a file
    bool film = false;       // begin a video, or end it
    bool recording = false;  // write the recording so far
};

class Panel {
public:
    // Lays out the panel and the marks over the picture in Dear ImGui's current frame. The user may change `style`.
    Wishes lay_out(Session& session, Interaction& interaction, const Rates& rates, PictureStyle& style);
    // Legend and caption over the picture, at the size of the window (panel_overlay.cpp).
    void lay_out_legend(const host::ColorScale& scale, const std::string& caption) const;
    void tell(std::string message);  // shown for a while

    // Escape: whether it ends an edit, or closes a list, the chooser of files or the help.
    bool closes_something(bool edits_text);

    bool shown = true;
    bool help_shown = false;
    float text_scale = 1;
    bool filming = false;  // a video is being written
    FileChooser chooser;

private:
    struct Coefficients {
        float friction = 0, restitution = 0, rolling = 0, mass = 0;  // rolling resistance in m; kg, 0: none
    };
    struct JointOfBody {
        std::size_t index = 0, other = 0;  // joint; the other body, or the_world
        float force = 0;                   // N
    };

    void show_clock(Session& session, Interaction& interaction, const Rates& rates);
    void show_timeline(Session& session, Interaction& interaction);
    void show_dials(Session& session, Interaction& interaction);
    void show_overlays(PictureStyle& style);
    void show_additions(Interaction& interaction, Wishes& wishes);
    void show_light(PictureStyle& style);
    void show_chooser(Interaction& interaction);
    // panel_edit.cpp: the selected body, and joining
    void show_joining(Interaction& interaction);
    void show_body_edits(Session& session, Interaction& interaction, std::size_t body);
    void show_joints(Session& session, Interaction& interaction);
    const Coefficients& at_first(const Session& session, std::size_t body);
    std::optional<float> edits(const char* label, float now, float by_default, float low, float high, const char* form,
                               bool logarithmic);
    void show_selected(Session& session, Interaction& interaction);
    void show_vehicle(Session& session, Interaction& interaction);
    void show_graphs(Session& session, Interaction& interaction, const Rates& rates);
    void show_compared(const Session& session, std::optional<std::size_t> selected);
    void write_graphs(const Session& session);
    // panel_overlay.cpp
    void show_messages(const Interaction& interaction) const;
    void show_help();
    // panel_marks.cpp: lines over the picture
    void show_marks(Session& session, Interaction& interaction);
    void show_pull(Interaction& interaction) const;
    void show_outline(const World& world, const Interaction& interaction, std::size_t body, unsigned color) const;
    void show_first_point(const World& world, const Interaction& interaction) const;
    void show_forces(const World& world, const Interaction& interaction) const;
    void show_hovered(Session& session, Interaction& interaction);
    void look_at(const World& world, std::size_t body);

    std::vector<ContactPoint> points_;  // contacts of the selected body, updated several times per second
    std::vector<JointOfBody> joints_;   // of the selected body, likewise
    double looked_at_ = -1;             // time of the update, s of Dear ImGui's clock
    std::optional<std::size_t> looked_body_;
    std::optional<std::size_t> hovered_;  // body under the pointer, and what is said of it; updated likewise
    std::string hovered_text_;
    double hovered_at_ = -1;
    History history_, compared_history_;  // of the selected body or the world; of the body that it is compared with
    std::optional<std::size_t> compared_;
    std::string compared_scene_;      // its title
    std::optional<int> wanted_step_;  // of the timeline, while it is dragged
    std::string told_;
    double told_at_ = 0;  // s of Dear ImGui's clock
    bool graphs_shown_ = false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Coefficients> first_;  // by handle of the body
    std::uint64_t first_beginning_ = 0;
    std::string dragged_label_;  // the slider that is being dragged, and its value
    float dragged_ = 0;
    bool list_open_ = false;
    std::size_t joined_ = 0;
};

std::string name_of(const Scene& scene, std::size_t body);  // "box 17 \"brick\""

}  // namespace scree::demos
