// How files of other programs become scenes.
#pragma once

#include <map>
#include <string>

namespace scree {

enum class ImportedAxes {
    y_up,  // a scene whose z axis points up is turned so that y does, as everywhere in scree
    file,  // the file's own axes; gravity points along them
};
enum class ImportedBase {
    usual,  // fixed, with a note
    fixed,
    free,
};

struct ImportOptions {
    bool strict = false;  // what would be a note is an error
    ImportedAxes axes = ImportedAxes::y_up;
    ImportedBase base = ImportedBase::usual;      // of a URDF: its root link and what is fixed to it
    bool ground = false;                          // add a plane that the lowest point of the scene touches
    std::string keyframe;                         // of an MJCF file, by name or index: poses, speeds and controls; empty: none
    std::map<std::string, std::string> packages;  // folders of package://NAME/...; others are looked for around the file
    bool allow_outside = false;                   // files may name meshes and other files outside of their folder
    bool operator==(const ImportOptions& o) const {
        return strict == o.strict && axes == o.axes && base == o.base && ground == o.ground && keyframe == o.keyframe &&
               packages == o.packages && allow_outside == o.allow_outside;
    }
};

}  // namespace scree
