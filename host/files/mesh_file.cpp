// Triangle mesh files by their endings; glTF and GLB by tinygltf.
#include "host/files/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <set>
#include <utility>

#include "host/files/json_depth.h"

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace scree::host {

namespace {

constexpr std::size_t most_vertices = 100'000'000;
// Nesting limit of glTF JSON: the loader is recursive, and 256 levels use a tenth of the smallest stack.
constexpr std::size_t most_depth = 256;
// Limit of node visits in a glTF scene, counting shared children each time: 60 nodes that each reference the next one
// twice are 2^60 visits.
constexpr std::size_t most_nodes = 1'000'000;

// A file's name, for error messages.
struct Source {
    std::string name;
    [[noreturn]] void refuse(const std::string& reason) const { throw FileError(name + ": " + reason); }
};

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    return text;
}

// ---- glTF
// The elements of an accessor in memory.
struct Elements {
    const unsigned char* first;
    std::size_t stride, count;
    int component;
};

// Of a primitive.
struct GltfLook {
    std::size_t material = 0;  // of the surface
    std::string coordinates;   // attribute of texture coordinates; empty: no image
    glm::mat3x2 map{1};        // of coordinates: the extension KHR_texture_transform
    std::vector<glm::vec4> at, colors;
};

// Materials and images of a glTF file as surfaces of its meshes.
class GltfSurfaces {
public:
    GltfSurfaces(const tinygltf::Model& model, const std::string& name, const std::filesystem::path& folder)
        : model_(model), name_(name), folder_(folder), images_(model.images.size()) {}

    GltfLook look_of(const tinygltf::Primitive& primitive) {
        GltfLook look;
        const auto index = static_cast<std::size_t>(primitive.material);
        if (primitive.material < 0 || index >= model_.materials.size()) return look;
        look.material = index + 1;
        any_ = true;
        if (materials_.empty()) materials_.resize(1 + model_.materials.size());
        const tinygltf::Material& from = model_.materials[index];
        const tinygltf::TextureInfo& texture = from.pbrMetallicRoughness.baseColorTexture;
        SurfaceMaterial& made = materials_[look.material];
        if (!known_.contains(index)) made = material_of(from, index);
        known_.insert(index);
        if (!made.image) return look;
        look.coordinates = "TEXCOORD_" + std::to_string(std::max(texture.texCoord, 0));
        if (const auto moved = texture.extensions.find("KHR_texture_transform"); moved != texture.extensions.end()) {
            const tinygltf::Value& map = moved->second;
            const auto number = [&](const char* key, std::size_t k, double otherwise) {
                const tinygltf::Value& list = map.Has(key) ? map.Get(key) : map;
                const double value = list.IsArray() && k < list.ArrayLen() ? list.Get(k).GetNumberAsDouble() : otherwise;
                return static_cast<float>(std::abs(value) <= 1e6 ? value : otherwise);
            };
            const double turn = map.Has("rotation") ? map.Get("rotation").GetNumberAsDouble() : 0;
            const float c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
            const glm::vec2 scale(number("scale", 0, 1), number("scale", 1, 1));
            if (std::isfinite(c))
                look.map = {
                    scale.x * glm::vec2(c, -s), scale.y * glm::vec2(s, c), {number("offset", 0, 0), number("offset", 1, 0)}};
            if (map.Has("texCoord")) look.coordinates = "TEXCOORD_" + std::to_string(map.Get("texCoord").GetNumberAsInt());
        }
        if (!primitive.attributes.contains(look.coordinates)) {
            remark(index, "its image is left out: a mesh has no texture coordinates (" + look.coordinates + ")");
            SurfaceMaterial plain = made;
            plain.image = nullptr;
            const auto at = std::find(materials_.begin(), materials_.end(), plain);
            look.material = static_cast<std::size_t>(at - materials_.begin());
            if (at == materials_.end()) materials_.push_back(std::move(plain));
            look.coordinates.clear();
        }
        return look;
    }

    // The triangle put last into the mesh; vertices count from the primitive's first.
    void add(const GltfLook& look, const std::array<std::uint32_t, 3>& vertices, const MeshFile& mesh) {
        if (look.material == 0 && look.colors.empty()) return;
        any_ = true;
        triangles_.resize(mesh.triangles.size());
        MeshSurface::Triangle& made = triangles_.back();
        made.material = static_cast<std::uint32_t>(look.material);
        for (std::size_t k = 0; k < 3; ++k) {
            if (!look.at.empty()) made.at[k] = look.map * glm::vec3(glm::vec2(look.at[vertices[k]]), 1);
            if (!look.colors.empty()) made.colors[k] = packed_levels(glm::vec3(look.colors[vertices[k]]));
        }
    }
    void finish(MeshFile& mesh) {
        if (any_ && !mesh.triangles.empty()) {
            triangles_.resize(mesh.triangles.size());
            if (materials_.empty()) materials_.resize(1);
            mesh.surface = shared_surface(part_of({materials_, std::move(triangles_)}, 0, mesh.triangles.size()));
        }
        mesh.remarks = std::exchange(remarks_, {});
        triangles_.clear();
        any_ = false;
    }

private:
    void remark(std::size_t index, const std::string& text) {
        const std::string& called = model_.materials[index].name;
        std::string line = name_ + ": material " + (called.empty() ? std::to_string(index) : "\"" + called + "\"") + ": " + text;
        if (std::find(remarks_.begin(), remarks_.end(), line) == remarks_.end()) remarks_.push_back(std::move(line));
    }
    static Wrap wrap_of(int word) {
        return word == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
               : word == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                               : Wrap::repeat;
    }
    SurfaceMaterial material_of(const tinygltf::Material& from, std::size_t index) {
        SurfaceMaterial made{from.name.empty() ? "material " + std::to_string(index) : from.name};
        const std::vector<double>& rgba = from.pbrMetallicRoughness.baseColorFactor;
        if (rgba.size() >= 3) made.color = glm::clamp(glm::vec3(glm::dvec3(rgba[0], rgba[1], rgba[2])), 0.0f, 1.0f);
        const int texture = from.pbrMetallicRoughness.baseColorTexture.index;
        if (texture < 0) return made;
        if (static_cast<std::size_t>(texture) >= model_.textures.size()) {
            remark(index, "its texture " + std::to_string(texture) + " is not there");
            return made;
        }
        const tinygltf::Texture& found = model_.textures[static_cast<std::size_t>(texture)];
        if (found.sampler >= 0 && static_cast<std::size_t>(found.sampler) < model_.samplers.size()) {
            made.across = wrap_of(model_.samplers[static_cast<std::size_t>(found.sampler)].wrapS);
            made.down = wrap_of(model_.samplers[static_cast<std::size_t>(found.sampler)].wrapT);
        }
        if (found.source < 0 || static_cast<std::size_t>(found.source) >= model_.images.size()) {
            remark(index, "its texture has no image that is read here");
            return made;
        }
        const auto source = static_cast<std::size_t>(found.source);
        const tinygltf::Image& image = model_.images[source];
        const std::string called = !image.uri.empty() ? image.uri : !image.name.empty() ? image.name : std::to_string(source);
        try {
            if (!images_[source]) images_[source] = read(image, called);
            made.image = images_[source];
        } catch (const FileError& error) {
            remark(index, "its image \"" + called.substr(0, 200) + "\" is left out: " + error.what());
        }
        return made;
    }
    std::shared_ptr<const SurfaceImage> read(const tinygltf::Image& image, const std::string& called) const {
        if (!image.image.empty()) return surface_image(called, {image.image.begin(), image.image.end()});
        if (image.uri.empty()) throw FileError("it is empty");
        if (folder_.empty()) throw FileError("it is a file of its own");
        return image_beside(folder_, tinygltf::dlib::urldecode(image.uri));
    }

    const tinygltf::Model& model_;
    const std::string name_;
    const std::filesystem::path folder_;
    std::vector<std::shared_ptr<const SurfaceImage>> images_;
    std::vector<SurfaceMaterial> materials_;
    std::set<std::size_t> known_;
    std::vector<MeshSurface::Triangle> triangles_;
    std::vector<std::string> remarks_;
    bool any_ = false;
};

class Gltf {
public:
    Gltf(const tinygltf::Model& model, const Source& source, const std::filesystem::path& folder)
        : model_(model), source_(source), surfaces_(model, source.name, folder) {}

    MeshFile triangles() {
        refuse_packed();
        const int scene = model_.defaultScene >= 0 ? model_.defaultScene : 0;
        if (static_cast<std::size_t>(scene) < model_.scenes.size()) {
            for (const int node : model_.scenes[static_cast<std::size_t>(scene)].nodes) add_node(node, glm::dmat4(1), 0);
        } else {
            for (int mesh = 0; mesh < static_cast<int>(model_.meshes.size()); ++mesh) add_mesh(mesh, glm::dmat4(1));
        }
        surfaces_.finish(mesh_);
        return std::move(mesh_);
    }

    std::vector<MeshFile> each_mesh() {
        refuse_packed();
        std::vector<MeshFile> meshes;
        for (int mesh = 0; mesh < static_cast<int>(model_.meshes.size()); ++mesh) {
            add_mesh(mesh, glm::dmat4(1));
            surfaces_.finish(mesh_);
            meshes.push_back(std::exchange(mesh_, MeshFile{}));
        }
        return meshes;
    }

private:
    void refuse_packed() const {
        for (const std::string& extension : model_.extensionsRequired)
            if (extension.find("compression") != std::string::npos || extension.find("quantization") != std::string::npos)
                source_.refuse("needs the extension " + extension + ", which packs vertices; write the file without it");
    }

    Elements elements(int index, int type, const std::string& place) const {
        if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) source_.refuse(place + ": no such accessor");
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
        const std::string here = "/accessors/" + std::to_string(index);
        if (accessor.type != type) source_.refuse(here + ": has elements of the wrong type");
        if (accessor.sparse.isSparse) source_.refuse(here + ": is sparse, which is not read; write the file without");
        if (accessor.bufferView < 0 || static_cast<std::size_t>(accessor.bufferView) >= model_.bufferViews.size())
            source_.refuse(here + ": has no buffer view");
        const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size())
            source_.refuse(here + ": its buffer is missing");
        const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
        const int stride = accessor.ByteStride(view);
        const int width = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
                          tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
        if (stride <= 0 || width <= 0 || accessor.count > most_vertices) source_.refuse(here + ": is malformed");
        const std::size_t begin = view.byteOffset + accessor.byteOffset;
        const std::size_t length =
            accessor.count == 0 ? 0 : (accessor.count - 1) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(width);
        if (begin > data.size() || length > data.size() - begin) source_.refuse(here + ": reaches beyond its buffer");
        return {data.data() + begin, static_cast<std::size_t>(stride), accessor.count, accessor.componentType};
    }

    std::uint32_t index_at(const Elements& elements, std::size_t i) const {
        const unsigned char* at = elements.first + i * elements.stride;
        if (elements.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *at;
        if (elements.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
            std::uint16_t value = 0;
            std::memcpy(&value, at, sizeof value);
            return value;
        }
        std::uint32_t value = 0;
        std::memcpy(&value, at, sizeof value);
        return value;
    }

    void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& turn, const std::string& place) {
        const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
        if (mode < TINYGLTF_MODE_TRIANGLES) return;  // points and lines are ignored
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) source_.refuse(place + ": has no POSITION");
        const Elements places = elements(position->second, TINYGLTF_TYPE_VEC3, place);
        if (places.component != TINYGLTF_COMPONENT_TYPE_FLOAT) source_.refuse(place + ": its POSITION is not of floats");
        if (places.count > most_vertices - mesh_.vertices.size())
            source_.refuse(place + ": with it the scene has more than " + std::to_string(most_vertices) +
                           " vertices, a mesh of several nodes counted for each; write a simpler mesh");
        const auto material = static_cast<std::size_t>(primitive.material);
        if (primitive.material >= 0 && material < model_.materials.size() && !mesh_.color) {
            const std::vector<double>& rgba = model_.materials[material].pbrMetallicRoughness.baseColorFactor;
            if (rgba.size() >= 3) mesh_.color = glm::vec3(glm::dvec3(rgba[0], rgba[1], rgba[2]));
        }
        const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
        for (std::size_t i = 0; i < places.count; ++i) {
            glm::vec3 at;
            std::memcpy(&at, places.first + i * places.stride, sizeof at);
            mesh_.vertices.push_back(glm::vec3(turn * glm::dvec4(glm::dvec3(at), 1)));
        }
        std::vector<std::uint32_t> corners(places.count);
        for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
        if (primitive.indices >= 0) {
            const Elements indices = elements(primitive.indices, TINYGLTF_TYPE_SCALAR, place);
            corners.resize(indices.count);
            for (std::size_t i = 0; i < corners.size(); ++i) {
                corners[i] = index_at(indices, i);
                if (corners[i] >= places.count)
                    source_.refuse(place + ": index " + std::to_string(i) + " is vertex " + std::to_string(corners[i]) + " of " +
                                   std::to_string(places.count));
            }
        }
        const GltfLook look = look_of(primitive, places.count, place);
        const bool mirrored = glm::determinant(glm::dmat3(turn)) < 0;
        const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
        for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
            const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
            const std::uint32_t a = corners[mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i];
            std::uint32_t b = corners[i + 1], c = corners[i + 2];
            if (odd != mirrored) std::swap(b, c);
            mesh_.triangles.emplace_back(base + a, base + b, base + c);
            surfaces_.add(look, {a, b, c}, mesh_);
        }
    }

    void add_mesh(int index, const glm::dmat4& turn) {
        const std::string place = "/meshes/" + std::to_string(index);
        if (index < 0 || static_cast<std::size_t>(index) >= model_.meshes.size()) source_.refuse(place + ": there is none");
        const auto& primitives = model_.meshes[static_cast<std::size_t>(index)].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            add_primitive(primitives[i], turn, place + "/primitives/" + std::to_string(i));
    }

    void add_node(int index, const glm::dmat4& above, int depth) {
        const std::string place = "/nodes/" + std::to_string(index);
        if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size()) source_.refuse(place + ": there is none");
        if (depth > 100) source_.refuse(place + ": the node hierarchy contains a cycle");
        if (++nodes_ > most_nodes)
            source_.refuse(place + ": with it the scene has more than " + std::to_string(most_nodes) +
                           " nodes, those with several parents counted for each; give every node one parent, or write the mesh "
                           "as one");
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
        glm::dmat4 turn(1);
        if (node.matrix.size() == 16) turn = glm::make_mat4(node.matrix.data());
        if (node.translation.size() == 3) turn[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
        if (node.rotation.size() == 4)
            turn *= glm::mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
        if (node.scale.size() == 3)
            for (int k = 0; k < 3; ++k) turn[k] *= node.scale[static_cast<std::size_t>(k)];
        turn = above * turn;
        if (node.mesh >= 0) add_mesh(node.mesh, turn);
        for (const int child : node.children) add_node(child, turn, depth + 1);
    }

    // Up to four floats of each vertex, of floats or normalised integers; none if the attribute is missing.
    std::vector<glm::vec4> attribute(const tinygltf::Primitive& primitive, const std::string& name, std::size_t count,
                                     const std::string& place) {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) return {};
        const auto index = static_cast<std::size_t>(found->second);
        const int type = index < model_.accessors.size() ? model_.accessors[index].type : TINYGLTF_TYPE_VEC2;
        if (type != TINYGLTF_TYPE_VEC2 && type != TINYGLTF_TYPE_VEC3 && type != TINYGLTF_TYPE_VEC4)
            source_.refuse(place + ": its " + name + " has elements of the wrong type");
        const Elements all = elements(found->second, type, place);
        if (all.count < count) source_.refuse(place + ": its " + name + " is shorter than its POSITION");
        std::vector<glm::vec4> values(count, glm::vec4(0, 0, 0, 1));
        const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
        for (std::size_t i = 0; i < count; ++i)
            for (int k = 0; k < components; ++k) values[i][k] = component(all, i, k);
        return values;
    }
    static float component(const Elements& all, std::size_t i, int k) {
        const unsigned char* at = all.first + i * all.stride;
        if (all.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return static_cast<float>(at[k]) / 255;
        if (all.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
            std::uint16_t value = 0;
            std::memcpy(&value, at + 2 * k, sizeof value);
            return static_cast<float>(value) / 65535;
        }
        float value = 0;
        if (all.component == TINYGLTF_COMPONENT_TYPE_FLOAT) std::memcpy(&value, at + 4 * k, sizeof value);
        return std::isfinite(value) ? value : 0;
    }
    GltfLook look_of(const tinygltf::Primitive& primitive, std::size_t count, const std::string& place) {
        GltfLook look = surfaces_.look_of(primitive);
        if (!look.coordinates.empty()) look.at = attribute(primitive, look.coordinates, count, place);
        look.colors = attribute(primitive, "COLOR_0", count, place);
        return look;
    }

    const tinygltf::Model& model_;
    const Source& source_;
    GltfSurfaces surfaces_;
    MeshFile mesh_;
    std::size_t nodes_ = 0;
};

