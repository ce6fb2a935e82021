// What an import tells: errors with their place, and what is not translated, each kind once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compute/scene_file/import/import_scene.h"

namespace scree::imports {

// A place in a file.
struct Origin {
    std::string file;
    int line = 0;         // 0: none
    std::string element;  // such as geom "foot"; may be empty
    std::string text() const { return file + (line > 0 ? ":" + std::to_string(line) : ""); }
};

[[noreturn]] void refuse(const Origin& at, const std::string& reason);

class Notes {
public:
    // `kind`: notes of equal kind and reason are told once, with the first place and their number.
    void add(const Origin& at, const std::string& kind, const std::string& reason);
    // As lines. With `strict`, throws ImportError if there are any.
    std::vector<std::string> told(bool strict) const;

private:
    struct Note {
        Origin first;
        std::string kind, reason;
        std::size_t count;
    };
    std::vector<Note> notes_;
};

}  // namespace scree::imports
