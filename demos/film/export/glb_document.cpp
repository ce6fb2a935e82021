// The JSON part of a .glb file.
#include "demos/film/export/glb_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
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
    // `animated`: nodes have keys, whose view is the second.
    Lists(const std::vector<Triangles>& meshes, bool animated) : views_(animated ? 2 : 1) {
        for (const Triangles& mesh : meshes) geometry_.push_back(primitives_of(mesh));
    }
    void add(const GlbNode& node) {
        const auto [mesh, fresh] = meshes_.try_emplace({node.mesh, node.color}, meshes_.size());
        if (fresh) {
            std::string primitives;
            for (const Primitive& one : geometry_[node.mesh])
                primitives += fmt::format(R"({}{{"attributes":{{{}}},"material":{}}})", primitives.empty() ? "" : ",",
                                          one.attributes, one.surface ? material_of(*one.surface) : material_of(node.color));
            append(mesh_list_, fmt::format(R"({{"primitives":[{}]}})", primitives));
        }
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
        surface_bytes_.append((4 - surface_bytes_.size() % 4) % 4, '\0');  // keys follow
        const std::size_t vectors = made_.mesh_bytes.size(), before_keys = vectors + surface_bytes_.size();
        made_.mesh_bytes += surface_bytes_;
        std::string more_views = sampler_count_ == 0 ? ""
                                                     : fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}}})",
                                                                   before_keys, made_.animation_bytes);
        for (const View& view : surface_views_)
            more_views +=
                fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", vectors + view.first, view.bytes, view.more);
        const auto list = [](const char* name, const std::string& entries) {
            return entries.empty() ? "" : fmt::format("\"{}\":[{}],\n", name, entries);
        };
        made_.json = fmt::format(
            "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"scree\"}},\n\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\n"
            "\"nodes\":[{}],\n\"meshes\":[{}],\n\"materials\":[{}],\n{}{}{}\"accessors\":[{}],\n"
            "\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{},\"byteStride\":12,\"target\":34962}}{}],\n"
            "\"buffers\":[{{\"byteLength\":{}}}]{}}}",
            roots_, nodes_, mesh_list_, materials(greatest, own), list("textures", textures_), list("images", images_),
            list("samplers", texture_samplers_), accessors_, vectors, more_views, made_.mesh_bytes.size() + made_.animation_bytes,
            animation);
        return std::move(made_);
    }

