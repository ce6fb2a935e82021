// Files of other programs, written to a folder for a test.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "compute/scene_file/import/import_scene.h"
#include "compute/scene_file/load_scene.h"
#include "tests/temporary_folder.h"

namespace scree::imported {

class Case {
public:
    std::filesystem::path write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
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
            const std::string what = error.what(), folder = folder_.path().string() + "/";
            return what.starts_with(folder) ? what.substr(folder.size()) : what;
        }
    }
    std::filesystem::path folder() const { return folder_.path(); }
    bool noted(const std::string& words) const {
        for (const std::string& note : notes)
            if (note.find(words) != std::string::npos) return true;
        return false;
    }

    std::vector<std::string> notes;

private:
    tests::TemporaryFolder folder_;
};

inline std::string mjcf(const std::string& inside) {
    return "<mujoco>\n<worldbody>\n" + inside + "\n</worldbody>\n</mujoco>\n";
}

}  // namespace scree::imported