// The JSON of a GLB file: its first chunk, after the file header (12 bytes) and the chunk header (8, beginning with
// its length).
std::string_view json_of(std::string_view bytes, bool binary) {
    if (!binary) return bytes;
    if (bytes.size() < 20) return {};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return bytes.substr(20, length);
}

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;

// A .gltf names its buffers: files of its folder, no others.
std::filesystem::path buffer_file(const std::string& name, void* folder) {
    std::error_code failed;
    const std::filesystem::path within = std::filesystem::weakly_canonical(*static_cast<std::filesystem::path*>(folder), failed);
    const std::filesystem::path file = std::filesystem::weakly_canonical(name, failed);
    return is_inside(file, within) ? file : std::filesystem::path();
}
bool buffer_exists(const std::string& name, void* folder) {
    std::error_code failed;
    const std::filesystem::path file = buffer_file(name, folder);
    return !file.empty() && std::filesystem::is_regular_file(file, failed);
}
bool read_buffer(std::vector<unsigned char>* bytes, std::string* error, const std::string& name, void* folder) {
    try {
        const std::string text = read_regular(buffer_file(name, folder), most_bytes);
        bytes->assign(text.begin(), text.end());
        return true;
    } catch (const FileError& failure) {
        if (error) *error += failure.what();
        return false;
    }
}

