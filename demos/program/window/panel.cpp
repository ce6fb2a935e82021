// The window's panel, in Dear ImGui.
#include "demos/program/window/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "compute/fields/picture_style.h"
#include "demos/program/units.h"
#include "demos/scenes/demos.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

constexpr double look_every = 0.25;  // s: reading all contacts of a large world takes a while

void say_line(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

void choose_demo(Session& session, Interaction& interaction) {
    const std::string& name = session.subject().name;
    if (!ImGui::BeginCombo("scene", session.subject().title().c_str())) return;
    for (const Demo& demo : all_demos()) {
        if (demo.trial) continue;
        if (ImGui::Selectable(demo.name, name == demo.name)) interaction.open(demo.name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", demo.line);
    }
    ImGui::EndCombo();
}

// A drop-down list of an enum's words.
template <class Enum>
bool choose(const char* label, const std::vector<std::string>& words, Enum& value) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, words[static_cast<std::size_t>(value)].c_str())) return false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (!ImGui::Selectable(words[i].c_str(), i == static_cast<std::size_t>(value))) continue;
        changed = value != static_cast<Enum>(i);
        value = static_cast<Enum>(i);
    }
    ImGui::EndCombo();
    return changed;
}

void choose_color(PictureStyle& style) {
    if (choose("colour", color_words(), style.color)) {
        style.scale = ShownScale::automatic;
        style.range = glm::vec2(0);
    }
    choose("map", color_map_words(), style.map);
}

// A button that takes a slider back to its default, beside it while it has another value.
template <class Value>
bool resets(const char* name, Value& value, Value by_default) {
    if (value == by_default) return false;
    ImGui::SameLine();
    ImGui::PushID(name);
    const bool pressed = ImGui::SmallButton("reset");
    ImGui::PopID();
    if (pressed) value = by_default;
    return pressed;
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
    if (ImGui::Button(interaction.paused ? "Go on" : "Pause")) interaction.paused = !interaction.paused;
    ImGui::SameLine();
    if (ImGui::Button("Step")) interaction.step_once();
    ImGui::SameLine();
    if (ImGui::Button("Again")) interaction.reset();
    ImGui::SameLine();
    if (ImGui::Button("Next demo")) interaction.open_next(1);
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
        ImGui::SetTooltip("Drag to go back to a moment; what happens from there is a new branch.");
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
    if (slider("gravity", gravity.y, -30, 30, "%.2f m/s^2", session.subject().scene.gravity.y)) turn.gravity = gravity;
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
        if (i % 3 != 0) ImGui::SameLine(static_cast<float>(i % 3) * 105);
        if (ImGui::Checkbox(overlay_words()[i].c_str(), &on)) set_shown(style, overlay, on);
    }
}

void Panel::show_additions(Interaction& interaction, Wishes& wishes) {
    say_line("add a");
    for (const auto& [label, kind] : {std::pair("sphere", Kind::sphere), {"capsule", Kind::capsule}, {"box", Kind::box}}) {
        ImGui::SameLine();
        if (ImGui::Button(label)) interaction.add(kind);
    }
    say_line("write a");
    ImGui::SameLine();
    wishes.picture = ImGui::Button("picture");
    ImGui::SameLine();
    wishes.recording = ImGui::Button("recording");
}

void Panel::look_at(const World& world, std::size_t body) {
    if (looked_body_ == body && ImGui::GetTime() - looked_at_ <= look_every && ImGui::GetTime() >= looked_at_) return;
    points_ = contact_points_of(world, body);
    looked_body_ = body;
    looked_at_ = ImGui::GetTime();
}

