// Animations as .usda files. https://openusd.org/release/api/class_usd_geom_point_instancer.html
#include "demos/film/export/usd_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

using Line = fmt::memory_buffer;

// Shortest digits that read back to the same float.
void put(Line& line, glm::vec3 v) {
    fmt::format_to(std::back_inserter(line), "({}, {}, {})", v.x, v.y, v.z);
}
void put_turn(Line& line, glm::vec4 q) {  // w first; USD holds halves, of 11 bits
    fmt::format_to(std::back_inserter(line), "({:.5g}, {:.5g}, {:.5g}, {:.5g})", q.w, q.x, q.y, q.z);
}

template <class Items, class Put>
void put_list(Line& line, const Items& items, const Put& each) {
    const char* between = "[";
    for (const auto& item : items) {
        fmt::format_to(std::back_inserter(line), "{}", between);
        each(item);
        between = ", ";
    }
    fmt::format_to(std::back_inserter(line), "{}", items.empty() ? "[]" : "]");
}

std::span<const std::byte> bytes_of(const Line& line) {
    return std::as_bytes(std::span(line.data(), line.size()));
}

void append(host::GrowingFile& file, const Line& line) {
    file.append(std::string_view(line.data(), line.size()));
}

using Bodies = std::vector<const AnimatedBody*>;

Bodies bodies_that(const Animated& all, bool move) {
    Bodies chosen;
    for (const AnimatedBody& body : all.bodies)
        if (body.moves == move) chosen.push_back(&body);
    return chosen;
}

// The light grey of bodies without a colour beside others, linear, as in pictures (shaders/render/bodies/tint.comp).
constexpr glm::vec3 uncolored(0.55f, 0.53f, 0.50f);

// What does not change over time: which mesh each body has, its id, its scale and its colour.
void put_instancer(host::GrowingFile& file, const std::string& opening, const Bodies& bodies, std::size_t meshes) {
    Line line;
    const auto out = std::back_inserter(line);
    fmt::format_to(out, "    def PointInstancer {}    {{\n        int64[] ids = ", opening);
    put_list(line, bodies, [&](const AnimatedBody* body) { fmt::format_to(out, "{}", body->id); });
    fmt::format_to(out, "\n        int[] protoIndices = ");
    put_list(line, bodies, [&](const AnimatedBody* body) { fmt::format_to(out, "{}", body->drawn.mesh); });
    fmt::format_to(out, "\n        float3[] scales = ");
    put_list(line, bodies, [&](const AnimatedBody* body) { put(line, body->drawn.scale); });
    if (std::any_of(bodies.begin(), bodies.end(), [](const AnimatedBody* body) { return body->color.has_value(); })) {
        fmt::format_to(out, "\n        color3f[] primvars:displayColor = ");
        put_list(line, bodies, [&](const AnimatedBody* body) { put(line, body->color.value_or(uncolored)); });
        fmt::format_to(out, " (\n            interpolation = \"vertex\"\n        )");
    }
    fmt::format_to(out, "\n        rel prototypes = [");
    for (std::size_t m = 0; m < meshes; ++m) fmt::format_to(out, "{}</World/Shapes/shape_{}>", m > 0 ? ", " : "", m);
    fmt::format_to(out, "]\n");
    append(file, line);
}

void put_meshes(host::GrowingFile& file, const std::vector<Triangles>& meshes) {
    file.append(std::string_view("    over \"Shapes\"\n    {\n"));  // an over is not drawn by itself
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Triangles& mesh = meshes[m];
        const std::vector<int> threes(mesh.points.size() / 3, 3);
        std::vector<std::size_t> corners(mesh.points.size());
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = i;
        Line line;
        const auto out = std::back_inserter(line);
        fmt::format_to(out, "        def Mesh \"shape_{}\"\n        {{\n            int[] faceVertexCounts = ", m);
        put_list(line, threes, [&](int count) { fmt::format_to(out, "{}", count); });
        fmt::format_to(out, "\n            int[] faceVertexIndices = ");
        put_list(line, corners, [&](std::size_t corner) { fmt::format_to(out, "{}", corner); });
        fmt::format_to(out, "\n            point3f[] points = ");
        put_list(line, mesh.points, [&](glm::vec3 point) { put(line, point); });
        fmt::format_to(out, "\n            normal3f[] normals = ");
        put_list(line, mesh.normals, [&](glm::vec3 normal) { put(line, normal); });
        fmt::format_to(out,
                       " (\n                interpolation = \"vertex\"\n            )\n"
                       "            uniform token subdivisionScheme = \"none\"\n        }}\n");
        append(file, line);
    }
    file.append(std::string_view("    }\n"));
}

