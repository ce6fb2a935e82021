// Animations as .usda files. https://openusd.org/release/api/class_usd_geom_point_instancer.html
#include "demos/film/usd_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "demos/film/glb_meshes.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

struct UsdBody {
    std::size_t id = 0;
    BodyHandle handle;
    Drawn drawn;
    bool plane = false;
    glm::vec3 position{0};
    glm::vec4 orientation{0, 0, 0, 1};
};

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

}  // namespace

struct UsdExport::Impl {
    // Samples of one attribute, as lines of text.
    struct Samples {
        const char* type;
        const char* name;
        host::ScratchFile text;
    };
    std::filesystem::path path;
    UsdOptions options;
    MeshCollection meshes;
    std::vector<UsdBody> moving, fixed;
    Samples positions, orientations, velocities, spins, hidden;
    std::vector<std::size_t> hidden_before{static_cast<std::size_t>(-1)};
    std::optional<std::uint64_t> first, last;  // steps recorded
    float rate;

    Impl(const std::filesystem::path& file, const World& world, const UsdOptions& chosen)
        : path(file),
          options(chosen),
          positions{"point3f[]", "positions", host::ScratchFile(file)},
          orientations{"quath[]", "orientations", host::ScratchFile(file)},
          velocities{"vector3f[]", "velocities", host::ScratchFile(file)},
          spins{"vector3f[]", "angularVelocities", host::ScratchFile(file)},
          hidden{"int64[]", "invisibleIds", host::ScratchFile(file)},
          rate(world.settings().rate) {}

    void take_bodies(const World& world);
    void record(const World& world);
    template <class Put>
    void sample(Samples& of, std::uint64_t step, const Put& each) {
        Line line;
        fmt::format_to(std::back_inserter(line), "                {}: ", step);
        put_list(line, moving, [&](const UsdBody& body) { each(line, body); });
        fmt::format_to(std::back_inserter(line), ",\n");
        of.text.append(bytes_of(line));
    }
    void put_instancer(host::GrowingFile& file, const char* name, const std::vector<UsdBody>& bodies) const;
    void put_samples(host::GrowingFile& file, Samples& of) const;
    void put_meshes(host::GrowingFile& file) const;
};

void UsdExport::Impl::take_bodies(const World& world) {
    const Scene& scene = world.scene();
    const std::vector<BodyState> states = world.bodies();
    glm::vec3 low(1e30f), high(-1e30f);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (std::holds_alternative<Plane>(scene.bodies[i].shape) || !states[i].exists) continue;
        const float reach = bounding_radius(scene.bodies[i].shape);
        low = glm::min(low, states[i].position - reach), high = glm::max(high, states[i].position + reach);
    }
    if (low.x > high.x) low = glm::vec3(-1), high = glm::vec3(1);
    const float plane_reach = std::max(20.0f, 2 * glm::length(high - low));
    for (std::size_t i = 0; i < states.size(); ++i) {
        UsdBody body;
        try {
            body.handle = world.handle_of(i);
        } catch (const std::out_of_range&) {
            continue;  // removed before
        }
        body.id = i;
        body.plane = std::holds_alternative<Plane>(scene.bodies[i].shape);
        body.drawn = meshes.add(scene.bodies[i].shape, plane_reach, 0.5f * (low + high));
        if (!body.plane) body.position = states[i].position, body.orientation = states[i].orientation;
        (scene.bodies[i].motion == Motion::fixed ? fixed : moving).push_back(body);
    }
}

void UsdExport::Impl::record(const World& world) {
    if (last == world.steps()) return;
    const std::uint64_t step = world.steps();
    if (!first) first = step;
    last = step;
    const std::vector<BodyState> states = world.bodies();
    std::vector<std::size_t> absent;
    for (UsdBody& body : moving) {
        if (body.id >= states.size() || !states[body.id].exists || !world.is_valid(body.handle)) {
            absent.push_back(body.id);
            continue;
        }
        body.position = states[body.id].position, body.orientation = states[body.id].orientation;
    }
    const auto state_of = [&](const UsdBody& body) -> BodyState {
        return body.id < states.size() && world.is_valid(body.handle) ? states[body.id] : BodyState{};
    };
    sample(positions, step, [&](Line& line, const UsdBody& body) { put(line, body.position); });
    sample(orientations, step, [&](Line& line, const UsdBody& body) { put_turn(line, body.orientation); });
    sample(velocities, step, [&](Line& line, const UsdBody& body) { put(line, state_of(body).velocity); });
    constexpr float degrees = 57.295779513f;
    sample(spins, step, [&](Line& line, const UsdBody& body) { put(line, state_of(body).angular_velocity * degrees); });
    if (absent == hidden_before) return;  // held until it changes
    Line line;
    fmt::format_to(std::back_inserter(line), "                {}: ", step);
    put_list(line, absent, [&](std::size_t id) { fmt::format_to(std::back_inserter(line), "{}", id); });
    fmt::format_to(std::back_inserter(line), ",\n");
    hidden.text.append(bytes_of(line));
    hidden_before = std::move(absent);
}

