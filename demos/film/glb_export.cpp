// Animations as .glb files. https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "demos/film/glb_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/json_text.h"
#include "compute/step/state.h"
#include "demos/film/color_range.h"
#include "demos/film/glb_meshes.h"
#include "demos/film/glb_tracks.h"
#include "host/canvas/colors.h"
#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

enum Channel : std::uint32_t { translation, rotation, size_channel };
constexpr std::size_t channels = 3;
constexpr std::array<const char*, channels> paths{"translation", "rotation", "scale"};

// A key of a channel of a body, as it lies in the scratch file.
struct Key {
    std::uint32_t body, channel;
    float time;
    glm::vec4 value;
};
// Bytes of a value in the file: floats, and quaternions in normalised 16 bits (to 0.004 degrees).
constexpr std::array<std::size_t, channels> value_bytes{12, 8, 12};
constexpr std::array<const char*, channels> accessor_types{R"("componentType":5126,"type":"VEC3")",
                                                           R"("componentType":5122,"normalized":true,"type":"VEC4")",
                                                           R"("componentType":5126,"type":"VEC3")"};

constexpr std::size_t colors = 24;  // of momentum; behind them that of what does not move
constexpr std::size_t bytes_at_once = 64u << 20;

std::string vector_text(glm::vec3 v) {
    return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

std::string quoted(const std::string& words) {
    Text text;
    text.quoted(words);
    return text.take();
}

// The JSON lists that grow together.
struct Lists {
    std::string nodes, meshes, accessors, samplers, animated;
    std::size_t accessor_count = 0;
    static void add(std::string& list, const std::string& entry) { list += (list.empty() ? "" : ",\n") + entry; }
    std::size_t accessor(const std::string& entry) {
        add(accessors, "{" + entry + "}");
        return accessor_count++;
    }
};

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
        std::array<std::size_t, channels> keys{};
        std::array<float, channels> last{};  // time of the last key
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
    void emit(std::size_t body, Channel channel, float time, glm::vec4 value) {
        const Key key{static_cast<std::uint32_t>(body), channel, time, value};
        scratch.append(std::as_bytes(std::span(&key, 1)));
        ++bodies[body].keys[channel];
        bodies[body].last[channel] = time;
    }
    double greatest_momentum() const;
    std::size_t color_of(const Body& body, double greatest) const;
    std::uint64_t put_meshes(Lists& lists, std::string& bytes, std::vector<std::array<std::size_t, 2>>& accessors) const;
    std::string document(const std::string& mesh_bytes, Lists lists, const std::vector<std::array<std::size_t, 2>>& geometry,
                         std::uint64_t& animation_bytes) const;
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
            if (body.keys[size_channel] == 0)
                emit(i, size_channel, 0, glm::vec4(body.exists ? body.drawn.scale : glm::vec3(0), 0));
            if (time > body.last[size_channel])
                emit(i, size_channel, time, glm::vec4(exists ? body.drawn.scale : glm::vec3(0), 0));
            body.exists = exists;
        }
        if (!exists) continue;
        if (time > 0 && body.keys[translation] == 0) {  // a fragment: where it is until then
            emit(i, translation, 0, glm::vec4(body.position, 0));
            emit(i, rotation, 0, body.orientation);
        }
        body.places.add(time, now.position, options.position_error,
                        [&](float at, glm::vec3 key) { emit(i, translation, at, glm::vec4(key, 0)); });
        body.turns.add(time, now.orientation, options.angle_error, [&](float at, glm::vec4 key) { emit(i, rotation, at, key); });
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
    if (!body.moves) return colors;
    const double place = std::sqrt(std::min(body.momentum / greatest, 1.0));  // as pictures place momentum
    return std::min(static_cast<std::size_t>(place * colors), colors - 1);
}

// The triangles' bytes, and the accessors of each mesh's points and normals.
std::uint64_t GlbExport::Impl::put_meshes(Lists& lists, std::string& bytes,
                                          std::vector<std::array<std::size_t, 2>>& accessors) const {
    const auto put = [&](const std::vector<glm::vec3>& vectors, bool bounded) {
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        for (const glm::vec3& v : vectors) low = glm::min(low, v), high = glm::max(high, v);
        const std::string bounds = bounded ? fmt::format(",\"min\":{},\"max\":{}", vector_text(low), vector_text(high)) : "";
        const std::size_t offset = bytes.size();
        bytes.append(reinterpret_cast<const char*>(vectors.data()), vectors.size() * sizeof(glm::vec3));
        return lists.accessor(fmt::format(R"("bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"VEC3"{})",
                                          offset, vectors.size(), bounds));
    };
    for (const Triangles& mesh : meshes.meshes()) accessors.push_back({put(mesh.points, true), put(mesh.normals, false)});
    return bytes.size();
}

