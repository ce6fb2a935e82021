// Animations as .glb files. https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "demos/film/glb_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "compute/step/state.h"
#include "demos/film/color_range.h"
#include "demos/film/glb_document.h"
#include "demos/film/glb_meshes.h"
#include "demos/film/glb_tracks.h"
#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

// A key of a channel of a body, as it lies in the scratch file.
struct Key {
    std::uint32_t body, channel;
    float time;
    glm::vec4 value;
};
constexpr std::size_t bytes_at_once = 64u << 20;

}  // namespace

struct GlbExport::Impl {
    struct Body {
        std::size_t id = 0;
        BodyHandle handle;
        std::string name;
        Drawn drawn;
        bool plane = false, moves = false, exists = true;
        double inverse_mass = 0, momentum = 0;  // the greatest so far, kg m/s
        glm::vec3 position{0};                  // at the start
        glm::vec4 orientation{0, 0, 0, 1};
        bool existed = true;  // at the start
        Track<glm::vec3> places;
        Track<glm::vec4> turns;
        std::array<std::size_t, glb_channels> keys{};
        std::array<float, glb_channels> last{};  // time of the last key
    };
    std::filesystem::path path;
    GlbOptions options;
    MeshCollection meshes;
    std::vector<Body> bodies;
    std::uint64_t arrangements = 0;
    host::ScratchFile scratch;
    double start_time = 0;
    std::optional<std::uint64_t> recorded;  // at this step

    Impl(const std::filesystem::path& file, const World& world, const GlbOptions& chosen)
        : path(file), options(chosen), scratch(file), start_time(world.time()) {}

    void take_bodies(const World& world);
    void record(const World& world);
    void emit(std::size_t body, GlbChannel channel, float time, glm::vec4 value) {
        const Key key{static_cast<std::uint32_t>(body), channel, time, value};
        scratch.append(std::as_bytes(std::span(&key, 1)));
        ++bodies[body].keys[channel];
        bodies[body].last[channel] = time;
    }
    double greatest_momentum() const;
    std::size_t color_of(const Body& body, double greatest) const;
    std::vector<GlbNode> nodes() const;
    void put_keys(host::GrowingFile& file);
};

void GlbExport::Impl::take_bodies(const World& world) {
    const Scene& scene = world.scene();
    const std::vector<BodyState> states = world.bodies();
    const State& state = world.state();
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (std::holds_alternative<Plane>(scene.bodies[i].shape) || !states[i].exists) continue;
        const float reach = bounding_radius(scene.bodies[i].shape);
        low = glm::min(low, states[i].position - reach);
        high = glm::max(high, states[i].position + reach);
    }
    if (low.x > high.x) low = glm::vec3(-1), high = glm::vec3(1);
    const float plane_reach = std::max(20.0f, 2 * glm::length(high - low));
    for (std::size_t i = 0; i < states.size(); ++i) {
        const scree::Body& described = scene.bodies[i];
        BodyHandle handle;
        try {
            handle = world.handle_of(i);
        } catch (const std::out_of_range&) {
            continue;  // removed before
        }
        Body& body = bodies.emplace_back();
        body.id = i;
        body.handle = handle;
        body.name = described.name.empty() ? fmt::format("body {}", i) : described.name;
        body.plane = std::holds_alternative<Plane>(described.shape);
        body.drawn = meshes.add(described.shape, plane_reach, 0.5f * (low + high));
        body.moves = described.motion != Motion::fixed;
        const float inverse_mass = state.properties[state.row_of(i)].inverse_mass;
        body.inverse_mass = double{inverse_mass};
        body.exists = body.existed = states[i].exists;
        if (!body.plane) {
            body.position = states[i].position;
            body.orientation = states[i].orientation;
        }
    }
    arrangements = world.arrangements();
    const auto moving =
        static_cast<std::size_t>(std::count_if(bodies.begin(), bodies.end(), [](const Body& b) { return b.moves; }));
    if (moving > options.most_moving)
        throw std::invalid_argument(fmt::format("{} bodies move, pieces included, and viewers open no file of more than {}",
                                                moving, options.most_moving));
}

void GlbExport::Impl::record(const World& world) {
    if (recorded == world.steps()) return;
    recorded = world.steps();
    const auto time = static_cast<float>(world.time() - start_time);
    const bool rearranged = arrangements != world.arrangements();
    arrangements = world.arrangements();
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Body& body = bodies[i];
        if (body.plane || body.id >= states.size()) continue;
        const BodyState& now = states[body.id];
        const bool exists = now.exists && (!rearranged && body.exists ? true : world.is_valid(body.handle));
        if (exists != body.exists) {
            if (body.keys[glb_scale] == 0) emit(i, glb_scale, 0, glm::vec4(body.exists ? body.drawn.scale : glm::vec3(0), 0));
            if (time > body.last[glb_scale]) emit(i, glb_scale, time, glm::vec4(exists ? body.drawn.scale : glm::vec3(0), 0));
            body.exists = exists;
        }
        if (!exists) continue;
        if (time > 0 && body.keys[glb_translation] == 0) {  // a fragment: where it is until then
            emit(i, glb_translation, 0, glm::vec4(body.position, 0));
            emit(i, glb_rotation, 0, body.orientation);
        }
        body.places.add(time, now.position, options.position_error,
                        [&](float at, glm::vec3 key) { emit(i, glb_translation, at, glm::vec4(key, 0)); });
        body.turns.add(time, now.orientation, options.angle_error,
                       [&](float at, glm::vec4 key) { emit(i, glb_rotation, at, key); });
        if (body.inverse_mass > 0)
            body.momentum = std::max(body.momentum, glm::length(glm::dvec3(now.velocity)) / body.inverse_mass);
    }
}

