// Triangle mesh files by their endings; glTF and GLB by tinygltf.
#include "host/files/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
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

class Gltf {
public:
    Gltf(const tinygltf::Model& model, const Source& source) : model_(model), source_(source) {}

    MeshFile triangles() {
        refuse_packed();
        const int scene = model_.defaultScene >= 0 ? model_.defaultScene : 0;
        if (static_cast<std::size_t>(scene) < model_.scenes.size()) {
            for (const int node : model_.scenes[static_cast<std::size_t>(scene)].nodes) add_node(node, glm::dmat4(1), 0);
        } else {
            for (int mesh = 0; mesh < static_cast<int>(model_.meshes.size()); ++mesh) add_mesh(mesh, glm::dmat4(1));
        }
        return std::move(mesh_);
    }

    std::vector<MeshFile> each_mesh() {
        refuse_packed();
        std::vector<MeshFile> meshes;
        for (int mesh = 0; mesh < static_cast<int>(model_.meshes.size()); ++mesh) {
            add_mesh(mesh, glm::dmat4(1));
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
        const bool mirrored = glm::determinant(glm::dmat3(turn)) < 0;
        const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
        for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
            const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
            const std::uint32_t a = corners[mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i];
            std::uint32_t b = corners[i + 1], c = corners[i + 2];
            if (odd != mirrored) std::swap(b, c);
            mesh_.triangles.emplace_back(base + a, base + b, base + c);
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

    const tinygltf::Model& model_;
    const Source& source_;
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
    const auto [end, rest] = std::mismatch(within.begin(), within.end(), file.begin(), file.end());
    return end == within.end() && rest != file.end() ? file : std::filesystem::path();
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
    // Skip images, which collision does not need.
    loader.SetImageLoader(
        [](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) { return true; },
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
    return Gltf(model, source).triangles();
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
    return Gltf(model, source).each_mesh();
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
    MeshFile mesh = ending == ".obj"   ? mesh_of_obj(bytes, name)
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
    return mesh_of(read_regular(path, most_bytes), path.string(), path.parent_path());
}

}  // namespace scree::host