std::string GlbExport::Impl::document(const std::string& mesh_bytes, Lists lists,
                                      const std::vector<std::array<std::size_t, 2>>& geometry,
                                      std::uint64_t& animation_bytes) const {
    const double greatest = greatest_momentum();
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> made;  // mesh and colour
    std::string roots;
    std::size_t samplers = 0;
    animation_bytes = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Body& body = bodies[i];
        const std::pair look(body.drawn.mesh, color_of(body, greatest));
        const auto [mesh, fresh] = made.try_emplace(look, made.size());
        if (fresh)
            Lists::add(lists.meshes,
                       fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{}}},"material":{}}}]}})",
                                   geometry[look.first][0], geometry[look.first][1], look.second));
        const glm::vec4 q = body.orientation;
        Lists::add(lists.nodes, fmt::format(R"({{"name":{},"mesh":{},"translation":{},"rotation":[{},{},{},{}],"scale":{}}})",
                                            quoted(body.name), mesh->second, vector_text(body.position), q.x, q.y, q.z, q.w,
                                            vector_text(body.existed ? body.drawn.scale : glm::vec3(0))));
        roots += fmt::format("{}{}", i == 0 ? "" : ",", i);
        for (std::size_t k = 0; k < channels; ++k) {
            const std::size_t keys = body.keys[k];
            if (keys < 2) continue;  // it stays as it is at the start
            const std::size_t times = lists.accessor(fmt::format(
                R"("bufferView":1,"byteOffset":{},"componentType":5126,"count":{},"type":"SCALAR","min":[0],"max":[{}])",
                animation_bytes, keys, body.last[k]));
            animation_bytes += 4 * keys;
            const std::size_t values = lists.accessor(
                fmt::format(R"("bufferView":1,"byteOffset":{},"count":{},{})", animation_bytes, keys, accessor_types[k]));
            animation_bytes += value_bytes[k] * keys;
            Lists::add(lists.samplers, fmt::format(R"({{"input":{},"output":{},"interpolation":"{}"}})", times, values,
                                                   k == size_channel ? "STEP" : "LINEAR"));
            Lists::add(lists.animated,
                       fmt::format(R"({{"sampler":{},"target":{{"node":{},"path":"{}"}}}})", samplers++, i, paths[k]));
        }
    }
    std::string materials;
    for (std::size_t k = 0; k <= colors; ++k) {
        const glm::vec3 color = k == colors ? glm::vec3(0.40f, 0.385f, 0.36f)
                                            : host::map_color(host::ColorMap::ember, (static_cast<float>(k) + 0.5f) / colors);
        Lists::add(materials,
                   fmt::format(R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},1],)"
                               R"("metallicFactor":0,"roughnessFactor":0.7}}}})",
                               k == colors ? "fixed"
                                           : fmt::format("momentum {:.3g} kg m/s",
                                                         greatest * std::pow((static_cast<double>(k) + 0.5) / colors, 2)),
                               color.r, color.g, color.b));
    }
    const std::string animation =
        samplers == 0 ? ""
                      : fmt::format(",\n\"animations\":[{{\"name\":\"run\",\"samplers\":[{}],\n\"channels\":[{}]}}]",
                                    lists.samplers, lists.animated);
    const std::string second_view =
        samplers == 0 ? ""
                      : fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}}})", mesh_bytes.size(), animation_bytes);
    return fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"scree\"}},\n\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\n\"nodes\":[{"
        "}],\n"
        "\"meshes\":[{}],\n\"materials\":[{}],\n\"accessors\":[{}],\n"
        "\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{},\"byteStride\":12,\"target\":34962}}{}],\n"
        "\"buffers\":[{{\"byteLength\":{}}}]{}}}",
        roots, lists.nodes, lists.meshes, materials, lists.accessors, mesh_bytes.size(), second_view,
        mesh_bytes.size() + animation_bytes, animation);
}

// The keys, body by body, in bands of bodies that fit into memory; the scratch file is read for each.
void GlbExport::Impl::put_keys(host::GrowingFile& file) {
    for (std::size_t first = 0, last = 0; first < bodies.size(); first = last) {
        std::vector<std::array<std::size_t, channels>> times, values;  // offsets of the next key
        std::size_t bytes = 0;
        for (last = first; last < bodies.size() && (last == first || bytes < bytes_at_once); ++last) {
            times.emplace_back();
            values.emplace_back();
            for (std::size_t k = 0; k < channels; ++k) {
                const std::size_t keys = bodies[last].keys[k] < 2 ? 0 : bodies[last].keys[k];
                times.back()[k] = bytes;
                values.back()[k] = bytes + 4 * keys;
                bytes += (4 + value_bytes[k]) * keys;
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
                values[key.body - first][key.channel] += value_bytes[key.channel];
                if (key.channel != rotation) {
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
        in.bodies[i].places.finish([&](float at, glm::vec3 key) { in.emit(i, translation, at, glm::vec4(key, 0)); });
        in.bodies[i].turns.finish([&](float at, glm::vec4 key) { in.emit(i, rotation, at, key); });
    }
    Lists lists;
    std::string mesh_bytes;
    std::vector<std::array<std::size_t, 2>> geometry;
    in.put_meshes(lists, mesh_bytes, geometry);
    std::uint64_t animation_bytes = 0;
    std::string json = in.document(mesh_bytes, std::move(lists), geometry, animation_bytes);
    json.append((4 - json.size() % 4) % 4, ' ');
    const std::uint64_t binary = mesh_bytes.size() + animation_bytes, whole = 12 + 8 + json.size() + 8 + binary;
    if (whole > 0xFFFFFFFFu)
        throw host::FileError(in.path.string() + ": a .glb has less than 4 GiB; record every few steps (--export-every)");
    host::GrowingFile file(in.path);
    const auto put = [&](std::initializer_list<std::uint64_t> words) {
        for (const std::uint64_t word : words) {
            const auto one = static_cast<std::uint32_t>(word);
            file.append(std::as_bytes(std::span(&one, 1)));
        }
    };
    put({0x46546C67, 2, whole, json.size(), 0x4E4F534A});  // "glTF", "JSON"
    file.append(std::string_view(json));
    put({binary, 0x004E4942});  // "BIN"
    file.append(std::string_view(mesh_bytes));
    if (animation_bytes > 0) in.put_keys(file);
    file.commit();
}

}  // namespace scree::demos