struct Attribute {
    const char* type;
    const char* name;
};
enum Sampled : std::size_t { positions, orientations, velocities, spins, hidden };
constexpr std::array<Attribute, 5> attributes{{{"point3f[]", "positions"},
                                               {"quath[]", "orientations"},
                                               {"vector3f[]", "velocities"},
                                               {"vector3f[]", "angularVelocities"},
                                               {"int64[]", "invisibleIds"}}};

}  // namespace

struct UsdWriter::Impl {
    std::filesystem::path path, folder;  // folder: of value clips
    UsdOptions options;
    std::array<std::unique_ptr<host::ScratchFile>, attributes.size()> samples;  // lines of text
    std::optional<std::vector<std::size_t>> hidden_before;
    std::uint64_t first = 0, last = 0;  // steps recorded
    std::vector<std::uint64_t> clips;   // first step of each
    int in_clip = 0;                    // moments of the last one

    Impl(const std::filesystem::path& file, const UsdOptions& chosen) : path(file), options(chosen) {
        folder = path;
        folder += ".clips";
        if (options.clip > 0) host::make_folder(folder);
        forget();
    }
    void forget() {
        for (std::unique_ptr<host::ScratchFile>& text : samples) text = std::make_unique<host::ScratchFile>(path);
        hidden_before.reset();
    }
    template <class Put>
    void sample(Sampled which, std::uint64_t step, const Bodies& bodies, const Put& each) {
        Line line;
        fmt::format_to(std::back_inserter(line), "                {}: ", step);
        put_list(line, bodies, [&](const AnimatedBody* body) { each(line, *body); });
        fmt::format_to(std::back_inserter(line), ",\n");
        samples[which]->append(bytes_of(line));
    }
    void sample_all(const Bodies& bodies, std::uint64_t step);
    void put_samples(host::GrowingFile& file);
    std::string clip_name(std::size_t index) const { return fmt::format("clip.{:06}.usda", index); }
    void write_clip();
    void write_manifest() const;
    std::string opening() const;
};

void UsdWriter::Impl::sample_all(const Bodies& bodies, std::uint64_t step) {
    constexpr float degrees = 57.295779513f;
    sample(positions, step, bodies, [](Line& line, const AnimatedBody& body) { put(line, body.now.position); });
    sample(orientations, step, bodies, [](Line& line, const AnimatedBody& body) { put_turn(line, body.now.orientation); });
    sample(velocities, step, bodies, [](Line& line, const AnimatedBody& body) { put(line, body.now.velocity); });
    sample(spins, step, bodies, [](Line& line, const AnimatedBody& body) { put(line, body.now.angular_velocity * degrees); });
    std::vector<std::size_t> absent;
    for (const AnimatedBody* body : bodies)
        if (!body->exists) absent.push_back(body->id);
    if (absent == hidden_before) return;  // held until it changes
    Line line;
    fmt::format_to(std::back_inserter(line), "                {}: ", step);
    put_list(line, absent, [&](std::size_t id) { fmt::format_to(std::back_inserter(line), "{}", id); });
    fmt::format_to(std::back_inserter(line), ",\n");
    samples[hidden]->append(bytes_of(line));
    hidden_before = std::move(absent);
}

void UsdWriter::Impl::put_samples(host::GrowingFile& file) {
    for (std::size_t k = 0; k < attributes.size(); ++k) {
        file.append(fmt::format("        {} {}.timeSamples = {{\n", attributes[k].type, attributes[k].name));
        samples[k]->read([&](std::string_view block) { file.append(block); });
        file.append(std::string_view("        }\n"));
    }
}

void UsdWriter::Impl::write_clip() {
    host::GrowingFile file(folder / clip_name(clips.size() - 1));
    file.append(
        fmt::format("#usda 1.0\n(\n    endTimeCode = {}\n    startTimeCode = {}\n)\n\nover \"World\"\n{{\n"
                    "    over \"Moving\"\n    {{\n",
                    last, clips.back()));
    put_samples(file);
    file.append(std::string_view("    }\n}\n"));
    file.commit();
}

