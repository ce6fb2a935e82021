// Animations as .glb files. https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "demos/film/export/glb_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "demos/film/color_range.h"
#include "demos/film/export/glb_document.h"
#include "demos/film/export/glb_tracks.h"
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

struct GlbWriter::Impl {
    struct Body {
        bool there = true;    // as told last
        double momentum = 0;  // the greatest so far, kg m/s
        Track<glm::vec3> places;
        Track<glm::vec4> turns;
        std::array<std::size_t, glb_channels> keys{};
        std::array<float, glb_channels> last{};  // time of the last key
    };
    std::filesystem::path path;
    GlbOptions options;
    std::vector<Body> bodies;  // as in Animated
    host::ScratchFile scratch;

    Impl(const std::filesystem::path& file, const GlbOptions& chosen) : path(file), options(chosen), scratch(file) {}

    void add(std::size_t index, const AnimatedBody& of, float time);
    void emit(std::size_t body, GlbChannel channel, float time, glm::vec4 value) {
        const Key key{static_cast<std::uint32_t>(body), channel, time, value};
        scratch.append(std::as_bytes(std::span(&key, 1)));
        ++bodies[body].keys[channel];
        bodies[body].last[channel] = time;
    }
    double greatest_momentum() const;
    std::size_t color_of(std::size_t index, bool moves, double greatest) const;
    // Fills `own` with the colours that bodies have.
    std::vector<GlbNode> nodes(const Animated& all, std::vector<glm::vec3>& own) const;
    void put_keys(host::GrowingFile& file);
};

void GlbWriter::Impl::add(std::size_t i, const AnimatedBody& of, float time) {
    Body& body = bodies[i];
    const glm::vec4 size(of.drawn.scale, 0), none(0);
    if (of.exists != body.there) {
        if (body.keys[glb_scale] == 0) emit(i, glb_scale, 0, body.there ? size : none);
        if (time > body.last[glb_scale]) emit(i, glb_scale, time, of.exists ? size : none);
        body.there = of.exists;
    }
    if (!of.exists) return;
    if (time > 0 && body.keys[glb_translation] == 0) {  // a fragment: where it is until then
        emit(i, glb_translation, 0, glm::vec4(of.start_position, 0));
        emit(i, glb_rotation, 0, of.start_orientation);
    }
    body.places.add(time, of.now.position, options.position_error,
                    [&](float at, glm::vec3 key) { emit(i, glb_translation, at, glm::vec4(key, 0)); });
    body.turns.add(time, of.now.orientation, options.angle_error,
                   [&](float at, glm::vec4 key) { emit(i, glb_rotation, at, key); });
    if (of.inverse_mass > 0) body.momentum = std::max(body.momentum, glm::length(glm::dvec3(of.now.velocity)) / of.inverse_mass);
}

double GlbWriter::Impl::greatest_momentum() const {
    std::vector<double> values;
    for (const Body& body : bodies)
        if (body.momentum > 0) values.push_back(body.momentum);
    return std::max(nearly_greatest(std::move(values)), 1e-12);
}

std::size_t GlbWriter::Impl::color_of(std::size_t index, bool moves, double greatest) const {
    if (!moves) return glb_colors;
    const double place = std::sqrt(std::min(bodies[index].momentum / greatest, 1.0));  // as pictures place momentum
    return std::min(static_cast<std::size_t>(place * glb_colors), glb_colors - 1);
}

std::vector<GlbNode> GlbWriter::Impl::nodes(const Animated& all, std::vector<glm::vec3>& own) const {
    const double greatest = greatest_momentum();
    std::map<std::array<float, 3>, std::size_t> places;  // of colours in `own`
    const auto place_of = [&](glm::vec3 color) {
        const auto [at, fresh] = places.try_emplace({color.r, color.g, color.b}, own.size());
        if (fresh) own.push_back(color);
        return at->second;
    };
    std::vector<GlbNode> made;
    for (std::size_t i = 0; i < all.bodies.size(); ++i) {
        const AnimatedBody& body = all.bodies[i];
        const std::size_t color = body.color ? glb_colors + 1 + place_of(*body.color) : color_of(i, body.moves, greatest);
        made.push_back({body.name, body.drawn.mesh, color, body.start_position, body.start_orientation,
                        body.existed ? body.drawn.scale : glm::vec3(0), bodies[i].keys, bodies[i].last});
    }
    return made;
}

// The keys, body by body, in bands of bodies that fit into memory; the scratch file is read for each.
void GlbWriter::Impl::put_keys(host::GrowingFile& file) {
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

GlbWriter::GlbWriter(const std::filesystem::path& path, const GlbOptions& options)
    : interior_(std::make_unique<Impl>(path, options)) {}
GlbWriter::~GlbWriter() = default;

void GlbWriter::begin(const Animated& all) {
    const auto moving = static_cast<std::size_t>(
        std::count_if(all.bodies.begin(), all.bodies.end(), [](const AnimatedBody& body) { return body.moves; }));
    if (moving > interior_->options.most_moving)
        throw std::invalid_argument(fmt::format("{} bodies move, pieces included, and viewers open no file of more than {}",
                                                moving, interior_->options.most_moving));
    interior_->bodies.resize(all.bodies.size());
    for (std::size_t i = 0; i < all.bodies.size(); ++i) interior_->bodies[i].there = all.bodies[i].existed;
}

void GlbWriter::add(const Animated& all, const Moment& moment) {
    for (std::size_t i = 0; i < all.bodies.size(); ++i)
        if (!all.bodies[i].plane) interior_->add(i, all.bodies[i], static_cast<float>(moment.time));
}

void GlbWriter::write(const Animated& all) {
    Impl& in = *interior_;
    for (std::size_t i = 0; i < in.bodies.size(); ++i) {
        in.bodies[i].places.finish([&](float at, glm::vec3 key) { in.emit(i, glb_translation, at, glm::vec4(key, 0)); });
        in.bodies[i].turns.finish([&](float at, glm::vec4 key) { in.emit(i, glb_rotation, at, key); });
    }
    std::vector<glm::vec3> own;
    const std::vector<GlbNode> nodes = in.nodes(all, own);
    GlbDocument document = glb_document(nodes, all.meshes, in.greatest_momentum(), own);
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
