// Wavefront OBJ files: their statements are read here, with lines for errors; tinyobjloader cuts polygons into triangles.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

#include "host/files/finite_number.h"
#include "host/files/mesh_file.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace scree::host {

namespace {

bool is_blank(char c) {
    return static_cast<unsigned char>(c) <= ' ';
}

// Statements without their comments. A backslash at the end of a line continues it, but not a comment.
class ObjStatements {
public:
    explicit ObjStatements(std::string_view text) : text_(text) {}

    bool next() {
        statement_.clear();
        while (!text_.empty()) {
            line_ = lines_ + 1;
            while (!text_.empty() && add_line()) {
            }
            rest_ = statement_;
            if (std::any_of(rest_.begin(), rest_.end(), [](char c) { return !is_blank(c); })) return true;
            statement_.clear();
        }
        return false;
    }
    // The next word of the statement; empty behind the last.
    std::string_view word() {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
        const auto end = std::find_if(rest_.begin(), rest_.end(), is_blank);
        const std::string_view found = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
        rest_.remove_prefix(found.size());
        return found;
    }
    // What is left of the statement, without blanks around it.
    std::string_view rest() {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
        while (!rest_.empty() && is_blank(rest_.back())) rest_.remove_suffix(1);
        return std::exchange(rest_, {});
    }
    std::size_t line() const { return line_; }  // where the statement begins

private:
    bool add_line() {  // returns whether the next one continues it
        const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
        std::string_view line = text_.substr(0, text_.substr(0, end).find('#'));
        line = line.substr(0, std::min(line.size(), end));
        text_.remove_prefix(text_.substr(end).starts_with("\r\n") ? end + 2 : std::min(end + 1, text_.size()));
        ++lines_;
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        const bool continued = line.ends_with('\\');
        if (continued) line.remove_suffix(1);
        statement_.append(line) += ' ';
        return continued;
    }

    std::string_view text_, rest_;
    std::string statement_;
    std::size_t lines_ = 0, line_ = 0;
};

[[noreturn]] void refuse_line(const std::string& name, std::size_t line, const std::string& reason) {
    throw FileError(name + ": line " + std::to_string(line) + ": " + reason);
}

std::string_view checked_start(std::string_view bytes, const std::string& name) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
        throw FileError(name + ": is UTF-16 text; write it as ASCII or UTF-8");
    return bytes.substr(bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0);  // a byte order mark
}

// The same vertices, groups and faces in the words that tinyobjloader reads rightly. A group has its line as its name, and a face
// the number of its material as its smoothing group, which its triangles keep.
class ObjText {
public:
    ObjText(std::string_view bytes, const std::string& name) : statements_(bytes), name_(name) {}

    std::string plain() {
        while (statements_.next()) {
            const std::string_view keyword = statements_.word();
            if (keyword == "v")
                add_vertex();
            else if (keyword == "vt")
                add_coordinates();
            else if (keyword == "f" || keyword == "fo")  // fo: a face, in the format's earlier text
                add_face();
            else if (keyword == "g" || keyword == "o")
                text_ += "g " + (group_ = std::to_string(statements_.line())) + "\n";
            else if (keyword == "usemtl")
                use(std::string(statements_.word()));
            else if (keyword == "mtllib")
                for (std::string_view word = statements_.word(); !word.empty(); word = statements_.word())
                    libraries_.emplace_back(word);
        }
        for (const auto& [index, line] : ahead_)
            if (index > vertices_) refuse_index(line, index);
        return std::move(text_);
    }
    std::vector<std::string>& libraries() { return libraries_; }
    const std::vector<std::string>& used() const { return used_; }  // materials by their numbers; the first is none
    std::string material(const std::string& group) const {
        const auto known = materials_.find(group);
        return known == materials_.end() ? "" : known->second;
    }

private:
    [[noreturn]] void refuse(std::size_t line, const std::string& reason) const { refuse_line(name_, line, reason); }
    [[noreturn]] void refuse_index(std::size_t line, long long index) const {
        refuse(line, "a face has vertex " + std::to_string(index) + " of " + std::to_string(vertices_));
    }

