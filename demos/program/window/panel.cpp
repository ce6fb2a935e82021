// The window's panel, in Dear ImGui.
#include "demos/program/window/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compute/scene_file/picture_style_fields.h"
#include "demos/program/options/units.h"
#include "demos/program/window/widgets.h"
#include "demos/scenes/demos.h"

namespace scree::demos {

namespace {

constexpr float snaps_to_zero = 1.5f;  // m/s^2, of the slider of gravity, whose upper half lets things fall up

void choose_demo(Session& session, Interaction& interaction) {
    const std::string& name = session.subject().name;
    if (!begin_list("scene", session.subject().title())) return;
    for (const Demo& demo : all_demos()) {
        if (demo.trial) continue;
        if (ImGui::Selectable(demo.name, name == demo.name)) interaction.open(demo.name);
        if (ImGui::IsItemHovered()) show_tooltip(demo.line);
    }
    ImGui::EndCombo();
}

void choose_color(PictureStyle& style) {
    if (choose("colour", color_words(), style.color)) {
        style.scale = ShownScale::automatic;
        style.range = glm::vec2(0);
    }
    choose("map", color_map_words(), style.map);
}

}  // namespace

std::string name_of(const Scene& scene, std::size_t body) {
    const Body& b = scene.bodies[body];
    std::string shape = shape_name(b.shape);
    std::replace(shape.begin(), shape.end(), '_', ' ');
    return fmt::format("{} {}{}", shape, body, b.name.empty() ? "" : " \"" + b.name + "\"");
}

void Panel::show_clock(Session& session, Interaction& interaction, const Rates& rates) {
    const World& world = session.world();
    say_line(fmt::format("{:.2f} s, {} steps, {} bodies", world.time(), world.steps(), world.bodies_there()));
    say_line(
        fmt::format("{:.1f} steps/s ({:g} is real time), {:.1f} pictures/s", rates.steps, world.settings().rate, rates.pictures));
    if (ImGui::Button(interaction.paused ? "Go on (P)" : "Pause (P)")) interaction.paused = !interaction.paused;
    ImGui::SameLine();
    if (ImGui::Button("Step (.)")) interaction.step_once();
    ImGui::SameLine();
    if (ImGui::Button("Again (R)")) interaction.reset();
    ImGui::SameLine();
    if (ImGui::Button("Undo (Ctrl+Z)")) interaction.undo();
    ImGui::SliderFloat("pace", &interaction.pace, 1.0f / 16, 1, "%.3f x", ImGuiSliderFlags_AlwaysClamp);
    resets("pace", interaction.pace, 1.0f);
    show_timeline(session, interaction);
}

// Going back plays the recorded commands again from the start, to the same bits; going on from there is a new branch.
void Panel::show_timeline(Session& session, Interaction& interaction) {
    const int last = static_cast<int>(session.farthest_step());
    if (last == 0) return;
    const float rate = session.world().settings().rate;
    int at = wanted_step_.value_or(static_cast<int>(session.world().steps()));
    const std::string text = fmt::format("{:.2f} s", static_cast<float>(at) / rate);
    if (ImGui::SliderInt("time", &at, 0, last, text.c_str(), ImGuiSliderFlags_AlwaysClamp)) wanted_step_ = at;
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        show_tooltip("Drag to go back to a moment; what happens from there is a new branch.");
    if (!wanted_step_ || ImGui::IsItemActive()) return;
    interaction.go_to(static_cast<std::uint64_t>(*wanted_step_));
    wanted_step_.reset();
}

void Panel::show_dials(Session& session, Interaction& interaction) {
    const World& world = session.world();
    const Settings of_scene = session.subject().settings(session.options());
    vec3 gravity = world.scene().gravity;
    float factor = world.settings().friction_factor, least = world.settings().least_restitution;
    int substeps = world.settings().substeps;
    bool sleeping = world.settings().sleeping;
    Turn turn;
    const auto slider = [](const char* label, float& value, float low, float high, const char* form, float by_default) {
        const bool moved = ImGui::SliderFloat(label, &value, low, high, form, ImGuiSliderFlags_AlwaysClamp);
        return resets(label, value, by_default) || moved;
    };
    if (slider("gravity", gravity.y, -30, 30, "%.2f m/s^2", session.subject().scene.gravity.y)) {
        if (std::abs(gravity.y) < snaps_to_zero) gravity.y = 0;
        turn.gravity = gravity;
    }
    if (slider("friction", factor, 0, 3, "%.2f x", of_scene.friction_factor)) turn.friction_factor = factor;
    if (slider("restitution", least, 0, 1, "at least %.2f", of_scene.least_restitution)) turn.least_restitution = least;
    const bool moved = ImGui::SliderInt("substeps", &substeps, 1, 32, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (resets("substeps", substeps, of_scene.substeps) || moved) turn.substeps = substeps;
    if (ImGui::Checkbox("bodies at rest sleep", &sleeping)) turn.sleeping = sleeping;
    if (turn.gravity || turn.friction_factor || turn.least_restitution || turn.substeps || turn.sleeping)
        interaction.perform(turn);
}

void Panel::show_overlays(PictureStyle& style) {
    for (std::size_t i = 0; i < overlay_words().size(); ++i) {
        const auto overlay = static_cast<Overlay>(i);
        bool on = shows(style, overlay);
        if (i % 3 != 0) ImGui::SameLine(static_cast<float>(i % 3) * ems(8.2f));
        if (ImGui::Checkbox((i < 6 ? fmt::format("{} ({})", overlay_words()[i], i + 4) : overlay_words()[i]).c_str(), &on))
            set_shown(style, overlay, on);
    }
}

void Panel::show_additions(Interaction& interaction, Wishes& wishes) {
    say_line("add a");
    for (const auto& [label, kind] :
         {std::pair("sphere (1)", Kind::sphere), {"capsule (2)", Kind::capsule}, {"box (3)", Kind::box}}) {
        ImGui::SameLine();
        if (ImGui::Button(label)) interaction.add(kind);
    }
    say_line("write a");
    ImGui::SameLine();
    wishes.picture = ImGui::Button("picture");
    ImGui::SameLine();
    wishes.film = ImGui::Button(filming ? "end video" : "video");
    ImGui::SameLine();
    wishes.recording = ImGui::Button("recording");
}

void Panel::show_vehicle(Session& session, Interaction& interaction) {
    const std::optional<std::size_t> which = interaction.vehicle();
    if (!which) return;
    const VehicleState now = session.world().vehicle(*which);
    const std::string& name = session.world().scene().vehicles[*which].name;
    say_line(fmt::format("{}: {} km/h{}", name.empty() ? fmt::format("vehicle {}", *which) : name,
                         whole(static_cast<double>(now.speed) * 3.6), now.by_route ? ", drives by itself" : ""));
    say_line("W S A D or arrows drive it, Space: hand brake");
    if (ImGui::Button("on its wheels")) interaction.reset_upright();
    ImGui::SameLine();
    ImGui::Checkbox("chase", &interaction.chases);
}

void Panel::show_light(PictureStyle& style) {
    if (!ImGui::TreeNodeEx("light", ImGuiTreeNodeFlags_None)) return;
    choose("sky", sky_words(), style.sky);
    float elevation = style.sun_elevation > 0 ? style.sun_elevation : 45;
    bool own = style.sun_elevation > 0;
    if (ImGui::Checkbox("sun stands at", &own)) style.sun_elevation = own ? elevation : 0;
    if (own) {
        if (ImGui::SliderFloat("height", &elevation, 3, 90, "%.0f deg", ImGuiSliderFlags_AlwaysClamp))
            style.sun_elevation = elevation;
        ImGui::SliderFloat("around", &style.sun_azimuth, -180, 180, "%.0f deg", ImGuiSliderFlags_AlwaysClamp);
        resets("around", style.sun_azimuth, 0.0f);
    }
    ImGui::TreePop();
}

void Panel::show_chooser(Interaction& interaction) {
    const std::optional<std::string> file = chooser.lay_out(interaction.message());
    if (!file) return;
    interaction.open(*file);
    if (interaction.message().empty()) chooser.hide();
}

bool Panel::closes_something(bool edits_text) {
    if (list_open_ && shown) return true;  // Dear ImGui gets the key, too
    if (chooser.shown()) {
        chooser.hide();
        return true;
    }
    if (edits_text) return true;  // a number that is being written
    return std::exchange(help_shown, false);
}

Wishes Panel::lay_out(Session& session, Interaction& interaction, const Rates& rates, PictureStyle& style) {
    Wishes wishes;
    show_marks(session, interaction);
    if (joined_ != interaction.joined()) set_shown(style, Overlay::joints, true);
    joined_ = interaction.joined();
    show_chooser(interaction);
    show_messages(interaction);
    show_help();
    if (!shown) return wishes;
    ImGui::SetNextWindowPos(ImVec2(8, 8), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.78f);
    ImGui::Begin("scree", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(ems(11.3f));
    ImGui::SetNextItemWidth(ems(8));  // the widest line: the panel leaves more than half of a window of 800 pixels free
    choose_demo(session, interaction);
    ImGui::SameLine();
    if (ImGui::SmallButton("next (Tab)")) interaction.open_next(1);
    ImGui::SameLine();
    if (ImGui::SmallButton("open (O)")) chooser.show();
    choose_color(style);
    show_overlays(style);
    show_clock(session, interaction, rates);
    ImGui::Separator();
    show_dials(session, interaction);
    show_additions(interaction, wishes);
    show_joining(interaction);
    show_light(style);
    ImGui::Separator();
    show_vehicle(session, interaction);
    if (!interaction.selected()) ImGui::TextDisabled("click a body to see what it is about");
    if (ImGui::Button("graphs")) graphs_shown_ = !graphs_shown_;
    ImGui::SameLine();
    if (ImGui::Button("keys (F1)")) help_shown = !help_shown;
    ImGui::PopItemWidth();
    ImGui::End();
    show_selected(session, interaction);
    show_graphs(session, interaction, rates);
    list_open_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    return wishes;
}

}  // namespace scree::demos
