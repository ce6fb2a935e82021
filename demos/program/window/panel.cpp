// The window's panel, in Dear ImGui.
#include "demos/program/window/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "demos/film/pictures.h"
#include "demos/scenes/demos.h"

namespace scree::demos {

namespace {

constexpr double look_every = 0.25;  // s: reading all contacts of a large world takes a while

void say_line(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

void choose_demo(Session& session, Interaction& interaction) {
    const std::string& name = session.subject().name;
    if (!ImGui::BeginCombo("scene", name.substr(name.rfind('/') + 1).c_str())) return;
    for (const Demo& demo : all_demos()) {
        if (demo.trial) continue;
        if (ImGui::Selectable(demo.name, name == demo.name)) interaction.open(demo.name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", demo.line);
    }
    ImGui::EndCombo();
}

void choose_color(std::string& color) {
    if (!ImGui::BeginCombo("colour", color.c_str())) return;
    for (const std::string& word : color_words()) {
        if (ImGui::Selectable(word.c_str(), word == color)) color = word;
    }
    ImGui::EndCombo();
}

std::string name_of(const Scene& scene, std::size_t body) {
    const Body& b = scene.bodies[body];
    std::string shape = shape_name(b.shape);
    std::replace(shape.begin(), shape.end(), '_', ' ');
    return fmt::format("{} {}{}", shape, body, b.name.empty() ? "" : " \"" + b.name + "\"");
}

}  // namespace

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
}

void Panel::show_dials(Session& session, Interaction& interaction) {
    const World& world = session.world();
    vec3 gravity = world.scene().gravity;
    float factor = world.settings().friction_factor, least = world.settings().least_restitution;
    int substeps = world.settings().substeps;
    bool sleeping = world.settings().sleeping;
    Turn turn;
    if (ImGui::SliderFloat("gravity", &gravity.y, -30, 30, "%.2f m/s^2", ImGuiSliderFlags_AlwaysClamp)) turn.gravity = gravity;
    if (ImGui::SliderFloat("friction", &factor, 0, 3, "%.2f x", ImGuiSliderFlags_AlwaysClamp)) turn.friction_factor = factor;
    if (ImGui::SliderFloat("restitution", &least, 0, 1, "at least %.2f", ImGuiSliderFlags_AlwaysClamp))
        turn.least_restitution = least;
    if (ImGui::SliderInt("substeps", &substeps, 1, 32, "%d", ImGuiSliderFlags_AlwaysClamp)) turn.substeps = substeps;
    if (ImGui::Checkbox("bodies at rest sleep", &sleeping)) turn.sleeping = sleeping;
    if (turn.gravity || turn.friction_factor || turn.least_restitution || turn.substeps || turn.sleeping)
        interaction.perform(turn);
}

void Panel::show_additions(Interaction& interaction) {
    say_line("add a");
    for (const auto& [label, kind] : {std::pair("sphere", Kind::sphere), {"capsule", Kind::capsule}, {"box", Kind::box}}) {
        ImGui::SameLine();
        if (ImGui::Button(label)) interaction.add(kind);
    }
}

void Panel::show_selected(Session& session, Interaction& interaction) {
    const std::optional<std::size_t> selected = interaction.selected();
    if (!selected) {
        ImGui::TextDisabled("take hold of a body to see what it is about");
        return;
    }
    World& world = session.world();
    const Scene& scene = world.scene();
    const BodyState state = world.body(*selected);
    const Body& body = scene.bodies[*selected];
    const float mass = mass_properties(body.shape, body.density).mass;
    if (looked_body_ != *selected || ImGui::GetTime() - looked_at_ > look_every || ImGui::GetTime() < looked_at_) {
        touching_ = world.contacts_of(*selected);
        looked_body_ = *selected;
        looked_at_ = ImGui::GetTime();
    }
    float force = 0;
    int points = 0;
    for (const BodyContact& touching : touching_) {
        force += touching.force;
        points += touching.points;
    }
    say_line(name_of(scene, *selected) + (state.asleep ? ", asleep" : ""));
    const vec3 p = state.velocity * mass;
    say_line(fmt::format("momentum {:.4g} kg m/s", glm::length(p)));
    say_line(fmt::format("    ({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z));
    say_line(fmt::format("{:.3g} m/s, {:.3g} rad/s, {:.4g} kg", glm::length(state.velocity), glm::length(state.angular_velocity),
                         mass));
    say_line(fmt::format("touches {} in {} points, {:.4g} N", touching_.size(), points, force));
    say_line(fmt::format("density {:g} kg/m^3, friction {:g}, restitution {:g}", body.density, body.friction, body.restitution));
    ImGui::Checkbox("follow", &interaction.follows);
}

void Panel::show_vehicle(Session& session, Interaction& interaction) {
    const std::optional<std::size_t> which = interaction.vehicle();
    if (!which) return;
    const VehicleState now = session.world().vehicle(*which);
    const std::string& name = session.world().scene().vehicles[*which].name;
    say_line(fmt::format("{}: {:.0f} km/h{}", name.empty() ? fmt::format("vehicle {}", *which) : name,
                         static_cast<double>(now.speed) * 3.6, now.by_route ? ", drives by itself" : ""));
    say_line("W S A D or arrows drive it, Space: hand brake");
    if (ImGui::Button("on its wheels")) interaction.reset_upright();
    ImGui::SameLine();
    ImGui::Checkbox("chase", &interaction.chases);
}

// The grab spring's line: redder and thicker with its force.
void Panel::show_pull(Interaction& interaction) const {
    const std::optional<Pull> pull = interaction.pull();
    if (!pull) return;
    const std::optional<glm::vec2> from = interaction.eye().pixel_of(pull->from, interaction.extent());
    const std::optional<glm::vec2> to = interaction.eye().pixel_of(pull->to, interaction.extent());
    if (!from || !to) return;
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;  // pixels per screen unit
    const ImVec2 a(from->x / scale.x, from->y / scale.y), b(to->x / scale.x, to->y / scale.y);
    const ImU32 color = ImGui::ColorConvertFloat4ToU32(ImVec4(1, 0.9f - 0.8f * pull->strength, 0.3f - 0.3f * pull->strength, 1));
    ImDrawList& lines = *ImGui::GetBackgroundDrawList();
    lines.AddLine(a, b, IM_COL32(0, 0, 0, 160), 5 + 4 * pull->strength);
    lines.AddLine(a, b, color, 2.5f + 4 * pull->strength);
    lines.AddCircleFilled(a, 5, color);
    lines.AddCircle(b, 7, color, 0, 2.5f);
    const std::string force = fmt::format("{:.3g} N", pull->force);
    lines.AddText(ImVec2(b.x + 13, b.y - 6), IM_COL32(0, 0, 0, 200), force.c_str());
    lines.AddText(ImVec2(b.x + 12, b.y - 7), color, force.c_str());
}

void Panel::lay_out(Session& session, Interaction& interaction, const Rates& rates, std::string& color) {
    show_pull(interaction);
    if (!shown) return;
    ImGui::SetNextWindowPos(ImVec2(8, 8), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.78f);
    ImGui::Begin("scree", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(170);
    choose_demo(session, interaction);
    choose_color(color);
    show_clock(session, interaction, rates);
    ImGui::Separator();
    show_dials(session, interaction);
    show_additions(interaction);
    ImGui::Separator();
    show_vehicle(session, interaction);
    show_selected(session, interaction);
    if (!interaction.message().empty()) ImGui::TextColored(ImVec4(1, 0.5f, 0.4f, 1), "%s", interaction.message().c_str());
    if (ImGui::TreeNodeEx("keys", ImGuiTreeNodeFlags_None)) {
        say_line(key_help);
        ImGui::TreePop();
    }
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace scree::demos
