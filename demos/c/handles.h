// Handles of the C interface: numbers that look like pointers, so that one that was released or never given is known as such.
#pragma once

#include <memory>

#include "demos/c/scree.h"

namespace scree::c {

struct SceneObject;
struct WorldObject;
struct ViewObject;
struct ExportObject;
struct RecordingObject;

enum class HandleKind { scene, world, view, export_file, recording };

// All of these may be called by several threads.
const void* issue(HandleKind kind, std::shared_ptr<void> object);
std::shared_ptr<void> held(HandleKind kind, const void* handle);            // throws Failure for a handle that names none
std::shared_ptr<void> ended(HandleKind kind, const void* handle) noexcept;  // takes it away; null if it names none

inline scree_scene* handle_of(std::shared_ptr<SceneObject> object) {
    return static_cast<scree_scene*>(const_cast<void*>(issue(HandleKind::scene, std::move(object))));
}
inline scree_world* handle_of(std::shared_ptr<WorldObject> object) {
    return static_cast<scree_world*>(const_cast<void*>(issue(HandleKind::world, std::move(object))));
}
inline scree_view* handle_of(std::shared_ptr<ViewObject> object) {
    return static_cast<scree_view*>(const_cast<void*>(issue(HandleKind::view, std::move(object))));
}
inline scree_export* handle_of(std::shared_ptr<ExportObject> object) {
    return static_cast<scree_export*>(const_cast<void*>(issue(HandleKind::export_file, std::move(object))));
}
inline scree_recording* handle_of(std::shared_ptr<RecordingObject> object) {
    return static_cast<scree_recording*>(const_cast<void*>(issue(HandleKind::recording, std::move(object))));
}
inline std::shared_ptr<SceneObject> object_of(const scree_scene* handle) {
    return std::static_pointer_cast<SceneObject>(held(HandleKind::scene, handle));
}
inline std::shared_ptr<WorldObject> object_of(const scree_world* handle) {
    return std::static_pointer_cast<WorldObject>(held(HandleKind::world, handle));
}
inline std::shared_ptr<ExportObject> object_of(const scree_export* handle) {
    return std::static_pointer_cast<ExportObject>(held(HandleKind::export_file, handle));
}
inline std::shared_ptr<RecordingObject> object_of(const scree_recording* handle) {
    return std::static_pointer_cast<RecordingObject>(held(HandleKind::recording, handle));
}

}  // namespace scree::c
