// Writing a scene as JSON text, one body a line, with the shortest digits that read back to the same float.
#include <bit>
#include <charconv>
#include <cmath>
#include <utility>

#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/vehicles_json.h"

namespace scree {

namespace {

// JSON text that grows.
class Text {
public:
    std::string take() { return std::move(text_); }
    Text& operator<<(std::string_view plain) {
        text_ += plain;
        return *this;
    }
    Text& operator<<(float value) {
        if (!std::isfinite(value)) throw SceneError("", "a value of the scene is not finite; JSON cannot hold it");
        if (value == 0) return *this << (std::signbit(value) ? "-0.0" : "0");
        char digits[64];
        char* end = std::to_chars(digits, digits + sizeof digits - 1, value).ptr;
        *end = '\0';
        // Readers go through a double; should that round twice to a neighbour, write all digits of the float instead.
        double wide = 0;
        std::from_chars(digits, end, wide);
        if (static_cast<float>(wide) != value)
            end = std::to_chars(digits, digits + sizeof digits, static_cast<double>(value)).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }
    template <glm::length_t size>
    Text& operator<<(const glm::vec<size, float>& v) {
        for (glm::length_t i = 0; i < size; ++i) *this << (i == 0 ? "[" : ", ") << v[i];
        return *this << "]";
    }
    void quoted(std::string_view words) {
        static constexpr char hex[] = "0123456789abcdef";
        text_ += '"';
        for (const char c : words) {
            const auto code = static_cast<unsigned char>(c);
            if (c == '"' || c == '\\') {
                text_ += '\\';
                text_ += c;
            } else if (code < 0x20) {
                text_ += "\\u00";
                text_ += hex[code >> 4];
                text_ += hex[code & 15];
            } else {
                text_ += c;
            }
        }
        text_ += '"';
    }
    template <class Value>
    void list(const std::vector<Value>& values) {
        *this << "[";
        for (std::size_t i = 0; i < values.size(); ++i) *this << (i == 0 ? "" : ", ") << values[i];
        *this << "]";
    }
    template <class Value>
    void unless_default(std::string_view key, const Value& value, const Value& by_default) {
        if (same_bits(value, by_default)) return;
        *this << ", \"" << key << "\": " << value;
    }

private:
    static bool same_bits(float a, float b) { return std::bit_cast<unsigned>(a) == std::bit_cast<unsigned>(b); }
    template <glm::length_t size>
    static bool same_bits(const glm::vec<size, float>& a, const glm::vec<size, float>& b) {
        for (glm::length_t i = 0; i < size; ++i) {
            if (!same_bits(a[i], b[i])) return false;
        }
        return true;
    }

    std::string text_;
};

void write(Text& text, const Shape& shape);

void write(Text& text, const Part& part) {
    static const Part by_default;
    write(text, whole_shape(part.shape));
    text.unless_default("position", part.position, by_default.position);
    text.unless_default("orientation", part.orientation, by_default.orientation);
    text.unless_default("density", part.density, by_default.density);
    text << "}";
}

void write(Text& text, const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        text << "{\"sphere\": {\"radius\": " << sphere->radius;
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        text << "{\"capsule\": {\"radius\": " << capsule->radius << ", \"half_height\": " << capsule->half_height;
    } else if (const auto* box = std::get_if<Box>(&shape)) {
        text << "{\"box\": {\"half_extents\": " << box->half_extents;
    } else if (const auto* plane = std::get_if<Plane>(&shape)) {
        text << "{\"plane\": {\"normal\": " << plane->normal << ", \"offset\": " << plane->offset;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        text << "{\"cylinder\": {\"radius\": " << cylinder->radius << ", \"half_height\": " << cylinder->half_height;
    } else if (const auto* cone = std::get_if<Cone>(&shape)) {
        text << "{\"cone\": {\"radius\": " << cone->radius << ", \"height\": " << cone->height;
    } else if (const auto* hull = std::get_if<Hull>(&shape)) {
        text << "{\"hull\": {\"points\": ";
        text.list(hull->points);
    } else if (const auto* compound = std::get_if<Compound>(&shape)) {
        text << "{\"compound\": {\"parts\": [";
        for (std::size_t i = 0; i < compound->parts.size(); ++i) {
            text << (i == 0 ? "{\"shape\": " : ", {\"shape\": ");
            write(text, compound->parts[i]);
        }
        text << "]";
    } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
        text << "{\"mesh\": {\"vertices\": ";
        text.list(mesh->vertices);
        text << ", \"triangles\": [";
        for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
            const glm::uvec3& t = mesh->triangles[i];
            text << (i == 0 ? "[" : ", [") << std::to_string(t.x) << ", " << std::to_string(t.y) << ", " << std::to_string(t.z)
                 << "]";
        }
        text << "]";
    } else if (const auto* field = std::get_if<HeightField>(&shape)) {
        text << "{\"height_field\": {\"columns\": " << std::to_string(field->columns)
             << ", \"rows\": " << std::to_string(field->rows) << ", \"spacing\": " << field->spacing << ", \"heights\": ";
        text.list(field->heights);
    }
    text << "}}";
}

