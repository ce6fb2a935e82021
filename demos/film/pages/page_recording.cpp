// Writes a page with the viewer and the frames of a run.
#include "demos/film/pages/page_recording.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "demos/film/pages/chunk_bytes.h"
#include "demos/film/pages/frame_encoder.h"
#include "demos/film/pages/page_parts.h"
#include "demos/film/pages/viewer_page.h"
#include "demos/film/pages/world_chunks.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

constexpr std::string_view place_of_title = "<title>scree</title>", place_of_data = "<!-- recording -->";
constexpr double seconds_of_block = 1.5;          // what a reader reads again to get to a moment
constexpr std::size_t most_of_block = 4u << 20;   // bytes before compression
constexpr std::size_t most_of_events = 1u << 18;  // likewise, of all events

std::string base64(std::string_view bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string as_html(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (static_cast<unsigned char>(c) >= 32)
            safe += c;
    }
    return safe;
}

}  // namespace

struct PageRecording::Impl {
    World& world;
    PageOptions options;
    std::optional<host::GrowingFile> file{};
    std::string kept{};  // the page so far, without a file
    int every;
    double start;  // s
    FrameUnits units;
    FrameEncoder encoder;
    WorldChunks chunks;
    std::string block{};  // frames that are not written yet
    std::size_t first_of_block = 0, frames = 0;
    bool block_is_whole = false, has_told_head = false;
    ChunkBytes events{};  // that are not written yet
    std::size_t event_count = 0;
    std::uint64_t recorded = std::numeric_limits<std::uint64_t>::max();  // at this step
    double seconds_encoding = 0;

    Impl(World& of, PageOptions&& chosen)
        : world(of),
          options(std::move(chosen)),
          every(std::max(1, static_cast<int>(std::lround(static_cast<double>(of.settings().rate) / options.fps)))),
          start(of.time()),
          units(units_of(of, options, every / static_cast<double>(of.settings().rate))),
          encoder(units),
          chunks(options.shown) {}

    double frame_seconds() const { return every / static_cast<double>(world.settings().rate); }

    void put(std::string_view text) {
        if (file)
            file->append(text);
        else
            kept += text;
    }
    static std::string element(const char* kind, const std::string& content, const std::string& more = "") {
        return std::string("<script type=\"application/x-scree\" data-kind=\"") + kind + "\"" + more + ">" +
               base64(packed_block(content)) + "</script>\n";
    }
    // Frames that are not written yet; none: nothing.
    std::string pending() const {
        if (frames == first_of_block) return "";
        return element("frames", block,
                       " data-first=\"" + std::to_string(first_of_block) + "\" data-frames=\"" +
                           std::to_string(frames - first_of_block) + "\" data-whole=\"" + (block_is_whole ? "1" : "0") + "\"");
    }
    void put_frames() {
        put(pending());
        block.clear();
        first_of_block = frames;
    }

    std::string pending_events() const {
        ChunkBytes all;
        all.count(event_count);
        all.append(events);
        std::string chunk;
        append_chunk(chunk, "evnt", all);
        return element("events", chunk);
    }
    void put_events() {
        put(pending_events());
        event_count = 0;
        events = {};
    }

    void add_head(std::string& to) const;
    std::string end() const;  // what follows the frames
    void begin();
    void record();
    void record_frame();
    void add_frame(std::string& to, bool whole);
};

void PageRecording::Impl::begin() {
    const std::string_view page = viewer_page();
    const std::size_t title = page.find(place_of_title), data = page.find(place_of_data);
    if (title == page.npos || data == page.npos || data < title) throw std::logic_error(why_not());
    put(page.substr(0, title));
    put("<title>" + as_html(options.title) + " · scree</title>");
    put(page.substr(title + place_of_title.size(), data - title - place_of_title.size()));
    if (options.events) ask_for_events(world);
    std::string chunk;
    add_head(chunk);
    chunks.take_new(chunk, world);
    put(element("scene", chunk));
    record();
}

void PageRecording::Impl::add_head(std::string& to) const {
    ChunkBytes told;
    told.bytes = head_of(world, options, units, frame_seconds(), start);
    append_chunk(to, "head", told);
}

