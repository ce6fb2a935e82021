// Writes a page with the viewer and the frames of a run.
#include "demos/film/page_recording.h"

#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/picture_style_fields.h"
#include "demos/film/chunk_bytes.h"
#include "demos/film/frame_encoder.h"
#include "demos/film/viewer_page.h"
#include "demos/film/world_chunks.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

using nlohmann::json;

constexpr std::string_view place_of_title = "<title>scree</title>", place_of_data = "<!-- recording -->";
constexpr double seconds_of_block = 1.5;          // what a reader reads again to get to a moment
constexpr std::size_t most_of_block = 4u << 20;   // bytes before compression
constexpr std::size_t most_of_events = 1u << 18;  // likewise, of all events
constexpr std::size_t most_hits = 32;             // of a frame, the strongest

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

// A block as it is sent: 1, and the chunks as a zlib stream.
std::string packed(const std::string& chunks) {
    uLongf size = compressBound(static_cast<uLong>(chunks.size()));
    std::string out(size + 1, '\1');
    if (compress2(reinterpret_cast<Bytef*>(out.data()) + 1, &size, reinterpret_cast<const Bytef*>(chunks.data()),
                  static_cast<uLong>(chunks.size()), 6) != Z_OK)
        throw std::bad_alloc();
    out.resize(size + 1);
    return out;
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

json listed(glm::dvec3 v) {
    return {v.x, v.y, v.z};
}

std::string hex(glm::vec3 linear) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (glm::length_t k = 0; k < 3; ++k) {
        const auto byte = static_cast<std::size_t>(host::srgb_byte(linear[k]));
        text += digits[byte / 16];
        text += digits[byte % 16];
    }
    return text;
}

json as_json(const host::ColorScale& scale) {
    return {{"title", host::color_title(scale.by)},
            {"unit", host::color_unit(scale.by)},
            {"low", scale.low},
            {"high", scale.high},
            {"scale", scale.logarithmic ? "log"
                      : scale.root      ? "root"
                                        : "linear"}};
}

json colors_of(const PageOptions& options) {
    json map = json::array(), scales = json::object();
    for (int i = 0; i < 64; ++i) map.push_back(hex(host::map_color(options.scale.map, static_cast<float>(i) / 63)));
    for (const auto& [by, range] : options.ranges) {
        host::ColorScale scale;
        scale.by = by;
        std::tie(scale.low, scale.high) = range;
        scale.root = by == host::ColorBy::momentum || by == host::ColorBy::kinetic_energy ||
                     by == host::ColorBy::angular_momentum || by == host::ColorBy::contact_impulse;
        if (scale.low < scale.high) scales[host::color_by_names()[static_cast<std::size_t>(by)]] = as_json(scale);
    }
    const std::string first = host::color_by_names()[static_cast<std::size_t>(options.scale.by)];
    if (host::has_scale(options.scale.by)) scales[first] = as_json(options.scale);
    return {{"first", first}, {"map", std::move(map)}, {"scales", std::move(scales)}};
}

// The size of most moving bodies or below, and how far from the origin there are any.
struct PageExtent {
    double radius = 0.5, reach = 1, least_weight = 1;
    PageExtent(const World& world, glm::vec3 low, glm::vec3 high) {
        const Scene& scene = world.scene();
        const double gravity = std::max(static_cast<double>(glm::length(scene.gravity)), 1.0);
        std::vector<double> radii, masses;
        reach = std::max(static_cast<double>(glm::length(low)), static_cast<double>(glm::length(high)));
        for (const Body& body : scene.bodies) {
            if (std::holds_alternative<Plane>(body.shape)) continue;
            reach = std::max(reach, static_cast<double>(glm::length(body.position)) + 1);
            if (body.motion == Motion::fixed) continue;
            radii.push_back(static_cast<double>(bounding_radius(body.shape)));
            if (const float mass = mass_properties(body).mass; mass > 0) masses.push_back(static_cast<double>(mass));
        }
        const auto low_one = [](std::vector<double>& values) {
            const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 10);
            std::nth_element(values.begin(), at, values.end());
            return *at;
        };
        if (!radii.empty()) radius = low_one(radii);
        least_weight = (masses.empty() ? 1 : low_one(masses)) * gravity;
    }
};

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
          units(units_of(of, options, every)),
          encoder(units),
          chunks(options.shown) {}

    static FrameUnits units_of(const World& world, const PageOptions& options, int every) {
        const PageExtent extent(world, options.low, options.high);
        return FrameUnits::of(extent.radius, extent.reach, every / static_cast<double>(world.settings().rate),
                              glm::dvec3(world.scene().gravity), extent.least_weight / 1024);
    }
    double frame_seconds() const { return every / static_cast<double>(world.settings().rate); }

    void put(std::string_view text) {
        if (file)
            file->append(text);
        else
            kept += text;
    }
    static std::string element(const char* kind, const std::string& content, const std::string& more = "") {
        return std::string("<script type=\"application/x-scree\" data-kind=\"") + kind + "\"" + more + ">" +
               base64(packed(content)) + "</script>\n";
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

    json head() const;
    void add_head(std::string& to) const;
    void begin();
    std::string end() const;  // what follows the frames
    void take_events();
    void record();
    void record_frame();
    void add_frame(std::string& to, bool whole);
};