void write(Text& text, const Fracture& fracture) {
    static const char* const cuttings[] = {"voronoi", "boxes", "splinters"};
    text << ", \"fracture\": {" << (fracture.momentum > 0 ? "\"momentum\": " : "\"impulse\": ")
         << (fracture.momentum > 0 ? fracture.momentum : fracture.impulse) << ", \"cutting\": \""
         << cuttings[static_cast<std::size_t>(fracture.cutting)] << "\", \"pieces\": " << std::to_string(fracture.pieces)
         << ", \"depth\": " << std::to_string(fracture.depth) << ", \"seed\": " << std::to_string(fracture.seed) << "}";
}

void write(Text& text, const Body& body) {
    static const Body by_default;
    text << "{";
    if (!body.name.empty()) {
        text << "\"name\": ";
        text.quoted(body.name);
        text << ", ";
    }
    if (body.motion != Motion::dynamic)
        text << "\"motion\": \"" << (body.motion == Motion::fixed ? "fixed" : "kinematic") << "\", ";
    text << "\"shape\": ";
    write(text, body.shape);
    text << ", \"position\": " << body.position;
    text.unless_default("orientation", body.orientation, by_default.orientation);
    text.unless_default("velocity", body.velocity, by_default.velocity);
    text.unless_default("angular_velocity", body.angular_velocity, by_default.angular_velocity);
    text.unless_default("density", body.density, by_default.density);
    text.unless_default("friction", body.friction, by_default.friction);
    text.unless_default("restitution", body.restitution, by_default.restitution);
    text.unless_default("rolling_resistance", body.rolling_resistance, by_default.rolling_resistance);
    text.unless_default("linear_damping", body.linear_damping, by_default.linear_damping);
    text.unless_default("angular_damping", body.angular_damping, by_default.angular_damping);
    text.unless_default("gravity_scale", body.gravity_scale, by_default.gravity_scale);
    if (body.tyre)
        text << ", \"tyre\": {\"best_slip\": " << body.tyre->best_slip << ", \"sliding\": " << body.tyre->sliding << "}";
    if (body.fracture) write(text, *body.fracture);
    text << "}";
}

template <class View>
void write_view(Text& text, const View& view) {
    text << "\"eye\": " << view.eye << ", \"target\": " << view.target << ", \"vertical_fov\": " << view.vertical_fov;
}

void write(Text& text, const Viewpoint& view) {
    text << " \"camera\": {" << (view.orthographic ? "\"orthographic\": true, " : "");
    if (view.path.empty()) {
        write_view(text, view);
    } else {
        const char* between = "\"path\": [\n  ";
        for (const ViewKey& key : view.path) {
            text << between << "{\"time\": " << key.time << ", ";
            write_view(text, key);
            text << "}";
            between = ",\n  ";
        }
        text << "]";
    }
    text << "},\n";
}

}  // namespace

std::string body_to_json(const Body& body) {
    Text text;
    write(text, body);
    return text.take();
}

std::string scene_to_json(const Scene& scene, const std::optional<Viewpoint>& viewpoint) {
    Text text;
    text << "{\"gravity\": " << scene.gravity << ",\n";
    if (viewpoint) write(text, *viewpoint);
    text << " \"bodies\": [";
    const char* between = "\n  ";
    for (const Body& body : scene.bodies) {
        if (body.piece_of != no_body) continue;  // made when the scene is checked
        text << between;
        write(text, body);
        between = ",\n  ";
    }
    text << "\n]";
    between = ",\n \"joints\": [\n  ";
    for (const Joint& joint : scene.joints) {
        text << between << joint_to_json(joint);
        between = ",\n  ";
    }
    if (!scene.joints.empty()) text << "\n]";
    between = ",\n \"vehicles\": [\n  ";
    for (const Vehicle& vehicle : scene.vehicles) {
        text << between << vehicle_to_json(vehicle);
        between = ",\n  ";
    }
    text << (scene.vehicles.empty() ? "}\n" : "\n]}\n");
    return text.take();
}

}  // namespace scree
