// The JSON part of a .glb file.
#include "demos/film/glb_document.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "compute/scene_file/json_text.h"
#include "host/canvas/colors.h"

namespace scree::demos {

namespace {

constexpr std::array<const char*, glb_channels> channel_paths{"translation", "rotation", "scale"};
constexpr std::array<const char*, glb_channels> value_types{R"("componentType":5126,"type":"VEC3")",
                                                            R"("componentType":5122,"normalized":true,"type":"VEC4")",
                                                            R"("componentType":5126,"type":"VEC3")"};

std::string vector_text(glm::vec3 v) {
    return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

std::string quoted(const std::string& words) {
    Text text;
    text.quoted(words);
    return text.take();
}

// The document's lists, which grow together.
class Lists {
public:
    explicit Lists(const std::vector<Triangles>& meshes) {
        for (const Triangles& mesh : meshes) geometry_.push_back({put(mesh.points, true), put(mesh.normals, false)});
    }
    void add(const GlbNode& node) {
        const auto [mesh, fresh] = meshes_.try_emplace({node.mesh, node.color}, meshes_.size());
        if (fresh)
            append(mesh_list_, fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{}}},"material":{}}}]}})",
                                           geometry_[node.mesh][0], geometry_[node.mesh][1], material_of(node.color)));
        const glm::vec4 q = node.orientation;
        append(nodes_,
               fmt::format(R"({{"name":{},"mesh":{},"translation":{},"rotation":[{},{},{},{}],"scale":{}}})", quoted(node.name),
                           mesh->second, vector_text(node.position), q.x, q.y, q.z, q.w, vector_text(node.size)));
        roots_ += fmt::format("{}{}", node_count_ == 0 ? "" : ",", node_count_);
        for (std::size_t k = 0; k < glb_channels; ++k)
            if (node.keys[k] > 1) add_channel(node, k);
        ++node_count_;
    }
    GlbDocument finish(double greatest, const std::vector<glm::vec3>& own) {
        const std::string animation =
            sampler_count_ == 0 ? ""
                                : fmt::format(",\n\"animations\":[{{\"name\":\"run\",\"samplers\":[{}],\n\"channels\":[{}]}}]",
                                              samplers_, animated_);
        const std::string second_view = sampler_count_ == 0 ? ""
                                                            : fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}}})",
                                                                          made_.mesh_bytes.size(), made_.animation_bytes);
        made_.json = fmt::format(
            "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"scree\"}},\n\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\n"
            "\"nodes\":[{}],\n\"meshes\":[{}],\n\"materials\":[{}],\n\"accessors\":[{}],\n"
            "\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{},\"byteStride\":12,\"target\":34962}}{}],\n"
            "\"buffers\":[{{\"byteLength\":{}}}]{}}}",
            roots_, nodes_, mesh_list_, materials(greatest, own), accessors_, made_.mesh_bytes.size(), second_view,
            made_.mesh_bytes.size() + made_.animation_bytes, animation);
        return std::move(made_);
    }

private:
    static void append(std::string& list, const std::string& entry) { list += (list.empty() ? "" : ",\n") + entry; }
    std::size_t accessor(const std::string& entry) {
        append(accessors_, "{" + entry + "}");
        return accessor_count_++;
    }
    // Vectors of a mesh; returns their accessor.
    std::size_t put(const std::vector<glm::vec3>& vectors, bool bounded) {
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        for (const glm::vec3& v : vectors) low = glm::min(low, v), high = glm::max(high, v);
        const std::string bounds = bounded ? fmt::format(",\"min\":{},\"max\":{}", vector_text(low), vector_text(high)) : "";
        const std::size_t offset = made_.mesh_bytes.size();
        made_.mesh_bytes.append(reinterpret_cast<const char*>(vectors.data()), vectors.size() * sizeof(glm::vec3));
        return accessor(fmt::format(R"("bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"VEC3"{})", offset,
                                    vectors.size(), bounds));
    }
    void add_channel(const GlbNode& node, std::size_t k) {
        const std::size_t keys = node.keys[k];
        std::uint64_t& bytes = made_.animation_bytes;
        const std::size_t times = accessor(
            fmt::format(R"("bufferView":1,"byteOffset":{},"componentType":5126,"count":{},"type":"SCALAR","min":[0],"max":[{}])",
                        bytes, keys, node.last[k]));
        bytes += 4 * keys;
        const std::size_t values =
            accessor(fmt::format(R"("bufferView":1,"byteOffset":{},"count":{},{})", bytes, keys, value_types[k]));
        bytes += glb_value_bytes[k] * keys;
        append(samplers_, fmt::format(R"({{"input":{},"output":{},"interpolation":"{}"}})", times, values,
                                      k == glb_scale ? "STEP" : "LINEAR"));
        append(animated_, fmt::format(R"({{"sampler":{},"target":{{"node":{},"path":"{}"}}}})", sampler_count_++, node_count_,
                                      channel_paths[k]));
    }
    // The place of a colour among the materials that are used.
    std::size_t material_of(std::size_t color) {
        const auto [place, fresh] = material_places_.try_emplace(color, used_colors_.size());
        if (fresh) used_colors_.push_back(color);
        return place->second;
    }
    std::string materials(double greatest, const std::vector<glm::vec3>& own) const {
        std::string list;
        const auto add = [&](const std::string& name, glm::vec3 color) {
            append(list, fmt::format(R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},1],)"
                                     R"("metallicFactor":0,"roughnessFactor":0.7}}}})",
                                     name, color.r, color.g, color.b));
        };
        for (const std::size_t k : used_colors_) {
            if (k == glb_colors) {
                add("fixed", glm::vec3(0.40f, 0.385f, 0.36f));
            } else if (k < glb_colors) {
                const double place = (static_cast<double>(k) + 0.5) / glb_colors;
                add(fmt::format("momentum {:.3g} kg m/s", greatest * place * place),
                    host::map_color(host::ColorMap::ember, static_cast<float>(place)));
            } else {
                const glm::vec3 color = own[k - glb_colors - 1];
                add(fmt::format("color #{:02x}{:02x}{:02x}", host::srgb_byte(color.r), host::srgb_byte(color.g),
                                host::srgb_byte(color.b)),
                    color);
            }
        }
        return list;
    }

    GlbDocument made_;
    std::string nodes_, mesh_list_, accessors_, samplers_, animated_, roots_;
    std::size_t accessor_count_ = 0, sampler_count_ = 0, node_count_ = 0;
    std::vector<std::array<std::size_t, 2>> geometry_;                   // accessors of points and normals, by mesh
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> meshes_;  // by triangles and colour
    std::map<std::size_t, std::size_t> material_places_;                 // by colour
    std::vector<std::size_t> used_colors_;                               // by material
};

}  // namespace

GlbDocument glb_document(const std::vector<GlbNode>& nodes, const std::vector<Triangles>& meshes, double greatest,
                         const std::vector<glm::vec3>& own) {
    Lists lists(meshes);
    for (const GlbNode& node : nodes) lists.add(node);
    return lists.finish(greatest, own);
}

}  // namespace scree::demos
