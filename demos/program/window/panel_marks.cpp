// Marks over the window's picture: the grab spring, outlines, contact forces, the body under the pointer.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compute/scene/shape_geometry.h"
#include "demos/program/options/units.h"
#include "demos/program/window/panel.h"
#include "demos/program/window/widgets.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr ImU32 held_color = IM_COL32(255, 190, 60, 255), selected_color = IM_COL32(255, 255, 255, 220),
                force_color = IM_COL32(70, 240, 130, 255), shade = IM_COL32(0, 0, 0, 170);
constexpr std::size_t most_numbers = 4;  // forces with numbers: the largest

ImVec2 screen_of(glm::vec2 pixel) {
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;  // pixels per screen unit
    return {pixel.x / scale.x, pixel.y / scale.y};
}
std::optional<ImVec2> screen_of(const Interaction& interaction, vec3 point) {
    const std::optional<glm::vec2> pixel = interaction.eye().pixel_of(point, interaction.extent());
    if (!pixel) return std::nullopt;
    return screen_of(*pixel);
}

// A line that shows on any ground.
void draw_line(const Interaction& interaction, vec3 from, vec3 to, ImU32 color) {
    const std::optional<ImVec2> a = screen_of(interaction, from), b = screen_of(interaction, to);
    if (!a || !b) return;
    ImGui::GetBackgroundDrawList()->AddLine(*a, *b, shade, 3.5f);
    ImGui::GetBackgroundDrawList()->AddLine(*a, *b, color, 1.8f);
}
void draw_text(ImVec2 at, ImU32 color, const std::string& text) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddText(ImVec2(at.x + 1, at.y + 1), IM_COL32(0, 0, 0, 200), text.c_str());
    list.AddText(at, color, text.c_str());
}

}  // namespace

// The grab spring's line: redder and thicker with its force.
void Panel::show_pull(Interaction& interaction) const {
    const std::optional<Pull> pull = interaction.pull();
    if (!pull) return;
    const std::optional<ImVec2> a = screen_of(interaction, pull->from), b = screen_of(interaction, pull->to);
    if (!a || !b) return;
    const ImU32 color = ImGui::ColorConvertFloat4ToU32(ImVec4(1, 0.9f - 0.8f * pull->strength, 0.3f - 0.3f * pull->strength, 1));
    ImDrawList& lines = *ImGui::GetBackgroundDrawList();
    lines.AddLine(*a, *b, IM_COL32(0, 0, 0, 160), 5 + 4 * pull->strength);
    lines.AddLine(*a, *b, color, 2.5f + 4 * pull->strength);
    lines.AddCircleFilled(*a, 5, color);
    lines.AddCircle(*b, 7, color, 0, 2.5f);
    draw_text(ImVec2(b->x + 12, b->y - 7), color, with_prefix(pull->force, "N"));
}

// A circle around a sphere, the edges of the box around any other body.
void Panel::show_outline(const World& world, const Interaction& interaction, std::size_t body, unsigned color) const {
    const BodyState state = world.body(body);
    if (!state.exists) return;
    const Shape& shape = world.scene().bodies[body].shape;
    if (std::holds_alternative<Plane>(shape)) return;
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        const std::optional<ImVec2> middle = screen_of(interaction, state.position);
        const std::optional<ImVec2> rim = screen_of(interaction, state.position + interaction.eye().right() * sphere->radius);
        if (!middle || !rim) return;
        const float radius = std::hypot(rim->x - middle->x, rim->y - middle->y) + 2;
        ImGui::GetBackgroundDrawList()->AddCircle(*middle, radius, shade, 48, 3.5f);
        ImGui::GetBackgroundDrawList()->AddCircle(*middle, radius, color, 48, 1.8f);
        return;
    }
    const vec3 half = half_extents(shape);
    const auto corner = [&](int bits) {
        const vec3 at((bits & 1) ? half.x : -half.x, (bits & 2) ? half.y : -half.y, (bits & 4) ? half.z : -half.z);
        return state.position + physics::rotate(state.orientation, at);
    };
    for (int from = 0; from < 8; ++from) {
        for (const int axis : {1, 2, 4})
            if ((from & axis) == 0) draw_line(interaction, corner(from), corner(from | axis), color);
    }
}

