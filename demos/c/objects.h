// What handles of the C interface name, and how calls get at it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "compute/measures.h"
#include "compute/scene_file/events.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "demos/c/call.h"
#include "demos/c/handles.h"
#include "demos/film/drawing.h"
#include "demos/film/pages/page_recording.h"
#include "demos/program/backend.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/outputs/export_file.h"

namespace scree::c {

struct SceneObject {
    SceneDocument document;
    std::vector<std::string> notes;  // what was changed or left out in reading it
    mutable std::shared_mutex in_use;
};

// A canvas and what it was made for.
struct Easel {
    host::CanvasOptions options;
    std::string canvas;  // auto, vulkan or gl
    std::optional<std::size_t> copy;
    std::unique_ptr<demos::Drawing> drawing;
};

struct WorldObject {
    WorldObject(const SceneDocument& document, World made, const demos::Backend& backend)
        : machine(backend),
          shown{{}, document.viewpoint, document.settings, document.duration, document.picture, document.events,
                {}, document.measures},
          world(std::move(made)) {}
    WorldObject(const WorldObject&) = delete;
    ~WorldObject();  // ends its exports

    demos::Backend machine;
    SceneDocument shown;  // how it is run and shown; without the scene, which the world has
    World world;
    std::optional<demos::LoadedScene> subject;  // for colour ranges; made for the first picture
    std::optional<Measuring> measuring;
    std::optional<Measures> measured;  // last
    std::vector<Easel> easels;
    std::vector<std::shared_ptr<demos::Animation>> exports;       // being recorded
    std::vector<std::weak_ptr<demos::PageRecording>> recordings;  // likewise; their handles hold them
    std::atomic<std::size_t> views = 0;                           // that look into its tables
    demos::Script before_step;                                    // of a demo that it follows
    std::shared_mutex in_use;

    const demos::LoadedScene& as_subject();
    void require_no_views(const char* what) const;  // throws Failure
};

struct ViewObject {
    std::shared_ptr<WorldObject> world;
};
struct ExportObject {
    std::weak_ptr<WorldObject> world;
    std::shared_ptr<demos::Animation> file;
};

struct RecordingObject {
    std::weak_ptr<WorldObject> world;
    std::shared_ptr<demos::PageRecording> page;
    bool is_live = false;
    std::mutex in_use;
};

// Throws Failure.
demos::LoadedScene demo_given(const std::string& name, std::size_t bodies, std::uint64_t seed);
// A camera of the caller, and the scene's style with what a look of it changes. Throw Failure.
host::Camera camera_given(const char* json, const char* name);
PictureStyle style_given(const SceneDocument& shown, const char* look_json);

// What a handle names, in use by this call. Throws Failure for a handle that names nothing, and while another thread is in it.
template <class Handle>
class Use {
public:
    explicit Use(Handle* handle) : object_(object_of(handle)) {
        if constexpr (std::is_const_v<Handle>)
            shared_ = std::shared_lock(object_->in_use, std::try_to_lock);
        else
            alone_ = std::unique_lock(object_->in_use, std::try_to_lock);
        if (!shared_.owns_lock() && !alone_.owns_lock())
            throw Failure(SCREE_BUSY, "the scene or world is in use by another call");
    }
    auto& operator*() const { return *object_; }
    auto* operator->() const { return object_.get(); }
    const auto& shared() const { return object_; }

private:
    using Object = typename decltype(object_of(std::declval<Handle*>()))::element_type;
    std::shared_ptr<Object> object_;
    std::shared_lock<std::shared_mutex> shared_;
    std::unique_lock<std::shared_mutex> alone_;
};
using UsedScene = Use<scree_scene>;
using ReadScene = Use<const scree_scene>;
using UsedWorld = Use<scree_world>;

// "all" for SCREE_ALL_COPIES; throws Failure for a copy that is not there.
std::optional<std::size_t> copy_of(const World& world, std::size_t copy);

// Throws Failure naming the body, joint or vehicle that is not there.
std::vector<std::size_t> indices_of(const std::int64_t* given, std::size_t count, std::size_t most, const char* what);
std::size_t index_of(std::size_t given, std::size_t most, const char* what);

// A column of the caller; without rows where it gave none.
class Rows {
public:
    Rows() = default;
    Rows(const void* data, std::size_t stride) : data_(static_cast<const char*>(data)), stride_(stride) {}
    explicit operator bool() const { return data_ != nullptr; }
    template <class Value>
    Value at(std::size_t row) const {
        Value value;
        std::memcpy(&value, data_ + row * stride_, sizeof value);
        return value;
    }
    template <class Value>
    std::optional<Value> maybe(std::size_t row) const {
        return data_ ? std::optional(at<Value>(row)) : std::nullopt;
    }

private:
    const char* data_ = nullptr;
    std::size_t stride_ = 0;
};

// The caller's columns by name: those that are known, of so many floats a row.
class Columns {
public:
    struct Known {
        const char* name;
        int width;
    };
    Columns(const scree_column* columns, std::size_t count, std::size_t rows, const std::vector<Known>& known);
    Rows operator[](const char* name) const;
    Rows required(const char* name) const;  // throws Failure where there is none

private:
    std::vector<std::pair<std::string, Rows>> columns_;
};

// As `given`, with a stride that is not below a record's size.
std::size_t stride_of(std::size_t given, std::size_t record, const char* name);

vec3 three_of(const float* values, const char* name);  // throws Failure for null

// The first two of that name.
template <class Things>
std::vector<std::uint64_t> first_named(const Things& things, std::size_t count, const std::string& name) {
    std::vector<std::uint64_t> found;
    for (std::size_t i = 0; i < count && found.size() < 2; ++i)
        if (things[i].name == name) found.push_back(i);
    return found;
}
std::string json_of_words(const std::vector<std::string>& words);
template <class Things>
std::string names_json(const Things& things, std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(things[i].name);
    return json_of_words(names);
}

}  // namespace scree::c
