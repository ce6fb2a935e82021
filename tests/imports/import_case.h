// Files of other programs, written to a folder for a test.
#pragma once

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "compute/scene_file/import/import_scene.h"
#include "compute/scene_file/load_scene.h"

namespace scree::imported {

class Case {
public:
    Case() {
        std::string name = (std::filesystem::temp_directory_path() / "scree-import-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~Case() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Case(const Case&) = delete;
    Case& operator=(const Case&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    SceneDocument load(const std::string& name, const std::string& text, const ImportOptions& options = {}) {
        notes.clear();
        return load_scene(write(name, text), options, &notes);
    }
    // The error, without the folder; empty if there is none.
    std::string refusal(const std::string& name, const std::string& text, const ImportOptions& options = {}) {
        try {
            load(name, text, options);
            return "";
        } catch (const ImportError& error) {
            const std::string what = error.what(), folder = folder_.string() + "/";
            return what.starts_with(folder) ? what.substr(folder.size()) : what;
        }
    }
    bool noted(const std::string& words) const {
        for (const std::string& note : notes)
            if (note.find(words) != std::string::npos) return true;
        return false;
    }

    std::vector<std::string> notes;

private:
    std::filesystem::path folder_;
};

inline std::string mjcf(const std::string& inside) {
    return "<mujoco>\n<worldbody>\n" + inside + "\n</worldbody>\n</mujoco>\n";
}

}  // namespace scree::imported
