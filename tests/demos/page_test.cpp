// Pages that play a run: blocks that can be read, bodies with their names, births and breaks, and a bound of their size.
#include <zlib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/film/pages/page_recording.h"
#include "demos/program/loaded_scene.h"
#include "tests/temporary_folder.h"

using namespace scree;
using scree::demos::PageOptions;
using scree::demos::PageRecording;
using scree::tests::TemporaryFolder;

namespace {

std::string from_base64(std::string_view text) {
    std::string bytes;
    std::uint32_t word = 0;
    int bits = 0;
    for (const char c : text) {
        const std::size_t digit = std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
        if (digit == std::string_view::npos) break;
        word = word << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(word >> bits & 255u);
    }
    return bytes;
}

std::string inflated(const std::string& block) {
    REQUIRE(block.at(0) == '\1');
    std::string out(1 << 16, '\0');
    for (;;) {
        uLongf size = static_cast<uLongf>(out.size());
        const int code = uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(block.data()) + 1,
                                    static_cast<uLong>(block.size() - 1));
        if (code == Z_BUF_ERROR) {
            out.resize(4 * out.size());
            continue;
        }
        REQUIRE(code == Z_OK);
        out.resize(size);
        return out;
    }
}

struct Chunk {
    std::string block, name, content;
};

// All chunks of a page in order, with the kinds of their blocks.
std::vector<Chunk> chunks_of(const std::string& page) {
    std::vector<Chunk> chunks;
    const std::string begin = "<script type=\"application/x-scree\" data-kind=\"";
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
        const std::size_t kind = at + begin.size(), content = page.find('>', at) + 1, end = page.find("</script>", at);
        const std::string block = inflated(from_base64(std::string_view(page).substr(content, end - content)));
        for (std::size_t from = 0; from < block.size();) {
            std::uint32_t size = 0;
            std::memcpy(&size, &block.at(from + 4), sizeof size);
            chunks.push_back(
                {page.substr(kind, page.find('"', kind) - kind), block.substr(from, 4), block.substr(from + 8, size)});
            from += 8 + size;
        }
    }
    return chunks;
}

std::size_t count_of(const std::vector<Chunk>& chunks, const std::string& name) {
    return static_cast<std::size_t>(
        std::count_if(chunks.begin(), chunks.end(), [&](const Chunk& chunk) { return chunk.name == name; }));
}

Body box_at(vec3 position, const std::string& name) {
    Body body;
    body.name = name;
    body.shape = Box{};
    body.position = position;
    return body;
}

Scene with_ground() {
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    return scene;
}

}  // namespace

TEST_CASE("recordings: a page holds its frames, and names that are no elements of it") {
    if (!PageRecording::is_possible()) return;
    const TemporaryFolder place;
    const std::string wicked = "</script><img src=x onerror=alert(1)>";
    Scene scene = with_ground();
    scene.bodies.push_back(box_at({0, 2, 0}, wicked));
    World world(scene);
    {
        PageRecording page(place / "run.html", world, {.title = "<b>run & more</b>"});
        for (int i = 0; i < 60; ++i) {
            world.step();
            page.after_step();
        }
        page.finish();
        CHECK(page.figures().frames == 31);
        CHECK(page.figures().bytes == std::filesystem::file_size(place / "run.html"));
    }
    const std::string page = place.read("run.html");
    CHECK(page.find("<img") == std::string::npos);
    CHECK(page.find("<b>") == std::string::npos);
    CHECK(page.find("<title>&lt;b&gt;run &amp; more&lt;/b&gt; · scree</title>") != std::string::npos);
    CHECK(page.find("http://") == std::string::npos);
    CHECK(page.find("https://") == std::string::npos);
    const std::vector<Chunk> chunks = chunks_of(page);
    REQUIRE(chunks.at(0).name == "head");
    const nlohmann::json head = nlohmann::json::parse(chunks[0].content);
    CHECK(head["format"] == 1);
    CHECK(head["title"] == "<b>run & more</b>");
    CHECK(head["seconds"].get<double>() == Approx(1.0 / 30));
    CHECK(head["errors"]["position"].get<double>() < 2e-3);
    CHECK(head["colors"]["scales"]["momentum"]["unit"] == "kg m/s");
    CHECK(count_of(chunks, "fram") == 31);
    REQUIRE(count_of(chunks, "body") == 1);
    CHECK(chunks.at(1).content.find(wicked) != std::string::npos);
    CHECK(chunks.back().name == "evnt");
    // The plane's and the box's first touch.
    CHECK(chunks.back().content.at(0) >= 1);
}

TEST_CASE("recordings: bodies that come during a run are told before their first frame") {
    if (!PageRecording::is_possible()) return;
    const TemporaryFolder place;
    Scene scene = with_ground();
    scene.bodies.push_back(box_at({0, 2, 0}, "first"));
    World world(scene);
    PageRecording page(place / "run.html", world, {.title = "run"});
    world.step(2);
    page.after_step();
    Scene more;
    more.bodies.push_back(box_at({3, 2, 0}, "second"));
    world.add_bodies(more.bodies);
    world.step(2);
    page.after_step();
    page.finish();
    std::string order;
    for (const Chunk& chunk : chunks_of(place.read("run.html"))) order += chunk.name + " ";
    CHECK(order == "head body fram fram body fram evnt ");
}

TEST_CASE("recordings: events and frames change no bit of a run, and an unfinished page leaves no file") {
    if (!PageRecording::is_possible()) return;
    const TemporaryFolder place;
    Scene scene = with_ground();
    for (int i = 0; i < 20; ++i)
        scene.bodies.push_back(box_at({0.1f * static_cast<float>(i % 3), 1.0f + 1.2f * static_cast<float>(i), 0}, ""));
    World alone(scene), watched(scene);
    {
        PageRecording page(place / "run.html", watched, {.title = "run"});
        for (int i = 0; i < 90; ++i) {
            watched.step();
            page.after_step();
        }
    }
    alone.step(90);
    CHECK(alone.state_hash() == watched.state_hash());
    CHECK(std::filesystem::is_empty(place.path()));
}

// A run of 4,000 bodies and 12 s is to take less than 10 MB; this is a twentieth of it.
TEST_CASE("recordings: a pile takes less than 200 bytes for a body and second") {
    if (!PageRecording::is_possible()) return;
    const TemporaryFolder place;
    demos::SceneOptions options;
    options.name = "pile";
    options.bodies = 400;
    const demos::LoadedScene subject = demos::load_subject(options);
    World world(subject.scene, subject.settings(options));
    PageOptions chosen;
    chosen.title = "pile";
    chosen.contacts = false;
    PageRecording page(place / "run.html", world, chosen);
    const std::uint64_t empty = page.figures().bytes;
    for (int i = 0; i < 360; ++i) {
        world.step();
        page.after_step();
    }
    page.finish();
    CHECK(page.figures().bytes - empty < 400 * 6 * 200);
}
