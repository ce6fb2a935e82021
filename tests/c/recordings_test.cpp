// The C interface: recordings that play in a browser, and chunks for live viewers.
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/c/interface.h"
#include "tests/temporary_folder.h"

using namespace scree::c_tests;

namespace {

class Recording {
public:
    explicit Recording(scree_world* world, const scree_record_options& options) {
        ok(scree_world_record(world, &options, &handle_));
    }
    Recording(const Recording&) = delete;
    ~Recording() { scree_recording_release(handle_); }
    operator scree_recording*() const { return handle_; }
    std::uint64_t count() const {
        std::uint64_t frames = 0;
        ok(scree_recording_count(handle_, &frames));
        return frames;
    }
    std::string page() const {
        scree_array bytes;
        ok(scree_recording_page(handle_, &bytes));
        return {static_cast<const char*>(bytes.data), bytes.count};
    }
    // The names of the chunks of a live one.
    std::vector<std::string> take(int frame) const {
        scree_array bytes;
        ok(scree_recording_take(handle_, frame, &bytes));
        const std::string all(static_cast<const char*>(bytes.data), bytes.count);
        std::vector<std::string> names;
        for (std::size_t at = 0; at < all.size();) {
            std::uint32_t size = 0;
            std::memcpy(&size, &all.at(at + 4), sizeof size);
            names.push_back(all.substr(at, 4));
            at += 8 + size;
        }
        return names;
    }

private:
    scree_recording* handle_ = nullptr;
};

scree_record_options usual() {
    return SCREE_INIT(scree_record_options);
}

// Frames that the blocks of a page say that they have.
std::size_t frames_of(const std::string& page) {
    std::size_t frames = 0;
    const std::string key = "data-frames=\"";
    for (std::size_t at = page.find(key); at != std::string::npos; at = page.find(key, at + 1))
        frames += std::stoul(page.substr(at + key.size()));
    return frames;
}

bool has_viewer(scree_world* world) {
    scree_recording* made = nullptr;
    if (scree_world_record(world, nullptr, &made) == SCREE_OK) {
        scree_recording_release(made);
        return true;
    }
    CHECK(std::string(scree_error_message()).find("esbuild") != std::string::npos);
    return false;
}

}  // namespace

TEST_CASE("c: a recording is a page of the steps since it began, as often as it is asked for, and after its world") {
    const scree::tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "run.html").string();
    scree_world* world = nullptr;
    scree_world_options options = SCREE_INIT(scree_world_options);
    options.backend = "cpu";
    ok(scree_world_create(balls(3), &options, &world));
    if (!has_viewer(world)) {
        scree_world_release(world);
        return;
    }
    scree_record_options wanted = usual();
    wanted.title = "<three> & more";
    wanted.fps = 20;
    const Recording recording(world, wanted);
    CHECK(recording.count() == 1);
    ok(scree_world_step(world, 30, nullptr, nullptr));
    CHECK(recording.count() == 11);
    const std::string first = recording.page();
    CHECK(first.find("<title>&lt;three&gt; &amp; more · scree</title>") != std::string::npos);
    CHECK(frames_of(first) == 11);
    CHECK(first.ends_with("</html>\n"));
    CHECK(recording.page() == first);
    ok(scree_world_step(world, 90, nullptr, nullptr));
    CHECK(frames_of(recording.page()) == 41);
    ok(scree_recording_stop(recording));
    ok(scree_world_step(world, 30, nullptr, nullptr));
    CHECK(recording.count() == 41);
    const std::string whole = recording.page();
    scree_world_release(world);
    CHECK(recording.page() == whole);
    ok(scree_recording_save(recording, file.c_str()));
    std::ifstream saved(file, std::ios::binary);
    CHECK(std::string(std::istreambuf_iterator<char>(saved), {}) == whole);
    refused(scree_recording_save(recording, (folder.path() / "none" / "run.html").string().c_str()), SCREE_FILE_ERROR,
            "run.html");
    refused(scree_recording_take(recording, 1, nullptr), SCREE_BAD_ARGUMENT, "bytes: is null");
}

