// Look, head, units and events of recordings and live streams.
#include "demos/film/pages/page_parts.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/picture_style_fields.h"
#include "demos/film/color_range.h"
#include "demos/film/style.h"
#include "host/canvas/canvas.h"

namespace scree::demos {

namespace {

using nlohmann::json;

constexpr std::size_t most_hits = 32;  // of a frame, the strongest

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

std::string packed(const std::string& chunks, int effort, int memory, int strategy) {
    if (chunks.size() > std::numeric_limits<uInt>::max()) throw std::length_error("a block of a recording has 4 GiB or more");
    z_stream stream{};
    if (deflateInit2(&stream, effort, Z_DEFLATED, 15, memory, strategy) != Z_OK) throw std::bad_alloc();
    std::string out(deflateBound(&stream, static_cast<uLong>(chunks.size())) + 1, '\1');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(chunks.data()));
    stream.avail_in = static_cast<uInt>(chunks.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data()) + 1;
    stream.avail_out = static_cast<uInt>(out.size() - 1);
    const int result = deflate(&stream, Z_FINISH);
    out.resize(1 + stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) throw std::bad_alloc();
    return out;
}

}  // namespace

void take_look(PageOptions& page, const LoadedScene& subject, const Settings& settings, bool rehearses) {
    page.scale = scale_of(page.style, subject, settings, rehearses);
    for (const char* word : {"momentum", "speed", "spin", "kinetic-energy", "angular-momentum", "height", "contact-impulse"})
        page.ranges.emplace_back(host::color_by_named(word).value(), color_range(subject, settings, word, false));
    host::CanvasOptions light;
    show_light(page.style, light);
    page.toward_sun = light.toward_sun;
    page.low = subject.low;
    page.high = subject.high;
}

std::string packed_block(const std::string& chunks) {
    return packed(chunks, 6, 8, Z_DEFAULT_STRATEGY);
}

std::string packed_frame(const std::string& chunks) {
    return packed(chunks, 1, 7, Z_RLE);
}

FrameUnits units_of(const World& world, const PageOptions& options, double seconds, bool crowd) {
    const PageExtent extent(world, options.low, options.high);
    return FrameUnits::of(extent.radius, extent.reach, seconds, glm::dvec3(world.scene().gravity), extent.least_weight / 1024,
                          crowd);
}

std::string head_of(World& world, const PageOptions& options, const FrameUnits& units, double seconds, double start) {
    json show = json::array();
    for (const Overlay overlay : options.style.show) show.push_back(schema::words<Overlay>[static_cast<std::size_t>(overlay)]);
    const Scene& scene = world.scene();
    const json told = {{"format", 1},
                       {"program", "scree " SCREE_VERSION},
                       {"title", options.title},
                       {"device", world.runner().device()},
                       {"rate", world.settings().rate},
                       {"substeps", world.settings().substeps},
                       {"seconds", seconds},
                       {"start", start},
                       {"gravity", listed(scene.gravity)},
                       {"units",
                        {{"position", units.part()},
                         {"velocity", units.velocity},
                         {"parts", FrameUnits::parts},
                         {"turn", units.turn},
                         {"orientation", FrameUnits::orientation},
                         {"fall", units.fall},
                         {"force", units.force},
                         {"levels_per_octave", FrameUnits::levels_per_octave}}},
                       {"errors",
                        {{"position", units.position_error()},
                         {"velocity", units.velocity_error()},
                         {"angle", units.angle_error()},
                         {"force", FrameUnits::force_error()}}},
                       {"low", listed(options.low)},
                       {"high", listed(options.high)},
                       {"colors", colors_of(options)},
                       {"show", std::move(show)},
                       {"sky", schema::words<ShownSky>[static_cast<std::size_t>(options.style.sky)]},
                       {"sun", listed(options.toward_sun)},
                       {"has", {{"contacts", options.contacts}, {"events", options.events}}}};
    return told.dump(-1, ' ', false, json::error_handler_t::replace);
}

void ask_for_events(World& world) {
    world.set_events({.contacts = true, .hit_speed = 0.2f, .breaks = true});
}

std::size_t add_events(ChunkBytes& to, World& world, const WorldChunks& chunks, double start) {
    std::vector<Event> kept;
    for (const Event& event : world.take_events())
        if (event.kind == EventKind::hit || event.kind == EventKind::body_broke || event.kind == EventKind::joint_broke)
            kept.push_back(event);
    const auto hits = std::partition(kept.begin(), kept.end(), [](const Event& event) { return event.kind != EventKind::hit; });
    const auto last = hits + std::min<std::ptrdiff_t>(most_hits, kept.end() - hits);
    std::partial_sort(hits, last, kept.end(), [](const Event& x, const Event& y) { return x.impulse > y.impulse; });
    kept.erase(last, kept.end());
    for (const Event& event : kept) {
        to.u8(event.kind == EventKind::hit ? 0 : event.kind == EventKind::body_broke ? 1 : 2);
        to.f32(static_cast<float>(static_cast<double>(event.step) / static_cast<double>(world.settings().rate) - start));
        to.count(chunks.place_of(event.a));
        to.count(event.kind == EventKind::body_broke ? 0 : chunks.place_of(event.b));
        to.f32(event.speed);
        to.f32(event.impulse);
        to.vector(event.point);
    }
    return kept.size();
}

}  // namespace scree::demos
