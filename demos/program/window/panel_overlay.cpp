// What lies over the window's picture: legend, caption, messages, help on the keys.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "demos/program/window/panel.h"
#include "demos/program/window/widgets.h"

namespace scree::demos {

namespace {

constexpr ImU32 text_color = IM_COL32(225, 228, 232, 255), unit_color = IM_COL32(225, 228, 232, 190),
                plate_color = IM_COL32(12, 14, 18, 175);
constexpr double told_for = 12;  // s

ImU32 shown_color(glm::vec3 linear) {
    return IM_COL32(host::srgb_byte(linear.r), host::srgb_byte(linear.g), host::srgb_byte(linear.b), 255);
}
float text_width_of(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x;
}

// Swatches with labels.
void draw_materials(ImDrawList& list, const host::ColorScale& scale) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetTextLineHeightWithSpacing(), pad = ems(0.8f), swatch = ems(0.8f);
    float widest = text_width_of(host::color_title(scale.by));
    for (const host::Material& material : scale.materials) widest = std::max(widest, 2 * swatch + text_width_of(material.label));
    const float right = screen.x - ems(1), bottom = screen.y - ems(1), left = right - 2 * pad - widest;
    const float top = bottom - 2 * pad - line * static_cast<float>(scale.materials.size() + 1);
    list.AddRectFilled(ImVec2(left, top), ImVec2(right, bottom), plate_color, 5);
    list.AddText(ImVec2(left + pad, top + pad), text_color, host::color_title(scale.by).c_str());
    for (std::size_t i = 0; i < scale.materials.size(); ++i) {
        const float y = top + pad + line * static_cast<float>(i + 1);
        list.AddRectFilled(ImVec2(left + pad, y + 0.1f * line), ImVec2(left + pad + swatch, y + 0.1f * line + swatch),
                           shown_color(host::name_color(static_cast<unsigned>(i))), 2);
        list.AddText(ImVec2(left + pad + 2 * swatch, y), text_color, scale.materials[i].label.c_str());
    }
}

// The colour bar with its ticks.
void draw_bar(ImDrawList& list, const host::ColorScale& scale) {
    constexpr int pieces = 96;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFontSize(), pad = ems(1.1f), wide = std::min(ems(18), screen.x - ems(5));
    const float right = screen.x - ems(1) - pad, left = right - wide, bottom = screen.y - ems(1) - 1.7f * line,
                top = bottom - 0.8f * line;
    list.AddRectFilled(ImVec2(left - pad, top - 1.9f * line), ImVec2(right + pad, screen.y - ems(1)), plate_color, 5);
    std::string unit = host::color_unit(scale.by);
    if (scale.root) unit += unit.empty() ? "root scale" : ", root scale";
    list.AddText(ImVec2(left, top - 1.45f * line), text_color, host::color_title(scale.by).c_str());
    list.AddText(ImVec2(right - text_width_of(unit), top - 1.45f * line), unit_color, unit.c_str());
    const auto x_of = [&](float place) { return left + wide * place; };
    for (int i = 0; i < pieces; ++i) {
        const auto from = static_cast<float>(i) / pieces, to = static_cast<float>(i + 1) / pieces;
        list.AddRectFilled(ImVec2(x_of(from), top), ImVec2(x_of(to), bottom),
                           shown_color(host::map_color(scale.map, 0.5f * (from + to))));
    }
    float taken = left - pad;
    for (const float value : host::scale_ticks(scale.low, scale.high, scale.logarithmic, 6)) {
        const std::string label = host::tick_label(value, scale.logarithmic);
        const float half = 0.5f * text_width_of(label);
        const float x = x_of(host::scale_place(scale, value));
        if (x - half < taken) continue;
        taken = x + half + 0.4f * line;
        list.AddLine(ImVec2(x, bottom), ImVec2(x, bottom + 0.3f * line), text_color);
        list.AddText(ImVec2(std::min(x - half, right + pad - 2 * half - 2), bottom + 0.35f * line), text_color, label.c_str());
    }
}

void draw_caption(ImDrawList& list, const std::string& caption) {
    const ImVec2 size = ImGui::CalcTextSize(caption.c_str());
    const float pad = ems(0.8f), left = ems(1), bottom = ImGui::GetIO().DisplaySize.y - ems(1);
    list.AddRectFilled(ImVec2(left, bottom - size.y - 2 * pad), ImVec2(left + size.x + 2 * pad, bottom), plate_color, 5);
    list.AddText(ImVec2(left + pad, bottom - size.y - pad), text_color, caption.c_str());
}

void list_keys(const char* name, const std::vector<KeyHelp>& lines, std::size_t from, std::size_t to) {
    if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX))
        return;
    for (std::size_t i = from; i < to; ++i) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        say_line(lines[i].keys);
        ImGui::TableNextColumn();
        say_line(lines[i].meaning);
    }
    ImGui::EndTable();
}

}  // namespace

void Panel::lay_out_legend(const host::ColorScale& scale, const std::string& caption) const {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (host::has_scale(scale.by)) draw_bar(list, scale);
    if (scale.by == host::ColorBy::material && !scale.materials.empty()) draw_materials(list, scale);
    if (!caption.empty()) draw_caption(list, caption);
}

void Panel::tell(std::string message) {
    told_ = std::move(message);
    told_at_ = ImGui::GetTime();
}

// At a fixed place, so that nothing moves under the pointer: above the middle of the lower edge.
void Panel::show_messages(const Interaction& interaction) const {
    const bool tells = !told_.empty() && ImGui::GetTime() - told_at_ < told_for;
    if (!tells && (interaction.message().empty() || chooser.shown())) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, screen.y - ems(6)), ImGuiCond_Always, ImVec2(0.5f, 1));
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::Begin("messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    const float wide = std::min(ems(40), screen.x - ems(4));
    const auto say = [&](const ImVec4& color, const std::string& text) {
        say_wrapped(color, text, std::min(wide, text_width_of(text) + 1));
    };
    if (!interaction.message().empty() && !chooser.shown()) say(ImVec4(1, 0.5f, 0.4f, 1), interaction.message());
    if (tells) say(ImVec4(0.6f, 0.9f, 0.6f, 1), told_);
    ImGui::End();
}

// The keys in two columns.
void Panel::show_help() {
    if (!help_shown) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, 0.5f * screen.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(screen.x - 16, screen.y - 16));
    ImGui::SetNextWindowBgAlpha(0.93f);
    ImGui::Begin("keys", &help_shown,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNavInputs |
                     ImGuiWindowFlags_HorizontalScrollbar);
    const std::vector<KeyHelp>& lines = key_help();
    const std::size_t half = (lines.size() + 1) / 2;
    const bool side_by_side = screen.x > ems(62);
    list_keys("first keys", lines, 0, half);
    if (side_by_side) ImGui::SameLine(0, ems(2));
    list_keys("other keys", lines, half, lines.size());
    ImGui::End();
}

}  // namespace scree::demos
