// Graphs over time, in a window of their own whose size the user chooses.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "demos/program/options/units.h"
#include "demos/program/window/panel.h"
#include "demos/program/window/widgets.h"
#include "host/canvas/colors.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

constexpr ImU32 axis_color = IM_COL32(225, 228, 232, 255), grid_color = IM_COL32(255, 255, 255, 40),
                curve_color = IM_COL32(255, 190, 60, 255);

// A curve with its axes: values with their unit to the left, times below if asked for.
void plot_curve(const char* name, const char* unit, const std::vector<float>& times, const std::vector<float>& values,
                float height, bool with_times) {
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    // The axis ends at round numbers, so that there are two ticks at least and no curve runs along the rim.
    const float low = std::min(0.0f, host::axis_end(*lowest)), high = std::max(host::axis_end(*highest), low + 1e-6f);
    say_line(fmt::format("{}: {}", name, with_unit(values.back(), unit)));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetFontSize(), margin = ems(4.2f), below = with_times ? 1.2f * line : 0;
    const float left = corner.x + margin, right = corner.x + std::max(ImGui::GetContentRegionAvail().x, 2 * margin);
    const float top = corner.y + 0.3f * line, bottom = corner.y + std::max(height - below, 2 * line);
    const float first = times.front(), last = std::max(times.back(), first + 1e-3f);
    const auto x_of = [&](float time) { return left + (right - left) * (time - first) / (last - first); };
    const auto y_of = [&](float value) { return bottom - (bottom - top) * (value - low) / (high - low); };
    list.AddRectFilled(ImVec2(left, top), ImVec2(right, bottom), IM_COL32(0, 0, 0, 110));
    const int most = std::max(3, static_cast<int>((bottom - top) / (2 * line)));
    for (const float value : host::scale_ticks(low, high, false, most)) {
        list.AddLine(ImVec2(left, y_of(value)), ImVec2(right, y_of(value)), grid_color);
        const std::string label = host::tick_label(value, false);
        const ImVec2 size = ImGui::CalcTextSize(label.c_str());
        list.AddText(ImVec2(left - size.x - 0.3f * line, y_of(value) - 0.5f * size.y), axis_color, label.c_str());
    }
    for (const float time : host::scale_ticks(first, last, false, std::max(2, static_cast<int>((right - left) / ems(5))))) {
        list.AddLine(ImVec2(x_of(time), top), ImVec2(x_of(time), bottom), grid_color);
        const std::string label = host::tick_label(time, false) + " s";
        const ImVec2 size = ImGui::CalcTextSize(label.c_str());
        const float x = std::min(x_of(time) - 0.5f * size.x, right - size.x);
        if (with_times) list.AddText(ImVec2(x, bottom + 0.1f * line), axis_color, label.c_str());
    }
    for (std::size_t i = 1; i < values.size(); ++i)
        list.AddLine(ImVec2(x_of(times[i - 1]), y_of(values[i - 1])), ImVec2(x_of(times[i]), y_of(values[i])), curve_color, 1.5f);
    ImGui::Dummy(ImVec2(right - corner.x, bottom + below - corner.y));
    if (!ImGui::IsItemHovered()) return;
    const float pointed = first + (last - first) * (ImGui::GetIO().MousePos.x - left) / (right - left);
    const auto at = std::lower_bound(times.begin(), times.end(), pointed);
    const auto i = static_cast<std::size_t>(std::min<std::ptrdiff_t>(at - times.begin(), std::ssize(times) - 1));
    show_tooltip(fmt::format("{:.2f} s: {}", times[i], with_unit(values[i], unit)));
}

}  // namespace

void Panel::show_graphs(Session& session, Interaction& interaction, const Rates& rates) {
    if (!graphs_shown_) return;
    const std::optional<std::size_t> body = interaction.selected();
    history_.look(session.world(), body, session.beginnings(), rates.step_ms);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(screen.x - 8, screen.y - 8), ImGuiCond_FirstUseEver, ImVec2(1, 1));
    ImGui::SetNextWindowSize(ImVec2(std::min(ems(30), 0.5f * screen.x), 0.8f * screen.y), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.97f);  // the legend lies below
    ImGui::Begin("graphs", &graphs_shown_,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    say_line(body ? "of " + name_of(session.world().scene(), *body) : "of the world; select a body for its own");
    ImGui::SameLine();
    if (ImGui::SmallButton("write CSV")) write_graphs(session);
    const float spare = ImGui::GetContentRegionAvail().y / History::count - 2 * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::max(spare + ImGui::GetTextLineHeight(), 3 * ImGui::GetFontSize());
    for (std::size_t k = 0; k < History::count && !history_.times().empty(); ++k)
        plot_curve(History::names[k], History::units[k], history_.times(), history_.of(static_cast<History::Series>(k)), height,
                   k + 1 == History::count);
    ImGui::End();
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

}  // namespace scree::demos
