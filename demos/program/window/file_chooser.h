// A list of folders and scene files, to open one.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::demos {

class FileChooser {
public:
    void show();  // lists the folder anew
    void hide() { shown_ = false; }
    bool shown() const { return shown_; }
    bool takes_keys() const { return !shown_ || field_active_; }  // else keys that are pressed now are meant for its field
    // Lays it out in Dear ImGui's current frame; returns the file that the user has chosen, or the word that was entered.
    std::optional<std::string> lay_out(const std::string& message);

private:
    void go_to(const std::filesystem::path& folder);

    bool shown_ = false;
    bool field_active_ = false;
    std::filesystem::path folder_;
    std::vector<std::string> folders_, files_;  // names, sorted
    std::string reason_;                        // why the folder cannot be listed
    std::array<char, 4096> entered_{};
};

}  // namespace scree::demos