    void add_vertex() {
        text_ += "v";
        for (int k = 0; k < 3; ++k) {
            std::string_view word = statements_.word();
            if (!finite_number(word)) refuse(statements_.line(), "a vertex needs three finite numbers");
            text_.append(" ").append(word);
        }
        text_ += "\n";
        ++vertices_;
    }

    void add_coordinates() {
        text_ += "vt";
        for (int k = 0; k < 2; ++k) {
            std::string_view word = statements_.word();
            const bool known = finite_number(word).has_value();
            text_.append(" ").append(known ? word : "0");
        }
        text_ += "\n";
        ++coordinates_;
    }

    void use(std::string name) {
        const auto [number, fresh] = numbers_.try_emplace(name, used_.size());
        text_ += "s " + std::to_string(number->second) + "\n";
        if (fresh) used_.push_back(name);
        material_ = std::move(name);
    }

    struct Corner {
        long long vertex = 0, coordinates = 0;  // the second 0: none
    };
    // 1, 1/2, 1//3, 1/2/3, and with a slash too many at the end; the first number is the vertex, the second its coordinates.
    Corner corner_of(std::string_view corner) const {
        long long numbers[3] = {0, 0, 0};
        std::size_t k = 0;
        bool known = true;
        for (std::string_view rest = corner; known; ++k) {
            const std::size_t end = std::min(rest.find('/'), rest.size());
            const auto [stop, error] = std::from_chars(rest.data(), rest.data() + end, numbers[std::min<std::size_t>(k, 2)]);
            known = k < 3 && stop == rest.data() + end && (end == 0 ? k > 0 : error == std::errc());
            if (end == rest.size()) break;
            rest.remove_prefix(end + 1);
        }
        if (!known)
            refuse(statements_.line(), "a face has a corner \"" + std::string(corner.substr(0, 40)) +
                                           "\"; corners are indices as in 1, 1/2, 1//3 and 1/2/3");
        const long long index = numbers[0] < 0 ? vertices_ + 1 + numbers[0] : numbers[0];
        if (index < 1) refuse_index(statements_.line(), numbers[0]);
        const long long at = numbers[1] < 0 ? coordinates_ + 1 + numbers[1] : numbers[1];
        return {index, k > 0 && at >= 1 && at <= coordinates_ ? at : 0};
    }

    void add_face() {
        std::string face = "f";
        std::size_t corners = 0;
        for (std::string_view word = statements_.word(); !word.empty(); word = statements_.word(), ++corners) {
            const Corner corner = corner_of(word);
            if (corner.vertex > vertices_) ahead_.emplace_back(corner.vertex, statements_.line());
            face += " " + std::to_string(corner.vertex);
            if (corner.coordinates > 0) face += "/" + std::to_string(corner.coordinates);
        }
        if (corners < 3) return;  // it has no area
        text_ += face + "\n";
        materials_.try_emplace(group_, material_);
    }

    ObjStatements statements_;
    const std::string& name_;
    std::string text_, group_, material_;
    std::vector<std::string> libraries_;
    std::map<std::string, std::string> materials_;  // of the first face of each group
    std::vector<std::string> used_{""};
    std::map<std::string, std::size_t> numbers_{{"", 0}};  // of used_
    long long vertices_ = 0, coordinates_ = 0;
    std::vector<std::pair<long long, std::size_t>> ahead_;  // indices of vertices that come later, with their lines
};

constexpr std::uintmax_t most_library_bytes = std::uintmax_t{16} << 20;

