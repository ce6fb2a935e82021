// A list of folders and scene files, in Dear ImGui.
#include "demos/program/window/file_chooser.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <system_error>

#include "compute/scene_file/load_scene.h"
#include "demos/program/window/widgets.h"

namespace scree::demos {

namespace {

constexpr std::size_t most_listed = 2000;  // of a kind; a longer list takes too long to lay out

bool is_hidden(const std::filesystem::path& name) {
    return name.string().starts_with('.');
}

}  // namespace

void FileChooser::show() {
    std::error_code ignored;
    go_to(folder_.empty() ? std::filesystem::current_path(ignored) : folder_);
    shown_ = true;
    field_active_ = false;
}

void FileChooser::go_to(const std::filesystem::path& folder) {
    std::error_code error;
    folder_ = folder.lexically_normal();
    folders_.clear();
    files_.clear();
    for (std::filesystem::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        const std::filesystem::path name = entry->path().filename();
        if (is_hidden(name)) continue;
        std::error_code unknown;
        if (entry->is_directory(unknown) && folders_.size() < most_listed) folders_.push_back(name.string());
        const bool scene = name.extension() == ".json" || is_scene_import(name);
        if (scene && entry->is_regular_file(unknown) && files_.size() < most_listed) files_.push_back(name.string());
    }
    reason_ = error ? error.message() : "";
    std::sort(folders_.begin(), folders_.end());
    std::sort(files_.begin(), files_.end());
    const std::string text = folder_.string();
    entered_.fill(0);
    std::memcpy(entered_.data(), text.data(), std::min(text.size(), entered_.size() - 1));
}

std::optional<std::string> FileChooser::lay_out(const std::string& message) {
    if (!shown_) return std::nullopt;
    std::optional<std::string> chosen;
    std::optional<std::filesystem::path> next;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, 0.5f * screen.y), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(
        ImVec2(std::min(35 * ImGui::GetFontSize(), screen.x - 16), std::min(27 * ImGui::GetFontSize(), screen.y - 16)),
        ImGuiCond_Appearing);
    ImGui::Begin("open a scene", &shown_, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNavInputs);
    ImGui::SetNextItemWidth(-1);
    // The field has the keyboard from the first picture on, and again after each name that was entered.
    if (!field_active_) ImGui::SetKeyboardFocusHere();
    if (ImGui::InputText("##path", entered_.data(), entered_.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll)) {
        std::filesystem::path path = entered_.data();
        std::error_code unknown;
        if (path.is_relative() && std::filesystem::exists(folder_ / path, unknown)) path = folder_ / path;
        if (std::filesystem::is_directory(path, unknown))
            next = path;
        else
            chosen = path.string();
    }
    field_active_ = ImGui::IsItemActive();
    const std::string& said = reason_.empty() ? message : reason_;
    if (!said.empty()) say_wrapped(ImVec4(1, 0.5f, 0.4f, 1), said, ImGui::GetContentRegionAvail().x);
    ImGui::BeginChild("list", ImVec2(0, 0), true);
    if (folder_.has_parent_path() && ImGui::Selectable("../")) next = folder_.parent_path();
    for (const std::string& name : folders_)
        if (ImGui::Selectable((name + "/").c_str())) next = folder_ / name;
    for (const std::string& name : files_)
        if (ImGui::Selectable(name.c_str())) chosen = (folder_ / name).string();
    if (files_.empty())
        ImGui::TextDisabled("no scene files (.json, .xml, .mjcf, .urdf, .gltf, .glb, .usda, .usdc, .usdz, .stl, .obj) here");
    ImGui::EndChild();
    ImGui::End();
    if (next) go_to(*next);
    return chosen;
}

}  // namespace scree::demos