TEST_CASE("c: a recording changes no bits, and its world's events stay unless it is to have them") {
    const World world(balls(3)), other(balls(3));
    if (!has_viewer(world)) return;
    scree_event_options events = SCREE_INIT(scree_event_options);
    events.contacts = 1;
    ok(scree_world_set_events(world, &events));
    scree_record_options wanted = usual();
    {
        const Recording recording(world, wanted);
        world.step(60);
        other.step(60);
        scree_array told;
        ok(scree_world_take_events(world, &told));
        CHECK(told.count > 0);
    }
    CHECK(world.hash() == other.hash());
    wanted.events = 1;
    const Recording recording(world, wanted);
    CHECK(world.info().records_events == 1);
}

TEST_CASE("c: a live recording gives what is new in the scene, and frames when they are asked for") {
    const World world(balls(2));
    scree_record_options wanted = usual();
    wanted.live = 1;
    const Recording live(world, wanted);
    CHECK(live.take(1) == std::vector<std::string>{"head", "body", "fram"});
    CHECK(live.take(0).empty());
    world.step(5);
    CHECK(live.take(1) == std::vector<std::string>{"fram"});
    scree_array added;
    ok(scree_world_add_bodies(world, balls(1), &added));
    CHECK(live.take(0) == std::vector<std::string>{"body"});
    scree_array bytes;
    refused(scree_recording_page(live, &bytes), SCREE_IMPOSSIBLE, "live");
    refused(scree_recording_save(live, "run.html"), SCREE_IMPOSSIBLE, "live");
}

TEST_CASE("c: recordings are refused what they cannot do") {
    scree_record_options wanted = usual();
    scree_recording* made = nullptr;
    refused(scree_world_record(nullptr, &wanted, &made), SCREE_BAD_HANDLE, "null");
    const World world(balls(1));
    refused(scree_world_record(world, &wanted, nullptr), SCREE_BAD_ARGUMENT, "made");
    wanted.live = 1;
    for (const double fps : {-1.0, 1e-9, 1e9, static_cast<double>(NAN)}) {
        wanted.fps = fps;
        refused(scree_world_record(world, &wanted, &made), SCREE_BAD_ARGUMENT, "fps");
    }
    wanted.fps = 0;
    wanted.contacts = 2;
    refused(scree_world_record(world, &wanted, &made), SCREE_BAD_ARGUMENT, "contacts");
    wanted.contacts = 0;
    wanted.copy = 1;
    refused(scree_world_record(world, &wanted, &made), SCREE_BAD_INDEX, "copy");
    wanted.copy = 0;
    wanted.look_json = R"({"sky": "green"})";
    refused(scree_world_record(world, &wanted, &made), SCREE_BAD_SCENE, "sky");
    wanted.look_json = nullptr;
    wanted.camera_json = R"({"eye": [0, 0]})";
    refused(scree_world_record(world, &wanted, &made), SCREE_BAD_SCENE, "eye");
    wanted.camera_json = nullptr;
    ok(scree_world_record(world, &wanted, &made));
    // Within a step its world is in use; released there, it ends.
    struct Asked {
        scree_recording* recording;
        scree_result result = SCREE_OK;
    } asked{made};
    const scree_progress ask = [](void* user, std::uint64_t, std::uint64_t) {
        auto& of = *static_cast<Asked*>(user);
        scree_array bytes;
        of.result = scree_recording_take(of.recording, 0, &bytes);
        scree_recording_release(of.recording);
        return 1;
    };
    CHECK(scree_world_step(world, 100000, ask, &asked) == SCREE_STOPPED);
    CHECK(asked.result == SCREE_BUSY);
    std::uint64_t frames = 0;
    refused(scree_recording_count(made, &frames), SCREE_BAD_HANDLE, "recording's, or it was released");
    scree_recording_release(nullptr);
}