void Panel::show_selected(Session& session, Interaction& interaction) {
    const std::optional<std::size_t> selected = interaction.selected();
    if (!selected) {
        points_.clear();
        looked_body_.reset();
        ImGui::TextDisabled("take hold of a body to see what it is about");
        return;
    }
    World& world = session.world();
    const Scene& scene = world.scene();
    const BodyState state = world.body(*selected);
    const Body& body = scene.bodies[*selected];
    const float mass = mass_properties(body).mass;
    look_at(world, *selected);
    double force = 0;
    std::vector<std::size_t> others;
    for (const ContactPoint& point : points_) {
        force += static_cast<double>(point.force);
        if (std::find(others.begin(), others.end(), point.other) == others.end()) others.push_back(point.other);
    }
    say_line(name_of(scene, *selected) + (state.asleep ? ", asleep" : ""));
    const vec3 p = state.velocity * mass;
    say_line("momentum " + with_unit(glm::length(p), "kg m/s"));
    say_line(fmt::format("    ({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z));
    say_line(with_unit(glm::length(state.velocity), "m/s") + ", " + with_unit(glm::length(state.angular_velocity), "rad/s") +
             ", " + with_unit(mass, "kg"));
    say_line(fmt::format("touches {} in {} points, {}", others.size(), points_.size(), with_prefix(force, "N")));
    say_line(fmt::format("density {}, friction {:g}, restitution {:g}", with_unit(body.density, "kg/m^3"), body.friction,
                         body.restitution));
    ImGui::Checkbox("follow", &interaction.follows);
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

void Panel::show_graphs(Session& session, Interaction& interaction, const Rates& rates) {
    if (!ImGui::TreeNodeEx("graphs", ImGuiTreeNodeFlags_None)) return;
    const std::optional<std::size_t> body = interaction.selected();
    history_.look(session.world(), body, session.beginnings(), rates.step_ms);
    say_line(body ? "of " + name_of(session.world().scene(), *body) : "of the world; select a body for its own");
    for (std::size_t k = 0; k < History::count; ++k) {
        const std::vector<float>& values = history_.of(static_cast<History::Series>(k));
        if (values.empty()) continue;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        const std::string now = with_unit(values.back(), History::units[k]);
        ImGui::PlotLines(History::names[k], values.data(), static_cast<int>(values.size()), 0, now.c_str(),
                         std::min(0.0f, *least), *most, ImVec2(0, 38));
    }
    if (ImGui::Button("write CSV")) write_graphs(session);
    ImGui::TreePop();
}

void Panel::write_graphs(const Session& session) {
    const std::string file = host::unused_name(session.subject().title() + "-graphs", ".csv");
    try {
        host::write_atomically(file, history_.csv());
        tell("graphs in " + file);
    } catch (const std::exception& error) {
        tell(error.what());
    }
}

Wishes Panel::lay_out(Session& session, Interaction& interaction, const Rates& rates, PictureStyle& style) {
    Wishes wishes;
    show_marks(session, interaction);
    if (!shown) return wishes;
    ImGui::SetNextWindowPos(ImVec2(8, 8), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.78f);
    ImGui::Begin("scree", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(170);
    choose_demo(session, interaction);
    choose_color(style);
    show_overlays(style);
    show_clock(session, interaction, rates);
    ImGui::Separator();
    show_dials(session, interaction);
    show_additions(interaction, wishes);
    ImGui::Separator();
    show_vehicle(session, interaction);
    show_selected(session, interaction);
    if (!interaction.message().empty()) ImGui::TextColored(ImVec4(1, 0.5f, 0.4f, 1), "%s", interaction.message().c_str());
    if (!told_.empty()) ImGui::TextColored(ImVec4(0.6f, 0.9f, 0.6f, 1), "%s", told_.c_str());
    show_graphs(session, interaction, rates);
    if (ImGui::TreeNodeEx("keys", ImGuiTreeNodeFlags_None)) {
        if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
            for (const KeyHelp& line : key_help()) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                say_line(line.keys);
                ImGui::TableNextColumn();
                say_line(line.meaning);
            }
            ImGui::EndTable();
        }
        ImGui::TreePop();
    }
    ImGui::PopItemWidth();
    ImGui::End();
    return wishes;
}

}  // namespace scree::demos