double GlbExport::Impl::greatest_momentum() const {
    std::vector<double> values;
    for (const Body& body : bodies)
        if (body.momentum > 0) values.push_back(body.momentum);
    return std::max(nearly_greatest(std::move(values)), 1e-12);
}

std::size_t GlbExport::Impl::color_of(const Body& body, double greatest) const {
    if (!body.moves) return glb_colors;
    const double place = std::sqrt(std::min(body.momentum / greatest, 1.0));  // as pictures place momentum
    return std::min(static_cast<std::size_t>(place * glb_colors), glb_colors - 1);
}

std::vector<GlbNode> GlbExport::Impl::nodes() const {
    const double greatest = greatest_momentum();
    std::vector<GlbNode> made;
    for (const Body& body : bodies)
        made.push_back({body.name, body.drawn.mesh, color_of(body, greatest), body.position, body.orientation,
                        body.existed ? body.drawn.scale : glm::vec3(0), body.keys, body.last});
    return made;
}

// The keys, body by body, in bands of bodies that fit into memory; the scratch file is read for each.
void GlbExport::Impl::put_keys(host::GrowingFile& file) {
    for (std::size_t first = 0, last = 0; first < bodies.size(); first = last) {
        std::vector<std::array<std::size_t, glb_channels>> times, values;  // offsets of the next key
        std::size_t bytes = 0;
        for (last = first; last < bodies.size() && (last == first || bytes < bytes_at_once); ++last) {
            times.emplace_back();
            values.emplace_back();
            for (std::size_t k = 0; k < glb_channels; ++k) {
                const std::size_t keys = bodies[last].keys[k] < 2 ? 0 : bodies[last].keys[k];
                times.back()[k] = bytes;
                values.back()[k] = bytes + 4 * keys;
                bytes += (4 + glb_value_bytes[k]) * keys;
            }
        }
        std::string band(bytes, '\0');
        std::string rest;  // of a key that two blocks share
        scratch.read([&](std::string_view block) {
            rest.append(block);
            std::size_t at = 0;
            for (; at + sizeof(Key) <= rest.size(); at += sizeof(Key)) {
                Key key;
                std::memcpy(&key, rest.data() + at, sizeof key);
                if (key.body < first || key.body >= last || bodies[key.body].keys[key.channel] < 2) continue;
                std::memcpy(&band[times[key.body - first][key.channel]], &key.time, 4);
                times[key.body - first][key.channel] += 4;
                char* to = &band[values[key.body - first][key.channel]];
                values[key.body - first][key.channel] += glb_value_bytes[key.channel];
                if (key.channel != glb_rotation) {
                    std::memcpy(to, &key.value, 12);
                } else {
                    for (glm::length_t k = 0; k < 4; ++k, to += 2) {
                        const auto level = static_cast<std::int16_t>(std::lround(std::clamp(key.value[k], -1.0f, 1.0f) * 32767));
                        std::memcpy(to, &level, 2);
                    }
                }
            }
            rest.erase(0, at);
        });
        file.append(std::string_view(band));
    }
}

GlbExport::GlbExport(const std::filesystem::path& path, const World& world, const GlbOptions& options)
    : interior_(std::make_unique<Impl>(path, world, options)) {
    interior_->take_bodies(world);
    interior_->record(world);
}
GlbExport::~GlbExport() = default;

int GlbExport::steps_until_due(const World& world) const {
    const auto every = static_cast<std::uint64_t>(interior_->options.every);
    return static_cast<int>(every - world.steps() % every);
}

void GlbExport::after_step(const World& world) {
    if (world.steps() % static_cast<std::uint64_t>(interior_->options.every) == 0) interior_->record(world);
}

void GlbExport::write() {
    Impl& in = *interior_;
    for (std::size_t i = 0; i < in.bodies.size(); ++i) {
        in.bodies[i].places.finish([&](float at, glm::vec3 key) { in.emit(i, glb_translation, at, glm::vec4(key, 0)); });
        in.bodies[i].turns.finish([&](float at, glm::vec4 key) { in.emit(i, glb_rotation, at, key); });
    }
    GlbDocument document = glb_document(in.nodes(), in.meshes.meshes(), in.greatest_momentum());
    document.json.append((4 - document.json.size() % 4) % 4, ' ');
    const std::uint64_t binary = document.mesh_bytes.size() + document.animation_bytes,
                        whole = 12 + 8 + document.json.size() + 8 + binary;
    if (whole > 0xFFFFFFFFu)
        throw host::FileError(in.path.string() + ": a .glb has less than 4 GiB; record every few steps (--export-every)");
    host::GrowingFile file(in.path);
    const auto put = [&](std::initializer_list<std::uint64_t> words) {
        for (const std::uint64_t word : words) {
            const auto one = static_cast<std::uint32_t>(word);
            file.append(std::as_bytes(std::span(&one, 1)));
        }
    };
    put({0x46546C67, 2, whole, document.json.size(), 0x4E4F534A});  // "glTF", "JSON"
    file.append(std::string_view(document.json));
    put({binary, 0x004E4942});  // "BIN"
    file.append(std::string_view(document.mesh_bytes));
    if (document.animation_bytes > 0) in.put_keys(file);
    file.commit();
}

}  // namespace scree::demos