// Normal forces on the selected body, as arrows towards it, the largest with numbers.
void Panel::show_forces(const World& world, const Interaction& interaction) const {
    if (points_.empty() || !interaction.selected()) return;
    const Body& body = world.scene().bodies[*interaction.selected()];
    if (body.motion != scree::Motion::dynamic) return;
    const float mass = mass_properties(body).mass;
    const float weight = mass * std::max(1.0f, glm::length(world.scene().gravity));
    const float reach = bounding_radius(body.shape);
    std::vector<ContactPoint> sorted = points_;
    std::sort(sorted.begin(), sorted.end(), [](const ContactPoint& a, const ContactPoint& b) { return a.force > b.force; });
    std::vector<ImVec2> numbered;
    const auto is_free = [&](ImVec2 place) {  // numbers do not cover each other
        return std::ranges::none_of(numbered, [&](ImVec2 other) {
            return std::abs(place.x - other.x) < 4 * ImGui::GetFontSize() && std::abs(place.y - other.y) < ImGui::GetFontSize();
        });
    };
    for (const ContactPoint& point : sorted) {
        const std::optional<ImVec2> at = screen_of(interaction, point.position);
        if (!at) continue;
        ImGui::GetBackgroundDrawList()->AddCircleFilled(*at, 4, shade);
        ImGui::GetBackgroundDrawList()->AddCircleFilled(*at, 2.8f, force_color);
        if (point.force <= 0) continue;
        // Its length grows with the root of the force; the body's weight is as long as its radius.
        const vec3 tail = point.position - point.normal * (reach * std::min(3.0f, std::sqrt(point.force / weight)));
        draw_line(interaction, tail, point.position, force_color);
        const std::optional<ImVec2> end = screen_of(interaction, tail);
        if (!end || numbered.size() == most_numbers || !is_free(*end)) continue;
        draw_text(ImVec2(end->x + 5, end->y - 7), force_color, with_prefix(point.force, "N"));
        numbered.push_back(*end);
    }
}

// The first point of a joint, and what to do next.
void Panel::show_first_point(const World& world, const Interaction& interaction) const {
    if (!interaction.joining()) return;
    const std::string word = join_words()[static_cast<std::size_t>(interaction.join_kind)];
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    draw_text(ImVec2(pointer.x + 14, pointer.y - 18), held_color,
              fmt::format("{} joint: click a point of {} body", word, interaction.first_point() ? "the other" : "the first"));
    if (!interaction.first_point()) return;
    const BodyState body = world.body(interaction.first_point()->body);
    const vec3 place = body.position + physics::rotate(body.orientation, interaction.first_point()->anchor);
    const std::optional<ImVec2> at = screen_of(interaction, place);
    if (!at) return;
    ImGui::GetBackgroundDrawList()->AddLine(*at, pointer, shade, 3.5f);
    ImGui::GetBackgroundDrawList()->AddLine(*at, pointer, held_color, 1.8f);
    ImGui::GetBackgroundDrawList()->AddCircleFilled(*at, 6, held_color);
}

// Name, speed and contacts of the body under the pointer.
void Panel::show_hovered(Session& session, Interaction& interaction) {
    constexpr double every = 0.3;  // s: a ray is cast at all bodies
    if (ImGui::GetIO().WantCaptureMouse || interaction.held()) return;
    const World& world = session.world();
    const Scene& scene = world.scene();
    if (ImGui::GetTime() - hovered_at_ > every || ImGui::GetTime() < hovered_at_) {
        const std::optional<RayHit> hit = interaction.hovered();
        hovered_at_ = ImGui::GetTime();
        hovered_.reset();
        if (hit && scene.bodies[hit->body].motion == scree::Motion::dynamic) {
            hovered_ = hit->body;
            const BodyState state = world.body(hit->body);
            double force = 0;
            const std::vector<BodyContact> contacts = world.contacts_of(hit->body);
            for (const BodyContact& contact : contacts) force += static_cast<double>(contact.force);
            hovered_text_ = fmt::format("{}{}\n{}, touches {}, {}", name_of(scene, hit->body), state.asleep ? ", asleep" : "",
                                        with_unit(glm::length(state.velocity), "m/s"), contacts.size(), with_prefix(force, "N"));
        }
    }
    if (!hovered_ || !has_body(world, *hovered_)) return;
    if (interaction.selected() != hovered_) show_outline(world, interaction, *hovered_, IM_COL32(255, 255, 255, 110));
    show_tooltip(hovered_text_);
}

void Panel::show_marks(Session& session, Interaction& interaction) {
    const World& world = session.world();
    const std::optional<std::size_t> held = interaction.held(), selected = interaction.selected();
    if (selected) {
        look_at(world, *selected);
        show_outline(world, interaction, *selected, held == selected ? held_color : selected_color);
        show_forces(world, interaction);
    }
    show_pull(interaction);
    show_first_point(world, interaction);
    show_hovered(session, interaction);
}

}  // namespace scree::demos
