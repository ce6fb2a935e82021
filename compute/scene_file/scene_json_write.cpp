// Writing a scene as JSON text, one body a line, with the shortest digits that read back to the same float.
#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/json_text.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/shapes_json.h"
#include "compute/scene_file/vehicles_json.h"

namespace scree {

namespace {

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
    write_shape(text, body.shape);
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
