// Graphs over time, in a window of their own whose size the user chooses.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "demos/program/options/units.h"
#include "demos/program/window/panel.h"
#include "demos/program/window/widgets.h"
#include "host/canvas/colors.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

constexpr ImU32 axis_color = IM_COL32(225, 228, 232, 255), grid_color = IM_COL32(255, 255, 255, 40),
                curve_color = IM_COL32(255, 190, 60, 255), compared_color = IM_COL32(90, 180, 255, 255);

struct Curve {
    const std::vector<float>&times, &values;  // none empty
    ImU32 color;
};

// Curves of one quantity with their axes: values with their unit to the left, times below if asked for.
void plot_curves(const char* name, const char* unit, const std::vector<Curve>& curves, float height, bool with_times) {
    float lowest = 0, highest = 0, first = curves[0].times.front(), last = first;
    std::string values;
    for (const Curve& curve : curves) {
        const auto [low, high] = std::minmax_element(curve.values.begin(), curve.values.end());
        lowest = std::min(lowest, *low);
        highest = std::max(highest, *high);
        first = std::min(first, curve.times.front());
        last = std::max(last, curve.times.back());
        values += (values.empty() ? "" : ", ") + with_unit(curve.values.back(), unit);
    }
    last = std::max(last, first + 1e-3f);
    // The axis ends at round numbers, so that there are two ticks at least and no curve runs along the rim.
    const float low = host::axis_end(lowest), high = std::max(host::axis_end(highest), low + 1e-6f);
    say_line(fmt::format("{}: {}", name, values));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetFontSize(), margin = ems(4.2f), below = with_times ? 1.2f * line : 0;
    const float left = corner.x + margin, right = corner.x + std::max(ImGui::GetContentRegionAvail().x, 2 * margin);
    const float top = corner.y + 0.3f * line, bottom = corner.y + std::max(height - below, 2 * line);
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
    for (const Curve& curve : curves)
        for (std::size_t i = 1; i < curve.values.size(); ++i)
            list.AddLine(ImVec2(x_of(curve.times[i - 1]), y_of(curve.values[i - 1])),
                         ImVec2(x_of(curve.times[i]), y_of(curve.values[i])), curve.color, 1.5f);
    ImGui::Dummy(ImVec2(right - corner.x, bottom + below - corner.y));
    if (!ImGui::IsItemHovered()) return;
    const float pointed = first + (last - first) * (ImGui::GetIO().MousePos.x - left) / (right - left);
    std::string told = fmt::format("{:.2f} s", pointed), separator = ": ";
    for (const Curve& curve : curves) {
        const auto at = std::lower_bound(curve.times.begin(), curve.times.end(), pointed);
        const auto i = std::min<std::ptrdiff_t>(at - curve.times.begin(), std::ssize(curve.times) - 1);
        told += std::exchange(separator, ", ") + with_unit(curve.values[static_cast<std::size_t>(i)], unit);
    }
    show_tooltip(told);
}

void say_colored(ImU32 color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    say_line(text);
    ImGui::PopStyleColor();
}

}  // namespace

void Panel::show_graphs(Session& session, Interaction& interaction, const Rates& rates) {
    if (!graphs_shown_) return;
    const std::optional<std::size_t> body = interaction.selected();
    history_.look(session.world(), body, session.beginnings(), rates.step_ms);
    if (compared_scene_ != session.subject().title()) compared_.reset();
    if (compared_) compared_history_.look(session.world(), compared_, session.beginnings(), rates.step_ms);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(screen.x - 8, screen.y - 8), ImGuiCond_FirstUseEver, ImVec2(1, 1));
    ImGui::SetNextWindowSize(ImVec2(std::min(ems(30), 0.5f * screen.x), 0.8f * screen.y), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.97f);  // the legend lies below
    ImGui::Begin("graphs", &graphs_shown_,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    say_colored(curve_color, body ? "of " + name_of(session.world().scene(), *body) : "of the world; select a body for its own");
    ImGui::SameLine();
    if (ImGui::SmallButton("write CSV")) write_graphs(session);
    show_compared(session, body);
    std::vector<const History*> shown{&history_};
    if (compared_) shown.push_back(&compared_history_);
    const float spare = ImGui::GetContentRegionAvail().y / History::count - 2 * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::max(spare + ImGui::GetTextLineHeight(), 3 * ImGui::GetFontSize());
    for (std::size_t k = 0; k < History::count; ++k) {
        std::vector<Curve> curves;
        for (const History* one : shown)
            if (!one->times().empty())
                curves.push_back(
                    {one->times(), one->of(static_cast<History::Series>(k)), one == &history_ ? curve_color : compared_color});
        if (!curves.empty()) plot_curves(History::names[k], History::units[k], curves, height, k + 1 == History::count);
    }
    ImGui::End();
}

// The body whose graphs stay while another one is selected.
void Panel::show_compared(const Session& session, std::optional<std::size_t> selected) {
    if (compared_) {
        say_colored(compared_color, "beside " + name_of(session.world().scene(), *compared_));
        ImGui::SameLine();
        if (ImGui::SmallButton("compare no more")) compared_.reset();
    } else if (selected && ImGui::SmallButton("keep, to compare with others")) {
        compared_ = selected;
        compared_scene_ = session.subject().title();
        compared_history_ = history_;
    }
}

void Panel::write_graphs(const Session& session) {
    std::string files;
    const auto write = [&](const History& history) {
        const std::string file = host::unused_name(session.subject().title() + "-graphs", ".csv");
        host::write_atomically(file, history.csv());
        files += (files.empty() ? "graphs in " : ", ") + file;
    };
    try {
        write(history_);
        if (compared_) write(compared_history_);
        tell(files);
    } catch (const std::exception& error) {
        tell(error.what());
    }
}

}  // namespace scree::demos
