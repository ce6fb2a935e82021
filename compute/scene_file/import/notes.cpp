// Notes and errors of imports.
#include "compute/scene_file/import/notes.h"

namespace scree::imports {

namespace {

// What a file of nonsense may fill memory and screens with.
constexpr std::size_t most_kinds_of_notes = 200;

std::string placed(const Origin& at, const std::string& kind, const std::string& reason) {
    return at.text() + ": " + (at.element.empty() ? "" : at.element + ": ") + (kind.empty() ? "" : kind + ": ") + reason;
}

}  // namespace

void refuse(const Origin& at, const std::string& reason) {
    throw ImportError(placed(at, "", reason));
}

void Notes::add(const Origin& at, const std::string& kind, const std::string& reason) {
    const std::string element = at.element.substr(0, at.element.find(' '));
    for (Note& note : notes_) {
        if (note.kind != kind || note.reason != reason || note.first.element.substr(0, note.first.element.find(' ')) != element)
            continue;
        ++note.count;
        return;
    }
    if (notes_.size() > most_kinds_of_notes) return;
    if (notes_.size() == most_kinds_of_notes)
        notes_.push_back({{at.file, at.line, ""}, "", "and more from here on, of which nothing is told", 1});
    else
        notes_.push_back({at, kind, reason, 1});
}

std::vector<std::string> Notes::told(bool strict) const {
    std::vector<std::string> lines;
    for (const Note& note : notes_)
        lines.push_back(placed(note.first, note.kind, note.reason) +
                        (note.count > 1 ? " (and " + std::to_string(note.count - 1) + " more)" : ""));
    if (strict && !lines.empty())
        throw ImportError(lines.front() + (lines.size() > 1 ? "; and " + std::to_string(lines.size() - 1) + " more notes" : "") +
                          "; without --strict it would be a note");
    return lines;
}

}  // namespace scree::imports
