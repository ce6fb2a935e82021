// A world as the Python module holds it.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene_file/events.h"
#include "compute/world.h"
#include "demos/film/drawing.h"
#include "demos/program/backend.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/outputs/export_file.h"
#include "demos/python/module/bindings.h"

namespace scree::python {

// A canvas and what it was made for.
struct Easel {
    host::CanvasOptions options;
    std::string canvas;  // auto, vulkan or gl
    std::optional<std::size_t> copy;
    std::unique_ptr<demos::Drawing> drawing;
};

struct WorldObject : std::enable_shared_from_this<WorldObject> {
    WorldObject(const SceneDocument& document, World made, const demos::Backend& backend);
    ~WorldObject();  // writes the animations that are still recorded

    demos::Backend machine;
    SceneDocument shown;  // how it is run and shown; without the scene, which the world has
    World world;
    std::optional<demos::LoadedScene> subject;  // for colour ranges; made for the first picture
    std::vector<Easel> easels;
    std::vector<std::shared_ptr<demos::Animation>> exports;  // being recorded
    int views = 0;                                           // arrays that look into its tables
    bool busy = false;                                       // a thread is in it, without Python's lock
    double batch_seconds = 1;                                // that the last steps took; at first unknown
    std::future<void> left;                                  // steps that an interrupt left to end by themselves

    const demos::LoadedScene& as_subject();
    void close_exports();
    void await_left();
    // Throws BufferError while arrays look into the tables, naming what is to be done.
    void require_no_views(const char* what) const;
};

// The world in use by this call: throws RuntimeError if another thread steps or draws it.
class Use {
public:
    explicit Use(WorldObject& object) : object_(object) {
        if (object.busy) throw std::runtime_error("the world is in use by another thread");
        object.await_left();
        object.busy = true;
    }
    ~Use() { object_.busy = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    World& operator*() const { return object_.world; }
    World* operator->() const { return &object_.world; }

private:
    WorldObject& object_;
};

using WorldClass = py::class_<WorldObject, std::shared_ptr<WorldObject>>;
void bind_state(WorldClass& of_world);
void bind_changes(WorldClass& of_world);
void bind_records(py::module_& module, WorldClass& of_world);
void bind_queries(py::module_& module, WorldClass& of_world);
void bind_pictures(py::module_& module, WorldClass& of_world);
void bind_tables(WorldClass& of_world);

}  // namespace scree::python