void load_gltf(tinygltf::Model& model, std::string_view bytes, bool binary, const Source& source,
               const std::filesystem::path& folder) {
    if (const auto place = nested_deeper_than(most_depth, json_of(bytes, binary)))
        source.refuse(*place + ": lies in more than " + std::to_string(most_depth) +
                      " arrays and objects; write the file without such \"extras\"");
    tinygltf::TinyGLTF loader;
    // Images stay encoded.
    loader.SetImageLoader(
        [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* first, int size, void*) {
            if (size > 0) image->image.assign(first, first + size);
            return true;
        },
        nullptr);
    std::filesystem::path base = folder.empty() ? "." : folder;
    loader.SetFsCallbacks({&buffer_exists, [](const std::string& path, void*) { return path; }, &read_buffer, nullptr, &base});
    std::string error, warning;
    const auto size = static_cast<unsigned>(bytes.size());
    const bool read = binary
                          ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(bytes.data()), size, base.string())
                          : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, base.string());
    if (!read) source.refuse("not a glTF file: " + one_line(error.empty() ? warning : error));
}

MeshFile from_gltf(std::string_view bytes, bool binary, const Source& source, const std::filesystem::path& folder) {
    tinygltf::Model model;
    load_gltf(model, bytes, binary, source, folder);
    return Gltf(model, source, folder).triangles();
}