std::string PageRecording::Impl::end() const {
    const std::string_view page = viewer_page();
    return pending_events().append(page.substr(page.find(place_of_data) + place_of_data.size()));
}

void PageRecording::Impl::record() {
    if (recorded == world.steps()) return;
    recorded = world.steps();
    const auto begun = std::chrono::steady_clock::now();
    record_frame();
    seconds_encoding += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

void PageRecording::Impl::record_frame() {
    if (options.events) event_count += add_events(events, world, chunks, start);
    if (events.bytes.size() > most_of_events) put_events();
    std::string fresh;
    if (frames > 0) chunks.take_new(fresh, world);
    const auto frames_of_block = static_cast<std::size_t>(std::max(1.0, std::round(seconds_of_block / frame_seconds())));
    const bool too_long = block.size() > most_of_block;
    const bool whole = frames % frames_of_block == 0;
    if (whole || too_long || !fresh.empty()) put_frames();
    if (!fresh.empty()) put(element("scene", fresh));
    if (frames == first_of_block) block_is_whole = whole;
    add_frame(block, whole);
}

void PageRecording::Impl::add_frame(std::string& to, bool whole) {
    ChunkBytes frame;
    frame.f64(world.time() - start);
    frame.count(world.steps());
    const bool joints = !world.scene().joints.empty();
    const std::vector<BodyMoment>& moments = chunks.look(world);
    frame.u8((whole ? 1u : 0u) | (options.contacts ? 2u : 0u) | (joints ? 4u : 0u) | (options.camera ? 8u : 0u));
    encoder.encode(frame, moments, whole);
    if (options.contacts) chunks.add_contacts(frame, world, units, encoder.followers(), whole);
    if (joints) chunks.add_joints(frame, world, units, whole);
    if (options.camera) {
        const host::Camera camera = options.camera(world.time());
        frame.vector(camera.eye);
        frame.vector(camera.target);
        frame.f32(camera.vertical_fov);
        frame.u8(camera.orthographic ? 1 : 0);
    }
    append_chunk(to, "fram", frame);
    ++frames;
}

bool PageRecording::is_possible() {
    return !viewer_page().empty();
}

std::string PageRecording::why_not() {
    return "this program was built without its viewer: install esbuild (apt-get install esbuild), configure and build again";
}

PageRecording::PageRecording() = default;

PageRecording::PageRecording(World& world, PageOptions options) {
    if (!is_possible()) throw std::logic_error(why_not());
    interior_ = std::make_unique<Impl>(world, std::move(options));
    interior_->begin();
}

PageRecording::PageRecording(const std::filesystem::path& path, World& world, PageOptions options) {
    if (!is_possible()) throw std::logic_error(why_not());
    interior_ = std::make_unique<Impl>(world, std::move(options));
    interior_->file.emplace(path);
    interior_->begin();
}

std::unique_ptr<PageRecording> PageRecording::live(World& world, PageOptions options) {
    std::unique_ptr<PageRecording> made(new PageRecording);
    options.events = false;
    made->interior_ = std::make_unique<Impl>(world, std::move(options));
    return made;
}

PageRecording::~PageRecording() = default;

int PageRecording::steps_until_due() const {
    const auto steps = static_cast<std::uint64_t>(interior_->every);
    return static_cast<int>(steps - interior_->world.steps() % steps);
}

void PageRecording::after_step() {
    Impl& in = *interior_;
    if (in.world.steps() % static_cast<std::uint64_t>(in.every) == 0) in.record();
}

void PageRecording::finish() {
    Impl& in = *interior_;
    in.put_frames();
    in.put(in.end());
    in.file.value().commit();
}

std::string PageRecording::page() const {
    return interior_->kept + interior_->pending() + interior_->end();
}

std::string PageRecording::take(bool frame) {
    Impl& in = *interior_;
    std::string chunks;
    if (!in.has_told_head) in.add_head(chunks);
    in.has_told_head = true;
    in.chunks.take_new(chunks, in.world);
    if (frame) in.add_frame(chunks, in.frames == 0);
    return chunks;
}

PageFigures PageRecording::figures() const {
    return {interior_->frames, interior_->file ? interior_->file->size() : interior_->kept.size(), interior_->seconds_encoding};
}

}  // namespace scree::demos
