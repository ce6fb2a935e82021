// The C interface: recordings that play in a browser, and what a live viewer draws.
#include <string>
#include <utility>

#include "demos/c/json.h"
#include "demos/c/objects.h"
#include "demos/film/pages/page_parts.h"
#include "host/files/growing_file.h"

namespace scree::c {

namespace {

demos::PageOptions page_options(WorldObject& object, const scree_record_options& wanted) {
    if (wanted.fps != 0 && !(wanted.fps >= 1e-3 && wanted.fps <= 1e6))
        refuse("fps: must be 0, or between 0.001 and 1e6 frames a second");
    if (wanted.contacts < -1 || wanted.contacts > 1)
        refuse("contacts: must be -1, 0 or 1, is " + std::to_string(wanted.contacts));
    const demos::LoadedScene& subject = object.as_subject();
    demos::PageOptions page;
    page.style = style_given(object.shown, wanted.look_json);
    demos::take_look(page, subject, object.world.settings(), false);
    page.title = subject.title();
    if (wanted.title != nullptr) page.title = text_of(wanted.title, "title");
    if (wanted.fps > 0) page.fps = wanted.fps;
    host::Camera camera;
    if (wanted.camera_json != nullptr) {
        camera = camera_given(wanted.camera_json, "camera_json");
    } else {
        camera.eye = subject.viewpoint.eye;
        camera.target = subject.viewpoint.target;
        camera.vertical_fov = subject.viewpoint.vertical_fov;
        camera.orthographic = subject.viewpoint.orthographic;
    }
    page.camera = [camera](double) { return camera; };
    if (const std::optional<std::size_t> copy = copy_of(object.world, wanted.copy)) page.shown = {.first = *copy, .count = 1};
    page.contacts =
        wanted.contacts > 0 || (wanted.contacts == 0 && object.world.scene().bodies.size() <= demos::most_with_contacts);
    page.events = wanted.events != 0;
    return page;
}

// The recording, used by this call and no other.
class UsedRecording {
public:
    explicit UsedRecording(scree_recording* handle)
        : object_(object_of(handle)), lock_(object_->in_use, std::try_to_lock), world_(object_->world.lock()) {
        if (world_) within_ = std::unique_lock(world_->in_use, std::try_to_lock);
        if (!lock_.owns_lock() || (world_ && !within_.owns_lock()))
            throw Failure(SCREE_BUSY, "the recording or its world is in use by another call");
    }
    RecordingObject* operator->() const { return object_.get(); }
    WorldObject* world() const { return world_.get(); }
    std::string page() const {
        if (object_->is_live) throw Failure(SCREE_IMPOSSIBLE, "a live recording keeps no page");
        return object_->page->page();
    }

private:
    std::shared_ptr<RecordingObject> object_;
    std::unique_lock<std::mutex> lock_;
    std::shared_ptr<WorldObject> world_;
    std::unique_lock<std::shared_mutex> within_;
};

scree_array kept_bytes(const std::string& text) {
    return kept_array(std::vector<char>(text.begin(), text.end()));
}

}  // namespace

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

scree_result scree_world_record(scree_world* world, const scree_record_options* options, scree_recording** made) {
    return called([&] {
        given(made, "made");
        const UsedWorld used(world);
        const scree_record_options wanted = options_of(options);
        const bool is_live = wanted.live != 0;
        if (!is_live && !demos::PageRecording::is_possible()) throw Failure(SCREE_IMPOSSIBLE, demos::PageRecording::why_not());
        demos::PageOptions page = page_options(*used, wanted);
        const auto object = std::make_shared<RecordingObject>();
        object->world = used.shared();
        object->is_live = is_live;
        if (is_live) {
            object->page = demos::PageRecording::live(used->world, std::move(page));
        } else {
            object->page = std::make_shared<demos::PageRecording>(used->world, std::move(page));
            std::erase_if(used->recordings, [](const auto& one) { return one.expired(); });
            used->recordings.push_back(object->page);
        }
        *made = handle_of(object);
    });
}

scree_result scree_recording_count(scree_recording* recording, uint64_t* frames) {
    return called([&] {
        given(frames, "frames");
        *frames = UsedRecording(recording)->page->figures().frames;
    });
}

scree_result scree_recording_page(scree_recording* recording, scree_array* bytes) {
    return called([&] {
        given(bytes, "bytes");
        *bytes = kept_bytes(UsedRecording(recording).page());
    });
}

scree_result scree_recording_save(scree_recording* recording, const char* path) {
    return called([&] {
        const std::string name = text_of(path, "path");
        const std::string page = UsedRecording(recording).page();
        host::GrowingFile file(name);
        file.append(page);
        file.commit();
    });
}

scree_result scree_recording_take(scree_recording* recording, int frame, scree_array* bytes) {
    return called([&] {
        given(bytes, "bytes");
        const UsedRecording used(recording);
        if (!used->is_live) throw Failure(SCREE_IMPOSSIBLE, "chunks are those of a live recording");
        if (used.world() == nullptr) throw Failure(SCREE_IMPOSSIBLE, "the recording's world is gone");
        *bytes = kept_bytes(used->page->take(frame != 0));
    });
}

scree_result scree_recording_stop(scree_recording* recording) {
    return called([&] {
        const UsedRecording used(recording);
        if (used.world() == nullptr) return;
        std::erase_if(used.world()->recordings, [&](const auto& page) { return page.expired() || page.lock() == used->page; });
    });
}

void scree_recording_release(scree_recording* recording) {
    released([&] { ended(HandleKind::recording, recording); });
}