// The materials that an OBJ file uses, by their numbers. What is left out is remarked.
class ObjMaterials {
public:
    ObjMaterials(const std::vector<std::string>& used, const std::string& name, const std::filesystem::path& folder,
                 MeshFile& mesh)
        : name_(name), mesh_(mesh) {
        std::map<std::string, MtlMaterial> known;
        for (const std::string& library : mesh.libraries) {
            try {
                known.merge(materials_of_mtl(bytes_beside(folder, library, most_library_bytes), library));
            } catch (const FileError& error) {
                remark("\"" + library + "\" is left out: " + error.what());
            }
        }
        for (const std::string& word : used) {
            const auto found = known.find(word);
            materials_.push_back(found == known.end() ? MtlMaterial{} : found->second);
            any_ = any_ || found != known.end();
            SurfaceMaterial& made = made_.materials.emplace_back(SurfaceMaterial{word});
            // An image is the whole of the colour, as in most programs: many write a "Kd" of 0 beside it.
            known_.push_back(found != known.end());
            if (found == known.end()) continue;
            if (found->second.color) made.color = linear_of_levels(levels_of(*found->second.color));
            if (found->second.clamps) made.across = made.down = Wrap::clamp;
            if (found->second.image.empty()) continue;
            try {
                made.image = image_beside(folder, found->second.image);
                made.color = glm::vec3(1);
            } catch (const FileError& error) {
                remark("material \"" + word + "\": its image \"" + found->second.image + "\" is left out: " + error.what());
            }
        }
    }

    bool any() const { return any_; }
    // Coordinates of three corners, from the lower left; null: some have none.
    void add(std::size_t material, const std::array<glm::vec2, 3>* at) {
        MeshSurface::Triangle& made = made_.triangles.emplace_back();
        if (material >= materials_.size() || !known_[material]) return;
        made.material = static_cast<std::uint32_t>(material);
        if (!made_.materials[material].image) return;
        if (at == nullptr) {
            made.material = static_cast<std::uint32_t>(without(material));
            return;
        }
        const MtlMaterial& map = materials_[material];
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 placed = (*at)[k] * map.scale + map.offset;
            made.at[k] = {placed.x, 1 - placed.y};
        }
    }
    std::shared_ptr<const MeshSurface> finish() { return shared_surface(std::move(made_)); }

private:
    static std::uint32_t levels_of(glm::vec3 srgb) {
        const auto level = [](float x) { return static_cast<std::uint32_t>(255 * x + 0.5f); };
        return level(srgb.r) | level(srgb.g) << 8 | level(srgb.b) << 16;
    }
    void remark(const std::string& text) { mesh_.remarks.push_back(name_ + ": " + text); }
    // The same material without its image, for faces without coordinates.
    std::size_t without(std::size_t material) {
        const auto [place, fresh] = plain_.try_emplace(material, made_.materials.size());
        if (fresh) {
            SurfaceMaterial plain = made_.materials[material];
            plain.image = nullptr;
            if (materials_[material].color) plain.color = linear_of_levels(levels_of(*materials_[material].color));
            remark("material \"" + plain.name + "\": faces without texture coordinates (\"vt\") are drawn without its image");
            made_.materials.push_back(std::move(plain));
        }
        return place->second;
    }

    const std::string& name_;
    MeshFile& mesh_;
    std::vector<MtlMaterial> materials_;
    std::vector<bool> known_;  // which of them a library has
    std::map<std::size_t, std::size_t> plain_;
    MeshSurface made_;
    bool any_ = false;
};

}  // namespace