json PageRecording::Impl::head() const {
    json show = json::array();
    for (const Overlay overlay : options.style.show) show.push_back(schema::words<Overlay>[static_cast<std::size_t>(overlay)]);
    const Scene& scene = world.scene();
    return {{"format", 1},
            {"program", "scree " SCREE_VERSION},
            {"title", options.title},
            {"device", world.runner().device()},
            {"rate", world.settings().rate},
            {"substeps", world.settings().substeps},
            {"seconds", frame_seconds()},
            {"start", start},
            {"gravity", listed(scene.gravity)},
            {"units",
             {{"position", units.part()},
              {"velocity", units.velocity},
              {"parts", FrameUnits::parts},
              {"turn", FrameUnits::turn},
              {"orientation", FrameUnits::orientation},
              {"fall", units.fall},
              {"force", units.force},
              {"levels_per_octave", FrameUnits::levels_per_octave}}},
            {"errors",
             {{"position", units.position_error()},
              {"velocity", units.velocity_error()},
              {"angle", FrameUnits::angle_error()},
              {"force", FrameUnits::force_error()}}},
            {"low", listed(options.low)},
            {"high", listed(options.high)},
            {"colors", colors_of(options)},
            {"show", std::move(show)},
            {"sky", schema::words<ShownSky>[static_cast<std::size_t>(options.style.sky)]},
            {"sun", listed(options.toward_sun)},
            {"has", {{"contacts", options.contacts}, {"events", options.events}}}};
}

void PageRecording::Impl::begin() {
    const std::string_view page = viewer_page();
    const std::size_t title = page.find(place_of_title), data = page.find(place_of_data);
    if (title == page.npos || data == page.npos || data < title) throw std::logic_error(why_not());
    put(page.substr(0, title));
    put("<title>" + as_html(options.title) + " · scree</title>");
    put(page.substr(title + place_of_title.size(), data - title - place_of_title.size()));
    if (options.events) world.set_events({.contacts = true, .hit_speed = 0.2f, .breaks = true});
    std::string chunk;
    add_head(chunk);
    chunks.take_new(chunk, world);
    put(element("scene", chunk));
    record();
}

void PageRecording::Impl::add_head(std::string& to) const {
    ChunkBytes told;
    told.bytes = head().dump(-1, ' ', false, json::error_handler_t::replace);
    append_chunk(to, "head", told);
}

std::string PageRecording::Impl::end() const {
    const std::string_view page = viewer_page();
    return pending_events().append(page.substr(page.find(place_of_data) + place_of_data.size()));
}

// The strongest hits, and everything that broke, since the last frame.
void PageRecording::Impl::take_events() {
    if (!options.events) return;
    std::vector<Event> kept;
    for (const Event& event : world.take_events())
        if (event.kind == EventKind::hit || event.kind == EventKind::body_broke || event.kind == EventKind::joint_broke)
            kept.push_back(event);
    const auto hits = std::partition(kept.begin(), kept.end(), [](const Event& event) { return event.kind != EventKind::hit; });
    const auto last = hits + std::min<std::ptrdiff_t>(most_hits, kept.end() - hits);
    std::partial_sort(hits, last, kept.end(), [](const Event& x, const Event& y) { return x.impulse > y.impulse; });
    kept.erase(last, kept.end());
    for (const Event& event : kept) {
        events.u8(event.kind == EventKind::hit ? 0 : event.kind == EventKind::body_broke ? 1 : 2);
        events.f32(static_cast<float>(static_cast<double>(event.step) / static_cast<double>(world.settings().rate) - start));
        events.count(chunks.place_of(event.a));
        events.count(event.kind == EventKind::body_broke ? 0 : chunks.place_of(event.b));
        events.f32(event.speed);
        events.f32(event.impulse);
        events.vector(event.point);
        ++event_count;
    }
    if (events.bytes.size() > most_of_events) put_events();
}

void PageRecording::Impl::record() {
    if (recorded == world.steps()) return;
    recorded = world.steps();
    const auto begun = std::chrono::steady_clock::now();
    record_frame();
    seconds_encoding += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

void PageRecording::Impl::record_frame() {
    take_events();
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