// Which attributes the clips have.
void UsdWriter::Impl::write_manifest() const {
    std::string text = "#usda 1.0\n\nover \"World\"\n{\n    over \"Moving\"\n    {\n";
    for (const Attribute& attribute : attributes) text += fmt::format("        {} {}\n", attribute.type, attribute.name);
    host::write_atomically(folder / "manifest.usda", text + "    }\n}\n");
}

// The instancer's name, with where its samples are. https://openusd.org/release/api/_usd__page__value_clips.html
std::string UsdWriter::Impl::opening() const {
    if (options.clip == 0) return "\"Moving\"\n";
    const std::string at = "./" + folder.filename().string() + "/";
    std::string paths, active;
    for (std::size_t i = 0; i < clips.size(); ++i) {
        paths += fmt::format("{}@{}{}@", i > 0 ? ", " : "", at, clip_name(i));
        active += fmt::format("{}({}, {})", i > 0 ? ", " : "", clips[i], i);
    }
    return fmt::format(
        "\"Moving\" (\n        clips = {{\n            dictionary default = {{\n                double2[] active = [{}]\n"
        "                asset[] assetPaths = [{}]\n                asset manifestAssetPath = @{}manifest.usda@\n"
        "                string primPath = \"/World/Moving\"\n                double2[] times = [({}, {}), ({}, {})]\n"
        "            }}\n        }}\n    )\n",
        active, paths, at, first, first, std::max(last, first + 1), std::max(last, first + 1));
}

UsdWriter::UsdWriter(const std::filesystem::path& path, const UsdOptions& options)
    : interior_(std::make_unique<Impl>(path, options)) {}
UsdWriter::~UsdWriter() = default;

void UsdWriter::begin(const Animated&) {}

void UsdWriter::add(const Animated& all, const Moment& moment) {
    Impl& in = *interior_;
    const Bodies moving = bodies_that(all, true);
    if (in.in_clip == 0) in.clips.assign(1, in.first = moment.step);
    in.last = moment.step;
    in.sample_all(moving, moment.step);
    if (++in.in_clip <= in.options.clip || in.options.clip == 0) return;
    // The first moment of a clip is the last of the one before, too, for the time between them.
    in.write_clip();
    in.forget();
    in.clips.push_back(moment.step);
    in.sample_all(moving, moment.step);
    in.in_clip = 1;
}

void UsdWriter::write(const Animated& all) {
    Impl& in = *interior_;
    if (in.options.clip > 0) {
        in.write_clip();
        in.write_manifest();
    }
    const Bodies fixed = bodies_that(all, false);
    host::GrowingFile file(in.path);
    file.append(
        fmt::format("#usda 1.0\n(\n    defaultPrim = \"World\"\n    doc = \"Written by scree: a time code is a step\"\n"
                    "    endTimeCode = {}\n    framesPerSecond = {}\n    metersPerUnit = 1\n    startTimeCode = {}\n"
                    "    timeCodesPerSecond = {}\n    upAxis = \"Y\"\n)\n\ndef Xform \"World\"\n{{\n",
                    in.last, all.rate / static_cast<float>(all.every), in.first, all.rate));
    put_instancer(file, in.opening(), bodies_that(all, true), all.meshes.size());
    if (in.options.clip == 0) in.put_samples(file);
    file.append(std::string_view("    }\n"));
    put_instancer(file, "\"Fixed\"\n", fixed, all.meshes.size());
    Line line;
    fmt::format_to(std::back_inserter(line), "        point3f[] positions = ");
    put_list(line, fixed, [&](const AnimatedBody* body) { put(line, body->start_position); });
    fmt::format_to(std::back_inserter(line), "\n        quath[] orientations = ");
    put_list(line, fixed, [&](const AnimatedBody* body) { put_turn(line, body->start_orientation); });
    fmt::format_to(std::back_inserter(line), "\n    }}\n");
    append(file, line);
    put_meshes(file, all.meshes);
    file.append(std::string_view("}\n"));
    file.commit();
}

}  // namespace scree::demos
