// What the calls of the C interface share: objects in use, and rows of the caller's memory.
#include "demos/c/objects.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>

#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/json_text.h"

namespace scree::c {

WorldObject::~WorldObject() {
    for (const auto& file : exports) try {
            file->write();
        } catch (const std::exception& error) {
            std::fprintf(stderr, "scree: %s\n", error.what());
        }
}

const demos::LoadedScene& WorldObject::as_subject() {
    if (!subject) {
        SceneDocument document = shown;
        document.scene = world.scene();  // at the start: what is yet to fall sets the ranges of colours
        document.events.clear();
        subject = demos::subject_of(std::move(document), "scene");
    }
    return *subject;
}

void WorldObject::require_no_views(const char* what) const {
    const std::size_t held = views;
    if (held == 0) return;
    throw Failure(SCREE_VIEWED, "the world cannot be " + std::string(what) + " while " + std::to_string(held) +
                                    " views look into its tables; release them first");
}

std::optional<std::size_t> copy_of(const World& world, std::size_t copy) {
    if (copy == SCREE_ALL_COPIES) return std::nullopt;
    return index_of(copy, world.copies(), "copy");
}

std::size_t index_of(std::size_t given, std::size_t most, const char* what) {
    if (given >= most)
        throw Failure(SCREE_BAD_INDEX, std::string(what) + " " + std::to_string(given) + " of " + std::to_string(most));
    return given;
}

std::vector<std::size_t> indices_of(const std::int64_t* given, std::size_t count, std::size_t most, const char* what) {
    given_array(given, count, "indices");
    std::vector<std::size_t> made(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (given[i] < 0 || static_cast<std::uint64_t>(given[i]) >= most)
            throw Failure(SCREE_BAD_INDEX, std::string(what) + " " + std::to_string(given[i]) + " of " + std::to_string(most));
        made[i] = static_cast<std::size_t>(given[i]);
    }
    return made;
}

Columns::Columns(const scree_column* columns, std::size_t count, std::size_t rows, const std::vector<Known>& known) {
    given_array(columns, count, "columns");
    columns_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = text_of(columns[i].name, "the name of a column");
        const auto at = std::find_if(known.begin(), known.end(), [&](const Known& one) { return one.name == name; });
        if (at == known.end()) {
            json_reading::Names names;
            for (const Known& one : known) names.emplace_back(one.name);
            refuse(json_reading::unknown("column", name, names));
        }
        if ((*this)[name.c_str()]) refuse("there are two columns \"" + name + "\"");
        const std::size_t row = static_cast<std::size_t>(at->width) * sizeof(float);
        given_array(columns[i].data, rows, name.c_str());
        columns_.emplace_back(
            name, Rows(columns[i].data, columns[i].stride == 0 ? row : stride_of(columns[i].stride, row, name.c_str())));
    }
}

Rows Columns::operator[](const char* name) const {
    for (const auto& [known, rows] : columns_)
        if (known == name) return rows;
    return {};
}

Rows Columns::required(const char* name) const {
    for (const auto& [known, rows] : columns_)
        if (known == name) return rows;
    refuse(std::string("there is no column \"") + name + "\"");
}

std::size_t stride_of(std::size_t given, std::size_t record, const char* name) {
    if (given < record)
        refuse(std::string(name) + ": a stride of " + std::to_string(given) + " bytes is less than the " +
               std::to_string(record) + " of a record");
    return given;
}

vec3 three_of(const float* values, const char* name) {
    given(values, name);
    return {values[0], values[1], values[2]};
}

std::string json_of_words(const std::vector<std::string>& words) {
    Text text;
    text << "[";
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text << ", ";
        text.quoted(words[i]);
    }
    text << "]";
    return text.take();
}

}  // namespace scree::c