private:
    static void append(std::string& list, const std::string& entry) { list += (list.empty() ? "" : ",\n") + entry; }
    std::size_t accessor(const std::string& entry) {
        append(accessors_, "{" + entry + "}");
        return accessor_count_++;
    }
    struct Primitive {
        std::string attributes;
        const host::SurfaceMaterial* surface = nullptr;  // null: as its body
    };
    struct View {
        std::size_t first, bytes;  // in the bytes of surfaces
        std::string more;
    };
    std::size_t add_view(std::string_view bytes, const std::string& more) {
        surface_bytes_.append((4 - surface_bytes_.size() % 4) % 4, '\0');
        surface_views_.push_back({surface_bytes_.size(), bytes.size(), more});
        surface_bytes_ += bytes;
        return views_ + surface_views_.size() - 1;
    }
    std::vector<Primitive> primitives_of(const Triangles& mesh) {
        if (mesh.ranges.empty())
            return {{fmt::format(R"("POSITION":{},"NORMAL":{})", put(mesh.points, true), put(mesh.normals, false)), nullptr}};
        std::vector<Primitive> made;
        const auto add = [&](std::size_t first, std::size_t end, const host::SurfaceMaterial* surface) {
            if (first == end) return;
            const auto cut = [&](const auto& all) {
                return std::vector(all.begin() + static_cast<std::ptrdiff_t>(first),
                                   all.begin() + static_cast<std::ptrdiff_t>(end));
            };
            Primitive one{fmt::format(R"("POSITION":{},"NORMAL":{})", put(cut(mesh.points), true), put(cut(mesh.normals), false)),
                          surface};
            if (surface && surface->image) one.attributes += fmt::format(R"(,"TEXCOORD_0":{})", put_coordinates(cut(mesh.at)));
            const std::vector<std::uint32_t> colors = cut(mesh.colors);
            if (surface &&
                std::any_of(colors.begin(), colors.end(), [](std::uint32_t color) { return color != host::white_level; }))
                one.attributes += fmt::format(R"(,"COLOR_0":{})", put_colors(colors));
            made.push_back(std::move(one));
        };
        add(0, mesh.ranges[0].first, nullptr);
        for (std::size_t k = 0; k < mesh.ranges.size(); ++k)
            add(mesh.ranges[k].first, k + 1 < mesh.ranges.size() ? mesh.ranges[k + 1].first : mesh.points.size(),
                &mesh.ranges[k].material);
        return made;
    }
    std::size_t put_coordinates(const std::vector<glm::vec2>& at) {
        const std::size_t view =
            add_view({reinterpret_cast<const char*>(at.data()), at.size() * sizeof(glm::vec2)}, R"(,"target":34962)");
        return accessor(fmt::format(R"("bufferView":{},"componentType":5126,"count":{},"type":"VEC2")", view, at.size()));
    }
    std::size_t put_colors(const std::vector<std::uint32_t>& colors) {
        std::vector<std::uint16_t> levels;  // of linear light
        for (const std::uint32_t color : colors) {
            const glm::vec3 light = host::linear_of_levels(color);
            for (int k = 0; k < 3; ++k) levels.push_back(static_cast<std::uint16_t>(std::lround(65535 * light[k])));
            levels.push_back(65535);
        }
        const std::size_t view =
            add_view({reinterpret_cast<const char*>(levels.data()), levels.size() * 2}, R"(,"target":34962)");
        return accessor(fmt::format(R"("bufferView":{},"componentType":5123,"normalized":true,"count":{},"type":"VEC4")", view,
                                    colors.size()));
    }
    // The place of a texture, with its image and sampler.
    std::size_t texture_of(const host::SurfaceMaterial& surface) {
        const auto [image, fresh_image] = image_places_.try_emplace(surface.image.get(), image_places_.size());
        if (fresh_image)
            append(images_, fmt::format(R"({{"name":{},"bufferView":{},"mimeType":"{}"}})", quoted(surface.image->name),
                                        add_view(surface.image->bytes, ""), surface.image->is_png ? "image/png" : "image/jpeg"));
        const auto word = [](host::Wrap wrap) {
            return wrap == host::Wrap::repeat ? 10497 : wrap == host::Wrap::mirror ? 33648 : 33071;
        };
        const auto [sampler, fresh_sampler] =
            sampler_places_.try_emplace({word(surface.across), word(surface.down)}, sampler_places_.size());
        if (fresh_sampler)
            append(texture_samplers_, fmt::format(R"({{"magFilter":9729,"minFilter":9987,"wrapS":{},"wrapT":{}}})",
                                                  sampler->first.first, sampler->first.second));
        const auto [texture, fresh] = texture_places_.try_emplace({image->second, sampler->second}, texture_places_.size());
        if (fresh) append(textures_, fmt::format(R"({{"source":{},"sampler":{}}})", image->second, sampler->second));
        return texture->second;
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
        const auto [place, fresh] = material_places_.try_emplace(color, used_.size());
        if (fresh) used_.push_back({color, nullptr, ""});
        return place->second;
    }
    std::size_t material_of(const host::SurfaceMaterial& surface) {
        const auto known = std::find_if(used_.begin(), used_.end(),
                                        [&](const Used& one) { return one.surface != nullptr && *one.surface == surface; });
        if (known != used_.end()) return static_cast<std::size_t>(known - used_.begin());
        const std::string texture =
            surface.image ? fmt::format(R"("baseColorTexture":{{"index":{}}},)", texture_of(surface)) : "";
        used_.push_back({0, &surface, texture});
        return used_.size() - 1;
    }
    std::string materials(double greatest, const std::vector<glm::vec3>& own) const {
        std::string list;
        const auto add = [&](const std::string& name, glm::vec3 color, const std::string& texture = "") {
            append(list, fmt::format(R"({{"name":{},"pbrMetallicRoughness":{{{}"baseColorFactor":[{},{},{},1],)"
                                     R"("metallicFactor":0,"roughnessFactor":0.7}}}})",
                                     quoted(name), texture, color.r, color.g, color.b));
        };
        for (const Used& one : used_) {
            const std::size_t k = one.color;
            if (one.surface != nullptr) {
                add(one.surface->name, one.surface->color, one.texture);
            } else if (k == glb_colors) {
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
    std::vector<std::vector<Primitive>> geometry_;                       // by mesh
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> meshes_;  // by triangles and colour
    std::map<std::size_t, std::size_t> material_places_;                 // by colour
    struct Used {
        std::size_t color;
        const host::SurfaceMaterial* surface;  // of a mesh, instead
        std::string texture;
    };
    std::vector<Used> used_;  // by material
    // Of surfaces: further views of the buffer, images, samplers and textures.
    std::size_t views_;
    std::string surface_bytes_;
    std::vector<View> surface_views_;
    std::string textures_, images_, texture_samplers_;
    std::map<const host::SurfaceImage*, std::size_t> image_places_;
    std::map<std::pair<int, int>, std::size_t> sampler_places_;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> texture_places_;
};

}  // namespace

GlbDocument glb_document(const std::vector<GlbNode>& nodes, const std::vector<Triangles>& meshes, double greatest,
                         const std::vector<glm::vec3>& own) {
    const bool animated = std::any_of(nodes.begin(), nodes.end(), [](const GlbNode& node) {
        return std::any_of(node.keys.begin(), node.keys.end(), [](std::size_t keys) { return keys > 1; });
    });
    Lists lists(meshes, animated);
    for (const GlbNode& node : nodes) lists.add(node);
    return lists.finish(greatest, own);
}

}  // namespace scree::demos
