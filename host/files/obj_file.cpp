// Wavefront OBJ files: their statements are read here, with lines for errors; tinyobjloader cuts polygons into triangles.
#include <algorithm>
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

// The same vertices, groups and faces in the words that tinyobjloader reads rightly. A group has its line as its name.
class ObjText {
public:
    ObjText(std::string_view bytes, const std::string& name) : statements_(bytes), name_(name) {}

    std::string plain() {
        while (statements_.next()) {
            const std::string_view keyword = statements_.word();
            if (keyword == "v")
                add_vertex();
            else if (keyword == "f" || keyword == "fo")  // fo: a face, in the format's earlier text
                add_face();
            else if (keyword == "g" || keyword == "o")
                text_ += "g " + (group_ = std::to_string(statements_.line())) + "\n";
            else if (keyword == "usemtl")
                material_ = statements_.word();
            else if (keyword == "mtllib")
                for (std::string_view word = statements_.word(); !word.empty(); word = statements_.word())
                    libraries_.emplace_back(word);
        }
        for (const auto& [index, line] : ahead_)
            if (index > vertices_) refuse_index(line, index);
        return std::move(text_);
    }
    std::vector<std::string>& libraries() { return libraries_; }
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

    // 1, 1/2, 1//3, 1/2/3, and with a slash too many at the end; the first number is the vertex.
    long long vertex_of(std::string_view corner) const {
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
        return index;
    }

    void add_face() {
        std::string face = "f";
        std::size_t corners = 0;
        for (std::string_view word = statements_.word(); !word.empty(); word = statements_.word(), ++corners) {
            const long long index = vertex_of(word);
            if (index > vertices_) ahead_.emplace_back(index, statements_.line());
            face += " " + std::to_string(index);
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
    long long vertices_ = 0;
    std::vector<std::pair<long long, std::size_t>> ahead_;  // indices of vertices that come later, with their lines
};

}  // namespace

MeshFile mesh_of_obj(std::string_view bytes, const std::string& name) {
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
        }
    }
    mesh.libraries = std::move(text.libraries());
    return mesh;
}

std::map<std::string, glm::vec3> colors_of_mtl(std::string_view bytes, const std::string& name) {
    std::map<std::string, glm::vec3> colors;
    std::string material;
    for (ObjStatements statements(checked_start(bytes, name)); statements.next();) {
        const std::string_view keyword = statements.word();
        if (keyword == "newmtl") material = statements.word();
        if (keyword != "Kd") continue;
        std::string_view word = statements.word();
        if (word == "spectral" || word == "xyz") continue;  // not as red, green and blue
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
        colors.try_emplace(material, color);
    }
    return colors;
}

}  // namespace scree::host
