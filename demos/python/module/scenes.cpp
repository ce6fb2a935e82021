// Scenes: described by JSON as in scene files, so that every field is here without being named, and by arrays in bulk.
#include <pybind11/stl.h>

#include <functional>
#include <map>
#include <utility>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "compute/scene_file/import/import_scene.h"
#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/load_scene.h"
#include "compute/scene_file/scene_schema.h"
#include "compute/vehicle_presets.h"
#include "demos/program/loaded_scene.h"
#include "demos/python/module/bindings.h"
#include "demos/scenes/demos.h"
#include "host/files/file.h"
#include "host/files/mesh_file.h"

namespace scree::python {

using namespace json_reading;

nlohmann::json json_of(const std::string& text) {
    return parsed(text);
}

py::dict settings_dict(const Settings& settings) {
    py::dict made;
    schema::for_each_field<Settings>([&](const auto& field) { made[field.key] = settings.*field.member; });
    return made;
}

namespace {

void read_mesh_file(Body& body, const Place& place) {
    auto* mesh = std::get_if<Mesh>(&body.shape);
    if (!mesh || mesh->file.empty() || !mesh->vertices.empty()) return;
    try {
        host::MeshFile read = host::read_mesh(mesh->file);
        mesh->vertices = std::move(read.vertices);
        mesh->triangles = std::move(read.triangles);
        for (vec3& vertex : mesh->vertices) vertex *= mesh->scale;
    } catch (const host::FileError& error) {
        refuse(place / "shape" / "mesh" / "file", error.what());
    }
}

// Sets a field of each of `bodies` from an array, by its key: of numbers, and of vectors of three and four.
void set_from_array(std::span<Body> bodies, const std::string& key, const Floats& values) {
    const auto n = static_cast<py::ssize_t>(bodies.size());
    bool found = false;
    schema::for_each_field<Body>([&]<class Member>(const schema::Field<Body, Member>& field) {
        if (key != field.key) return;
        if constexpr (std::is_same_v<Member, float> || std::is_same_v<Member, vec3> || std::is_same_v<Member, vec4>) {
            found = true;
            constexpr py::ssize_t width = std::is_same_v<Member, float> ? 0 : std::is_same_v<Member, vec3> ? 3 : 4;
            require_shape(values, n, width, field.key);
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                if constexpr (width == 0) bodies[i].*field.member = values.data()[i];
                if constexpr (width == 3) bodies[i].*field.member = vec3_at(values.data(), i);
                if constexpr (width == 4) bodies[i].*field.member = vec4_at(values.data(), i);
            }
        }
    });
    if (!found) throw py::type_error("\"" + key + "\" is not a number or vector of each body");
}

using Columns = std::map<std::string, Floats>;

// `count` bodies that are alike but for what the columns say.
std::vector<Body> bodies_of(const std::string& text, std::size_t count, const Columns& columns, const Place& place) {
    Body body = body_of(json_of(text), place);
    read_mesh_file(body, place);
    std::vector<Body> bodies(count, body);
    for (const auto& [key, values] : columns) set_from_array(bodies, key, values);
    return bodies;
}

std::size_t add_bodies(Description& scene, const std::string& text, std::size_t count, const Columns& columns) {
    std::vector<Body>& all = scene.document.scene.bodies;
    const std::size_t first = all.size();
    const Place bodies = root / "bodies";
    std::vector<Body> made = bodies_of(text, count, columns, bodies / first);
    all.insert(all.end(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
    return first;
}

// The pointer of an error in a list of one, as if it were in the scene's list.
template <class Read>
void at_index(const std::string& list, std::size_t index, Read&& read) {
    try {
        read();
    } catch (const SceneError& error) {
        const std::string inside = "/" + list + "/0";
        if (error.pointer.compare(0, inside.size(), inside) != 0) throw;
        const std::string what = error.what(), reason = what.substr(std::min(error.pointer.size() + 2, what.size()));
        throw SceneError("/" + list + "/" + std::to_string(index) + error.pointer.substr(inside.size()), reason);
    }
}

std::size_t add_joint(Description& scene, const std::string& text) {
    Scene& to = scene.document.scene;
    at_index("joints", to.joints.size(), [&] { read_joints(json::array({json_of(text)}), {}, to); });
    return to.joints.size() - 1;
}

NamedThings names_of(const Scene& scene) {
    return {numbers_of(scene.bodies), numbers_of(scene.joints)};
}

std::size_t add_vehicle(Description& scene, const std::string& text) {
    Scene& to = scene.document.scene;
    Vehicle vehicle;
    const Place vehicles = root / "vehicles";
    read_value(json_of(text), vehicles / to.vehicles.size(), vehicle, "", names_of(to));
    to.vehicles.push_back(std::move(vehicle));
    return to.vehicles.size() - 1;
}

void add_event(Description& scene, const std::string& text) {
    std::vector<TimedEvent>& events = scene.document.events;
    TimedEvent event;
    const Place list = root / "events";
    read_value(json_of(text), list / events.size(), event, "", names_of(scene.document.scene));
    events.push_back(event);
    try {
        check_events(events, scene.document.scene);
    } catch (const SceneError&) {
        events.pop_back();
        throw;
    }
}

// How the scene is run and shown, by the key of a scene file.
template <class Part>
void set_optional(Description& scene, std::optional<Part>& part, const char* key, const std::string& text) {
    const json value = json_of(text);
    if (value.is_null()) return part.reset();
    Part read = part.value_or(Part{});
    read_value(value, root / key, read, "", names_of(scene.document.scene));
    schema::check_fields(root / key, read);
    part = std::move(read);
}

void set_part(Description& scene, const std::string& key, const std::string& text) {
    SceneDocument& document = scene.document;
    if (key == "settings") return set_optional(scene, document.settings, "settings", text);
    if (key == "picture") return set_optional(scene, document.picture, "picture", text);
    if (key == "fields") {
        Fields fields_read = document.scene.fields;
        read_value(json_of(text), root / "fields", fields_read, "", {});
        check_world_fields(fields_read);
        document.scene.fields = std::move(fields_read);
        return;
    }
    if (key == "camera") return set_optional(scene, document.viewpoint, "camera", text);
    throw py::key_error(key);
}

template <class Preset>
void place_preset(Preset& preset, const py::dict& given) {
    for (const auto& [key, value] : given) {
        const std::string name = py::str(key);
        if (name == "name")
            preset.name = value.template cast<std::string>();
        else if (name == "position")
            preset.position = vec3_at(value.template cast<Floats>().data(), 0);
        else if (name == "heading")
            preset.heading = value.template cast<float>();
        else if (name == "friction")
            preset.friction = value.template cast<float>();
        else if (name == "brake")
            preset.brake = value.template cast<float>();
        else if constexpr (requires { preset.speed; }) {
            if (name == "speed")
                preset.speed = value.template cast<float>();
            else if (name == "size")
                preset.size = value.template cast<float>();
            else if (name == "density")
                preset.density = value.template cast<float>();
            else if (name == "hertz")
                preset.hertz = value.template cast<float>();
            else if (name == "damping_ratio")
                preset.damping_ratio = value.template cast<float>();
            else
                throw py::type_error("a car has no \"" + name + "\"");
        } else {
            throw py::type_error("a cart has no \"" + name + "\"");
        }
    }
}

Description demo_named(const std::string& name, std::size_t bodies, std::uint64_t seed) {
    if (!demos::find_demo(name)) throw py::key_error(name);
    demos::SceneOptions options;
    options.name = name;
    options.bodies = bodies;
    options.seed = seed;
    const demos::LoadedScene subject = demos::load_subject(options);
    Description made{demos::document_of(subject), {}};
    if (subject.before_step) made.notes.push_back(name + ": its scripted actions during a run are no part of the scene");
    return made;
}

// The keys of each struct that JSON describes, for messages and tests.
std::vector<std::string> keys_named(const std::string& name) {
    if (name == "body") return keys_of<Body>();
    if (name == "joint") return keys_of<Joint>();
    if (name == "settings") return keys_of<Settings>();
    if (name == "vehicle") return keys_of<Vehicle>();
    if (name == "filter") return keys_of<Filter>();
    if (name == "material") return keys_of<Material>();
    if (name == "fields") return keys_of<Fields>();
    if (name == "fracture") return keys_of<Fracture>();
    if (name == "tyre") return keys_of<Tyre>();
    if (name == "controls") return keys_of<Controls>();
    if (name == "picture") return keys_of<PictureStyle>();
    if (name == "camera") return keys_of<Viewpoint>();
    throw py::key_error(name);
}

void bind_description(py::module_& module) {
    py::class_<Description>(module, "Description", plain_class())
        .def(py::init<>())
        .def(py::init<const Description&>())
        .def("add_bodies", &add_bodies)
        .def("add_joint", &add_joint)
        .def("add_vehicle", &add_vehicle)
        .def("add_event", &add_event)
        .def("add_exclusion",
             [](Description& scene, std::size_t a, std::size_t b) {
                 scene.document.scene.exclusions.push_back({a, b});
             })
        .def("add_car",
             [](Description& scene, const py::dict& given) {
                 Car car;
                 place_preset(car, given);
                 return add_car(scene.document.scene, car);
             })
        .def("add_cart",
             [](Description& scene, const py::dict& given) {
                 Cart cart;
                 place_preset(cart, given);
                 return add_cart(scene.document.scene, cart);
             })
        .def("set_part", &set_part)
        .def("indices_of",
             [](const Description& scene, const std::string& list, const std::string& name) {
                 const Scene& in = scene.document.scene;
                 const auto of = [&](const auto& things) { return first_named(things, things.size(), name); };
                 return list == "bodies" ? of(in.bodies) : list == "joints" ? of(in.joints) : of(in.vehicles);
             })
        .def("count",
             [](const Description& scene, const std::string& list) {
                 const Scene& in = scene.document.scene;
                 return list == "bodies"     ? in.bodies.size()
                        : list == "joints"   ? in.joints.size()
                        : list == "vehicles" ? in.vehicles.size()
                                             : scene.document.events.size();
             })
        .def("names",
             [](const Description& scene, const std::string& list) {
                 const Scene& in = scene.document.scene;
                 const auto of = [](const auto& things) { return all_names(things, things.size()); };
                 return list == "bodies" ? of(in.bodies) : list == "joints" ? of(in.joints) : of(in.vehicles);
             })
        .def("body_name", [](const Description& scene, std::size_t i) { return scene.document.scene.bodies.at(i).name; })
        .def("vehicle_bodies",
             [](const Description& scene, std::size_t i) {
                 const Vehicle& vehicle = scene.document.scene.vehicles.at(i);
                 std::vector<std::size_t> bodies{vehicle.chassis};
                 for (const Wheel& wheel : vehicle.wheels) bodies.push_back(scene.document.scene.joints.at(wheel.joint).b);
                 return bodies;
             })
        .def("settings", [](const Description& scene) { return settings_dict(scene.document.settings.value_or(Settings{})); })
        .def("camera",
             [](const Description& scene) {
                 Scene empty;
                 return scene_to_json(empty, scene.document.viewpoint);
             })
        .def("to_json", [](const Description& scene) { return scene_to_json(scene.document); })
        .def("whole_json",  // with the meshes of files, wherever it is read
             [](const Description& scene) {
                 SceneDocument whole = scene.document;
                 for (Body& body : whole.scene.bodies)
                     if (auto* mesh = std::get_if<Mesh>(&body.shape); mesh && !mesh->vertices.empty()) {
                         mesh->file.clear();
                         mesh->scale = 1;
                     }
                 return scene_to_json(whole);
             })
        .def("save", [](const Description& scene,
                        const std::string& path) { host::write_atomically(path, scene_to_json(scene.document)); })
        .def("scene_hash", [](const Description& scene) { return hash_text(hash_of(checked(scene.document.scene))); })
        .def("check",
             [](const Description& scene) {
                 std::vector<std::string> notes;
                 checked(scene.document.scene, &notes);
                 return notes;
             })
        .def_property(
            "gravity",
            [](const Description& scene) {
                const vec3 g = scene.document.scene.gravity;
                return py::make_tuple(g.x, g.y, g.z);
            },
            [](Description& scene, const Floats& gravity) {
                if (gravity.size() != 3) throw py::value_error("gravity: is three numbers, m/s^2");
                scene.document.scene.gravity = vec3_at(gravity.data(), 0);
            })
        .def_property(
            "duration", [](const Description& scene) { return scene.document.duration; },
            [](Description& scene, float seconds) {
                if (!(seconds >= 0 && seconds <= 1e6f)) throw py::value_error("duration: must be between 0 and 1000000 s");
                scene.document.duration = seconds;
            })
        .def_readonly("notes", &Description::notes);
}

Description loaded(const std::string& path, bool strict, const std::string& axes, const std::string& base, bool ground,
                   const std::string& keyframe, const std::map<std::string, std::string>& packages, bool allow_outside) {
    if (axes != "y-up" && axes != "file") throw py::value_error("axes: is \"" + axes + "\"; known: y-up, file");
    if (!base.empty() && base != "fixed" && base != "free")
        throw py::value_error("base: is \"" + base + "\"; known: fixed, free");
    ImportOptions options;
    options.strict = strict;
    options.axes = axes == "file" ? ImportedAxes::file : ImportedAxes::y_up;
    options.base = base.empty() ? ImportedBase::usual : base == "free" ? ImportedBase::free : ImportedBase::fixed;
    options.ground = ground;
    options.keyframe = keyframe;
    options.packages = packages;
    options.allow_outside = allow_outside;
    Description made;
    try {
        made.document = load_scene(path, options, &made.notes);
    } catch (const ImportError& error) {
        throw SceneError("", error.what());  // it names the file itself
    }
    if (is_scene_import(path)) return made;
    checked(made.document.scene, &made.notes);
    if (strict && !made.notes.empty()) throw SceneError("", made.notes.front());
    return made;
}

}  // namespace

void bind_scenes(py::module_& module) {
    bind_description(module);
    module.def("is_import", [](const std::string& path) { return is_scene_import(path); });
    module.def("load", &loaded, py::arg("path"), py::arg("strict"), py::arg("axes"), py::arg("base"), py::arg("ground"),
               py::arg("keyframe"), py::arg("packages"), py::arg("allow_outside"));
    module.def("from_json", [](const std::string& text) {
        Description made{scene_from_json(text), {}};
        return made;
    });
    module.def("demo", &demo_named);
    module.def("demo_names", [] {
        std::vector<std::pair<std::string, std::string>> names;
        for (const demos::Demo& demo : demos::all_demos())
            if (!demo.trial) names.emplace_back(demo.name, demo.line);
        return names;
    });
    module.def("keys", &keys_named);
    module.def("schema", &scene_schema);
    module.def("default_settings", [] { return settings_dict(Settings{}); });
    module.def("mass_properties", [](const std::string& text, float density) {
        const Body body = body_of(json_of(text), root);
        const Scene scene = checked(Scene{vec3(0), {body}, {}});
        const MassProperties mass = mass_properties(scene.bodies.front().shape, density);
        return py::make_tuple(mass.mass, py::make_tuple(mass.inertia.x, mass.inertia.y, mass.inertia.z));
    });
}

}  // namespace scree::python