std::string ending_of(const std::string& name) {
    std::string ending = std::filesystem::path(name).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending != ".obj" && ending != ".gltf" && ending != ".glb" && ending != ".stl")
        Source{name}.refuse("meshes are read from .obj, .gltf, .glb and .stl files");
    return ending;
}

}  // namespace

std::vector<MeshFile> meshes_of_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder) {
    const Source source{name};
    tinygltf::Model model;
    load_gltf(model, bytes, ending_of(name) == ".glb", source, folder);
    return Gltf(model, source, folder).each_mesh();
}

std::string_view json_of_gltf(std::string_view bytes, const std::string& name) {
    const std::string_view json = json_of(bytes, ending_of(name) == ".glb");
    if (const auto place = nested_deeper_than(most_depth, json))
        Source{name}.refuse(*place + ": lies in more than " + std::to_string(most_depth) + " arrays and objects");
    return json;
}

MeshFile mesh_of(std::string_view bytes, const std::string& name, const std::filesystem::path& folder) {
    const Source source{name};
    const std::string ending = ending_of(name);
    MeshFile mesh = ending == ".obj"   ? mesh_of_obj(bytes, name, folder)
                    : ending == ".stl" ? mesh_of_stl(bytes, name)
                                       : from_gltf(bytes, ending == ".glb", source, folder);
    if (mesh.triangles.empty()) source.refuse("has no triangles");
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(mesh.vertices[i][k])) source.refuse("vertex " + std::to_string(i + 1) + " is not finite");
    return mesh;
}

MeshFile read_mesh(const std::filesystem::path& path) {
    ending_of(path.string());  // refused before the file is read
    return mesh_of(read_regular(path, most_bytes), path.string(), path.has_parent_path() ? path.parent_path() : ".");
}

}  // namespace scree::host