MeshFile mesh_of_obj(std::string_view bytes, const std::string& name, const std::filesystem::path& folder) {
    ObjText text(checked_start(bytes, name), name);
    tinyobj::ObjReaderConfig config;
    config.triangulate = true;
    tinyobj::ObjReader reader;
    if (!reader.ParseFromString(text.plain(), "", config))
        throw FileError(name + ": not an OBJ file: " + reader.Error().substr(0, reader.Error().find('\n')));
    MeshFile mesh;
    const auto& numbers = reader.GetAttrib().vertices;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        mesh.vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    mesh.libraries = std::move(text.libraries());
    std::optional<ObjMaterials> materials;
    if (!folder.empty() && !mesh.libraries.empty() && text.used().size() > 1) materials.emplace(text.used(), name, folder, mesh);
    const auto& coordinates = reader.GetAttrib().texcoords;
    for (const tinyobj::shape_t& shape : reader.GetShapes()) {
        const auto& indices = shape.mesh.indices;
        if (indices.size() > 2) {
            mesh.groups.push_back(mesh.triangles.size());
            mesh.materials.push_back(text.material(shape.name));
        }
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            glm::uvec3 triangle;
            for (std::size_t k = 0; k < 3; ++k)
                triangle[static_cast<int>(k)] = static_cast<std::uint32_t>(indices[i + k].vertex_index);
            mesh.triangles.push_back(triangle);
            if (!materials) continue;
            std::array<glm::vec2, 3> at{};
            bool placed = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto from = 2 * static_cast<std::size_t>(std::max(indices[i + k].texcoord_index, 0));
                placed = placed && indices[i + k].texcoord_index >= 0 && from + 1 < coordinates.size();
                if (placed) at[k] = {coordinates[from], coordinates[from + 1]};
            }
            materials->add(i / 3 < shape.mesh.smoothing_group_ids.size() ? shape.mesh.smoothing_group_ids[i / 3] : 0,
                           placed ? &at : nullptr);
        }
    }
    if (materials && materials->any()) mesh.surface = materials->finish();
    return mesh;
}

std::map<std::string, MtlMaterial> materials_of_mtl(std::string_view bytes, const std::string& name) {
    std::map<std::string, MtlMaterial> materials;
    std::string material;
    const auto add_color = [&](ObjStatements& statements) {
        std::string_view word = statements.word();
        if (word == "spectral" || word == "xyz") return;  // not as red, green and blue
        glm::vec3 color{0};
        for (int k = 0; k < 3; ++k, word = statements.word()) {
            const std::optional<float> level = finite_number(word);
            if (k > 0 && word.empty())
                color[k] = color.r;  // the format's rule
            else if (level)
                color[k] = glm::clamp(*level, 0.0f, 1.0f);
            else
                refuse_line(name, statements.line(), "\"Kd\" needs three finite numbers");
        }
        if (std::optional<glm::vec3>& known = materials[material].color; !known) known = color;
    };
    const auto add_image = [&](ObjStatements& statements) {
        MtlMaterial& made = materials[material];
        if (!made.image.empty()) return;
        // Options come first, each with its values; what is left is the file, whose name may have blanks.
        std::string_view rest = statements.rest();
        const auto next = [&] {
            const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
            const std::string_view found = rest.substr(0, end);
            rest.remove_prefix(std::min(rest.find_first_not_of(" \t", end), rest.size()));
            return found;
        };
        const auto number = [&](float& into) {
            std::string_view ahead = rest.substr(0, rest.find_first_of(" \t"));
            const std::optional<float> value = finite_number(ahead);
            if (!value) return false;
            into = *value;
            next();
            return true;
        };
        while (rest.starts_with('-') && rest.find_first_of(" \t") != rest.npos) {
            const std::string_view option = next();
            float unused = 0;
            if (option == "-s" || option == "-o" || option == "-t") {
                glm::vec2 values = option == "-s" ? glm::vec2(1) : glm::vec2(0);
                if (number(values.x) && number(values.y)) number(unused);
                if (option == "-s") made.scale = values;
                if (option == "-o") made.offset = values;
            } else if (option == "-mm") {
                if (number(unused)) number(unused);
            } else {
                const std::string_view value = next();
                if (option == "-clamp") made.clamps = value == "on";
            }
        }
        if (rest.size() > 1 && rest.starts_with('"') && rest.ends_with('"')) rest = rest.substr(1, rest.size() - 2);
        made.image = rest;
    };
    for (ObjStatements statements(checked_start(bytes, name)); statements.next();) {
        const std::string_view keyword = statements.word();
        if (keyword == "newmtl") material = statements.word();
        if (keyword == "Kd") add_color(statements);
        if (keyword == "map_Kd") add_image(statements);
    }
    return materials;
}

std::map<std::string, glm::vec3> colors_of_mtl(std::string_view bytes, const std::string& name) {
    std::map<std::string, glm::vec3> colors;
    for (const auto& [material, said] : materials_of_mtl(bytes, name))
        if (said.color) colors[material] = *said.color;
    return colors;
}

}  // namespace scree::host
