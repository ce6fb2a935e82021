// Layers of overs over USD files.
#include "demos/film/export/usd_layer_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "compute/scene_file/import/usd/usd_input.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dquat;
using glm::dvec3;
using imports::Placed;
using imports::UsdBodyPrim;
using imports::UsdInput;
using Out = std::back_insert_iterator<std::string>;

dmat4 matrix_of(const Placed& placed) {
    dmat4 matrix = glm::mat4_cast(placed.turn);
    matrix[3] = glm::dvec4(placed.position, 1);
    return matrix;
}

// Position, turn and stretch of a transform, if that is all it has.
struct Parts {
    dvec3 position{0};
    dquat turn{1, 0, 0, 0};
    dvec3 scale{1};
};
std::optional<Parts> parts_of(const dmat4& matrix) {
    dmat3 axes(matrix);
    Parts parts{dvec3(matrix[3]), {}, {glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])}};
    for (int k = 0; k < 3; ++k) {
        if (!(parts.scale[k] > 1e-12)) return std::nullopt;
        axes[k] /= parts.scale[k];
    }
    if (glm::determinant(axes) < 0) axes[2] = -axes[2], parts.scale.z = -parts.scale.z;
    constexpr double square = 1e-6;
    if (std::abs(glm::dot(axes[0], axes[1])) > square || std::abs(glm::dot(axes[1], axes[2])) > square ||
        std::abs(glm::dot(axes[2], axes[0])) > square)
        return std::nullopt;
    parts.turn = glm::normalize(glm::quat_cast(axes));
    return parts;
}

// Samples of an attribute; those that repeat the last one are left out while they do.
struct SampledText {
    void add(double time, std::string value) {
        if (value == last) {
            repeated = time;
            return;
        }
        if (repeated) put(*repeated, last);
        repeated.reset();
        put(time, value);
        last = std::move(value);
    }
    void put(double time, const std::string& value) { fmt::format_to(Out(text), "        {}: {},\n", time, value); }
    std::string text, last;
    std::optional<double> repeated{};
};

struct Tracked {
    SampledText position, turn, whole;
    bool sheared = false;
    dquat before{1, 0, 0, 0};
    dvec3 scale{1};
};

// What is said of a prim, and of those below it.
struct Over {
    std::string metadata, text;
    std::map<std::string, Over> below;
    Over& at(const std::string& path) {
        Over* here = this;
        for (std::size_t from = 1; from < path.size();) {
            const std::size_t end = std::min(path.find('/', from), path.size());
            here = &here->below[path.substr(from, end - from)];
            from = end + 1;
        }
        return *here;
    }
};