void UsdExport::Impl::put_samples(host::GrowingFile& file, Samples& of) const {
    file.append(fmt::format("            {} {}.timeSamples = {{\n", of.type, of.name));
    of.text.read([&](std::string_view block) { file.append(block); });
    file.append(std::string_view("            }\n"));
}

// What does not change over time: which mesh each body has, its id and its scale.
void UsdExport::Impl::put_instancer(host::GrowingFile& file, const char* name, const std::vector<UsdBody>& bodies) const {
    Line line;
    const auto out = std::back_inserter(line);
    fmt::format_to(out, "    def PointInstancer \"{}\"\n    {{\n        int64[] ids = ", name);
    put_list(line, bodies, [&](const UsdBody& body) { fmt::format_to(out, "{}", body.id); });
    fmt::format_to(out, "\n        int[] protoIndices = ");
    put_list(line, bodies, [&](const UsdBody& body) { fmt::format_to(out, "{}", body.drawn.mesh); });
    fmt::format_to(out, "\n        float3[] scales = ");
    put_list(line, bodies, [&](const UsdBody& body) { put(line, body.drawn.scale); });
    fmt::format_to(out, "\n        rel prototypes = [");
    for (std::size_t m = 0; m < meshes.meshes().size(); ++m)
        fmt::format_to(out, "{}</World/Shapes/shape_{}>", m > 0 ? ", " : "", m);
    fmt::format_to(out, "]\n");
    append(file, line);
}

void UsdExport::Impl::put_meshes(host::GrowingFile& file) const {
    file.append(std::string_view("    over \"Shapes\"\n    {\n"));  // an over is not drawn by itself
    for (std::size_t m = 0; m < meshes.meshes().size(); ++m) {
        const Triangles& mesh = meshes.meshes()[m];
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

UsdExport::UsdExport(const std::filesystem::path& path, const World& world, const UsdOptions& options)
    : interior_(std::make_unique<Impl>(path, world, options)) {
    interior_->take_bodies(world);
    interior_->record(world);
}
UsdExport::~UsdExport() = default;

int UsdExport::steps_until_due(const World& world) const {
    const auto every = static_cast<std::uint64_t>(interior_->options.every);
    return static_cast<int>(every - world.steps() % every);
}

void UsdExport::after_step(const World& world) {
    if (world.steps() % static_cast<std::uint64_t>(interior_->options.every) == 0) interior_->record(world);
}

void UsdExport::write() {
    Impl& in = *interior_;
    host::GrowingFile file(in.path);
    file.append(
        fmt::format("#usda 1.0\n(\n    defaultPrim = \"World\"\n    doc = \"Written by scree: a time code is a step\"\n"
                    "    endTimeCode = {}\n    framesPerSecond = {}\n    metersPerUnit = 1\n    startTimeCode = {}\n"
                    "    timeCodesPerSecond = {}\n    upAxis = \"Y\"\n)\n\ndef Xform \"World\"\n{{\n",
                    *in.last, in.rate / static_cast<float>(in.options.every), *in.first, in.rate));
    in.put_instancer(file, "Moving", in.moving);
    for (Impl::Samples* samples : {&in.positions, &in.orientations, &in.velocities, &in.spins, &in.hidden})
        in.put_samples(file, *samples);
    file.append(std::string_view("    }\n"));
    in.put_instancer(file, "Fixed", in.fixed);
    Line line;
    fmt::format_to(std::back_inserter(line), "        point3f[] positions = ");
    put_list(line, in.fixed, [&](const UsdBody& body) { put(line, body.position); });
    fmt::format_to(std::back_inserter(line), "\n        quath[] orientations = ");
    put_list(line, in.fixed, [&](const UsdBody& body) { put_turn(line, body.orientation); });
    fmt::format_to(std::back_inserter(line), "\n    }}\n");
    append(file, line);
    in.put_meshes(file);
    file.append(std::string_view("}\n"));
    file.commit();
}

}  // namespace scree::demos
