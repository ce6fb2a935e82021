// Pieces of the window's panel: lines of text, drop-down lists that Escape closes, buttons back to a default.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <string>
#include <vector>

namespace scree::demos {

inline void say_line(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

// A tooltip as large as its text; by itself it is as large as that of the picture before.
inline void show_tooltip(const std::string& text) {
    ImGui::SetNextWindowContentSize(ImGui::CalcTextSize(text.c_str()));
    ImGui::BeginTooltip();
    say_line(text);
    ImGui::EndTooltip();
}

// Width in letters' heights, so that the panel grows with its text.
inline float ems(float count) {
    return count * ImGui::GetFontSize();
}

// A text that is wrapped at a width, pixels.
inline void say_wrapped(const ImVec4& color, const std::string& text, float width) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    say_line(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

// A drop-down list; Dear ImGui closes it by Escape only where keys navigate.
inline bool begin_list(const char* label, const std::string& shown) {
    if (!ImGui::BeginCombo(label, shown.c_str())) return false;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
    return true;
}

// A drop-down list of an enum's words.
template <class Enum>
bool choose(const char* label, const std::vector<std::string>& words, Enum& value) {
    bool changed = false;
    if (!begin_list(label, words[static_cast<std::size_t>(value)])) return false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (!ImGui::Selectable(words[i].c_str(), i == static_cast<std::size_t>(value))) continue;
        changed = value != static_cast<Enum>(i);
        value = static_cast<Enum>(i);
    }
    ImGui::EndCombo();
    return changed;
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

}  // namespace scree::demos