std::string vector_text(const dvec3& v) {
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
std::string scale_text(const glm::vec3& v) {
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
std::string turn_text(const dquat& q) {
    return fmt::format("({}, {}, {}, {})", static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
                       static_cast<float>(q.z));
}
std::string matrix_text(const dmat4& m) {
    std::string text = "(";
    for (int k = 0; k < 4; ++k)
        fmt::format_to(Out(text), "{}({}, {}, {}, {})", k > 0 ? ", " : " ", m[k][0], m[k][1], m[k][2], m[k][3]);
    return text + " )";
}

void put_over(host::GrowingFile& file, const std::string& name, const Over& over, const std::string& indent) {
    std::string text = fmt::format("{0}over \"{1}\"{2}\n{0}{{\n", indent, name, over.metadata);
    for (std::size_t from = 0; from < over.text.size();) {
        const std::size_t end = over.text.find('\n', from) + 1;
        text += indent + over.text.substr(from, end - from);
        from = end;
    }
    file.append(std::string_view(text));
    for (const auto& [below, what] : over.below) put_over(file, below, what, indent + "    ");
    file.append(std::string_view(indent + "}\n"));
}

struct UsdLayerWriter : AnimationWriter {
    UsdLayerWriter(std::filesystem::path to, std::filesystem::path over, const ImportOptions& options)
        : path(std::move(to)),
          under(std::move(over)),
          input(imports::usd_input(under, options)),
          tracks(input.bodies.size()),
          of_instancers(input.instancers.size()) {}
    void begin(const Animated& all) override;
    void add(const Animated& all, const Moment& moment) override;
    void write(const Animated& all) override;

    std::filesystem::path path, under;
    UsdInput input;
    std::vector<Tracked> tracks;                            // of the input's bodies
    std::vector<std::array<SampledText, 2>> of_instancers;  // positions, orientations
    std::unordered_map<std::string, std::size_t> named;     // bodies by name
    std::vector<std::size_t> animated;                      // of the input's bodies: which of the run's, or none
    double last = 0;                                        // time code

    std::vector<dmat4> worlds(const Animated& all) const;
    void sample(std::size_t body, const dmat4& local, double time);
    void sample_instancers(const std::vector<dmat4>& worlds, double time);
    std::string opening() const;
};

void UsdLayerWriter::begin(const Animated& all) {
    std::unordered_map<std::string, std::size_t> by_name;
    for (std::size_t i = 0; i < all.bodies.size(); ++i) by_name.emplace(all.bodies[i].name, i);
    animated.clear();
    for (const UsdBodyPrim& body : input.bodies) {
        const auto found = by_name.find(body.path);
        animated.push_back(found == by_name.end() ? all.bodies.size() : found->second);
    }
}

// Transforms of the prims, m, in the scene's axes.
std::vector<dmat4> UsdLayerWriter::worlds(const Animated& all) const {
    std::vector<dmat4> made;
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        Placed placed = input.bodies[i].placed;
        if (animated[i] < all.bodies.size()) {
            const AnimatedBody& body = all.bodies[animated[i]];
            const glm::vec4 q = body.now.orientation;
            placed = {dvec3(body.now.position), glm::normalize(dquat(q.w, q.x, q.y, q.z))};
            if (body.origin) {
                const glm::vec4 o = body.origin->orientation;
                placed = placed * Placed{dvec3(body.origin->position), glm::normalize(dquat(o.w, o.x, o.y, o.z))};
            }
        }
        made.push_back(matrix_of(placed) * input.bodies[i].stretch);
    }
    return made;
}

void UsdLayerWriter::sample(std::size_t body, const dmat4& local, double time) {
    Tracked& track = tracks[body];
    const std::optional<Parts> parts = parts_of(local);
    track.whole.add(time, matrix_text(local));
    if (!parts) track.sheared = true;
    if (track.sheared) return;
    const dquat turn = glm::dot(parts->turn, track.before) < 0 ? -parts->turn : parts->turn;  // the shorter way between samples
    track.before = turn;
    if (track.position.text.empty()) track.scale = parts->scale;
    track.position.add(time, vector_text(parts->position));
    track.turn.add(time, turn_text(turn));
}

void UsdLayerWriter::sample_instancers(const std::vector<dmat4>& worlds, double time) {
    for (std::size_t k = 0; k < input.instancers.size(); ++k) {
        imports::UsdInstancer& instancer = input.instancers[k];
        for (std::size_t i = 0; i < input.bodies.size(); ++i) {
            const UsdBodyPrim& body = input.bodies[i];
            if (body.instancer != instancer.path) continue;
            const std::optional<Parts> parts = parts_of(glm::inverse(body.above) * worlds[i] * glm::inverse(body.within));
            if (!parts || 3 * body.instance + 3 > instancer.positions.size()) continue;
            for (std::size_t c = 0; c < 3; ++c) instancer.positions[3 * body.instance + c] = parts->position[static_cast<int>(c)];
            double* q = instancer.orientations.data() + 4 * body.instance;
            q[0] = parts->turn.w, q[1] = parts->turn.x, q[2] = parts->turn.y, q[3] = parts->turn.z;
        }
        std::string positions = "[", turns = "[";
        for (std::size_t i = 0; 3 * i < instancer.positions.size(); ++i) {
            const double *p = instancer.positions.data() + 3 * i, *q = instancer.orientations.data() + 4 * i;
            fmt::format_to(Out(positions), "{}({}, {}, {})", i > 0 ? ", " : "", static_cast<float>(p[0]),
                           static_cast<float>(p[1]), static_cast<float>(p[2]));
            fmt::format_to(Out(turns), "{}({}, {}, {}, {})", i > 0 ? ", " : "", static_cast<float>(q[0]),
                           static_cast<float>(q[1]), static_cast<float>(q[2]), static_cast<float>(q[3]));
        }
        of_instancers[k][0].add(time, positions + "]");
        of_instancers[k][1].add(time, turns + "]");
    }
}

std::string UsdLayerWriter::opening() const {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::absolute(path, failed).parent_path();
    std::filesystem::path way = std::filesystem::proximate(std::filesystem::absolute(under, failed), folder, failed);
    std::string name = way.generic_string();
    if (way.is_relative() && !name.starts_with("../")) name = "./" + name;
    std::string text = "#usda 1.0\n(\n";
    if (!input.default_prim.empty()) fmt::format_to(Out(text), "    defaultPrim = \"{}\"\n", input.default_prim);
    fmt::format_to(Out(text),
                   "    doc = \"Written by scree: motion over {}\"\n    endTimeCode = {}\n    kilogramsPerUnit = {}\n"
                   "    metersPerUnit = {}\n    startTimeCode = {}\n    subLayers = [\n        @{}@\n    ]\n"
                   "    timeCodesPerSecond = {}\n    upAxis = \"{}\"\n)\n\n",
                   under.filename().string(), last, input.kilograms, input.meters, input.start, name, input.time_codes,
                   input.up_axis);
    return text;
}

void UsdLayerWriter::add(const Animated& all, const Moment& moment) {
    const double time = last = input.start + std::round(moment.time * input.time_codes * 1e9) / 1e9;
    const std::vector<dmat4> worlds = this->worlds(all);
    for (std::size_t i = 0; i < worlds.size(); ++i) {
        const UsdBodyPrim& body = input.bodies[i];
        if (!body.instancer.empty() || body.path.find('[') != body.path.npos) continue;
        dmat4 above = body.above;
        if (body.carrier != body.no_carrier && !body.resets) {
            const UsdBodyPrim& carrier = input.bodies[body.carrier];
            above = worlds[body.carrier] * glm::inverse(matrix_of(carrier.placed) * carrier.stretch) * above;
        }
        sample(i, glm::inverse(above) * worlds[i], time);
    }
    sample_instancers(worlds, time);
}

void UsdLayerWriter::write(const Animated&) {
    Over root;
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        const UsdBodyPrim& body = input.bodies[i];
        if (!body.instancer.empty() || body.path.find('[') != body.path.npos) continue;
        for (const std::string& instance : body.instances) root.at(instance).metadata = " (\n    instanceable = false\n)";
        const Tracked& track = tracks[i];
        const std::string reset = body.resets ? "\"!resetXformStack!\", " : "";
        std::string text;
        if (track.sheared)
            text = fmt::format(
                "    matrix4d xformOp:transform.timeSamples = {{\n{}    }}\n    uniform token[] xformOpOrder = "
                "[{}\"xformOp:transform\"]\n",
                track.whole.text, reset);
        else
            text = fmt::format(
                "    quatf xformOp:orient.timeSamples = {{\n{}    }}\n    float3 xformOp:scale = {}\n"
                "    double3 xformOp:translate.timeSamples = {{\n{}    }}\n    uniform token[] xformOpOrder = "
                "[{}\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]\n",
                track.turn.text, scale_text(glm::vec3(track.scale)), track.position.text, reset);
        root.at(body.path).text += text;
    }
    for (std::size_t k = 0; k < input.instancers.size(); ++k)
        root.at(input.instancers[k].path).text += fmt::format(
            "    quatf[] orientationsf.timeSamples = {{\n{0}    }}\n    quath[] orientations.timeSamples = {{\n{0}    }}\n"
            "    point3f[] positions.timeSamples = {{\n{1}    }}\n",
            of_instancers[k][1].text, of_instancers[k][0].text);
    host::GrowingFile file(path);
    file.append(std::string_view(opening()));
    for (const auto& [name, over] : root.below) put_over(file, name, over, "");
    file.commit();
}

}  // namespace

std::unique_ptr<AnimationWriter> usd_layer_writer(const std::filesystem::path& path, const std::filesystem::path& under,
                                                  const ImportOptions& options) {
    return std::make_unique<UsdLayerWriter>(path, under, options);
}

}  // namespace scree::demos
