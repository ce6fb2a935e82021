// The C interface: scenes, described by JSON as in scene files and by columns in bulk.
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compute/scene/error_reason.h"
#include "compute/scene_file/import/import_scene.h"
#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/load_scene.h"
#include "compute/scene_file/scene_schema.h"
#include "compute/vehicle_presets.h"
#include "compute/version.h"
#include "demos/c/json.h"
#include "demos/c/objects.h"
#include "demos/program/exit_status.h"
#include "demos/scenes/demos.h"
#include "host/files/file.h"
#include "host/files/mesh_file.h"
#include "host/system/machine.h"

namespace scree::c {

using namespace json_reading;

namespace {

// ---- What is known

using KeysOf = const Names& (*)();
const std::vector<std::pair<std::string, KeysOf>>& described() {
    static const std::vector<std::pair<std::string, KeysOf>> all{{"body", &keys_of<Body>},
                                                                 {"joint", &keys_of<Joint>},
                                                                 {"settings", &keys_of<Settings>},
                                                                 {"vehicle", &keys_of<Vehicle>},
                                                                 {"filter", &keys_of<Filter>},
                                                                 {"material", &keys_of<Material>},
                                                                 {"fields", &keys_of<Fields>},
                                                                 {"fracture", &keys_of<Fracture>},
                                                                 {"tyre", &keys_of<Tyre>},
                                                                 {"controls", &keys_of<Controls>},
                                                                 {"picture", &keys_of<PictureStyle>},
                                                                 {"camera", &keys_of<Viewpoint>},
                                                                 {"grains", &keys_of<FileGrains>},
                                                                 {"bonds", &keys_of<Bonding>},
                                                                 {"servo_walls", &keys_of<ServoWall>},
                                                                 {"periodic", &keys_of<PeriodicCell>}};
    return all;
}

// The entry of a word in a list of pairs; throws Failure naming the nearest.
template <class Pairs>
const auto& named(const Pairs& pairs, const char* what, const std::string& word) {
    Names words;
    for (const auto& [name, value] : pairs) {
        if (name == word) return value;
        words.emplace_back(name);
    }
    refuse(unknown(what, word, words));
}

std::string demos_json() {
    Text text;
    const char* between = "[";
    for (const demos::Demo& demo : demos::all_demos()) {
        if (demo.trial) continue;
        text << between << json_of_words({demo.name, demo.line});
        between = ", ";
    }
    text << "]";
    return text.take();
}

// ---- Adding

void read_mesh_file(Body& body, const Place& place) {
    auto* mesh = std::get_if<Mesh>(&body.shape);
    if (!mesh || mesh->file.empty() || !mesh->vertices.empty()) return;
    try {
        host::MeshFile read = host::read_mesh(mesh->file);
        mesh->vertices = std::move(read.vertices);
        mesh->triangles = std::move(read.triangles);
        for (vec3& vertex : mesh->vertices) vertex *= mesh->scale;
        if (!body.color) mesh->surface = std::move(read.surface);
    } catch (const host::FileError& error) {
        json_reading::refuse(place / "shape" / "mesh" / "file", error.what());
    }
}

void read_grain_file(GrainShape& shape, std::size_t index) {
    auto* mesh = std::get_if<MeshGrain>(&shape.form);
    if (!mesh || mesh->file.empty()) return;
    try {
        mesh->points = host::read_mesh(mesh->file).vertices;
        mesh->file.clear();
    } catch (const host::FileError& error) {
        const Place grains = root / "grains", list = grains / std::size_t{0}, shapes = list / "shapes", one = shapes / index;
        const Place form = one / "form", of_mesh = form / "mesh";
        json_reading::refuse(of_mesh / "file", error.what());
    }
}

template <class Member>
constexpr int width_of = std::is_same_v<Member, float>  ? 1
                         : std::is_same_v<Member, vec3> ? 3
                         : std::is_same_v<Member, vec4> ? 4
                                                        : 0;

const std::vector<Columns::Known>& body_columns() {
    static const std::vector<Columns::Known> known = [] {
        std::vector<Columns::Known> made;
        schema::for_each_field<Body>([&]<class Member>(const schema::Field<Body, Member>& field) {
            if constexpr (width_of < Member >> 0) made.push_back({field.key, width_of<Member>});
        });
        return made;
    }();
    return known;
}

void set_columns(std::span<Body> bodies, const Columns& columns) {
    schema::for_each_field<Body>([&]<class Member>(const schema::Field<Body, Member>& field) {
        if constexpr (width_of < Member >> 0) {
            if (const Rows rows = columns[field.key])
                for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].*field.member = rows.at<Member>(i);
        }
    });
}

NamedThings names_of(const Scene& scene) {
    return {numbers_of(scene.bodies), numbers_of(scene.joints)};
}

// Reads one into a list, of which it is the next, so that errors have its place.
template <class Thing>
Thing next_of(const std::vector<Thing>& list, const char* key, const json& value, const Scene& scene) {
    Thing made;
    const Place place = root / key;
    read_value(value, place / list.size(), made, "", names_of(scene));
    return made;
}

// read_joints() reads a list: the place of an error in a list of one becomes that in the scene's.
std::size_t add_joint(Scene& scene, const json& value) {
    const std::size_t index = scene.joints.size();
    try {
        NamedThings named;
        read_joints(json::array({value}), named, scene);
    } catch (const SceneError& error) {
        const std::string inside = "/joints/0";
        if (error.pointer.compare(0, inside.size(), inside) != 0) throw;
        throw SceneError("/joints/" + std::to_string(index) + error.pointer.substr(inside.size()), reason_of(error));
    }
    return index;
}

std::size_t add_event(SceneDocument& document, const json& value) {
    document.events.push_back(next_of(document.events, "events", value, document.scene));
    try {
        check_events(document.events, document.scene);
    } catch (const SceneError&) {
        document.events.pop_back();
        throw;
    }
    return document.events.size() - 1;
}

// Gives the index of the first body, or of the event that pours them.
std::size_t add_grains_of(SceneDocument& document, const json& value, std::vector<std::string>& notes) {
    FileGrains made = next_of(document.grains, "grains", value, document.scene);
    for (std::size_t i = 0; i < made.grains.shapes.size(); ++i) read_grain_file(made.grains.shapes[i], i);
    const std::size_t first = made.grains.poured() ? document.events.size() : document.scene.bodies.size();
    document.grains = {std::move(made)};
    try {
        constexpr double bytes_of_body = 7000;  // scene and tables
        add_grains(document, &notes, static_cast<std::size_t>(std::min(host::available_memory() / bytes_of_body, 4.0e9)));
    } catch (const SceneError&) {
        document.grains.clear();
        throw;
    }
    return first;
}

std::size_t add_exclusion(Scene& scene, const json& value) {
    const Place list = root / "exclusions", place = list / scene.exclusions.size();
    if (!value.is_array() || value.size() != 2) json_reading::refuse(place, "must be two bodies, is " + kind(value));
    const NamedThings names = names_of(scene);
    const auto body = [&](std::size_t k) {
        return json_reading::index_of(value[k], place / k, schema::Refers::to_body, false, names);
    };
    scene.exclusions.push_back({body(0), body(1)});
    return scene.exclusions.size() - 1;
}

// A member of a preset, if the object has it.
template <class Value>
void take(const json& object, const Place& place, const char* key, Value& out) {
    optional(object, place, key, out);
}
void take_positive(const json& object, const Place& place, const char* key, float& out) {
    take(object, place, key, out);
    if (!(out > 0 && out <= 1000)) json_reading::refuse(place / key, "must be above 0 and at most 1000");
}

std::size_t add_car_of(Scene& scene, const json& value) {
    const Place list = root / "cars", place = list / scene.vehicles.size();
    only(value, place,
         {"name", "position", "heading", "friction", "brake", "speed", "size", "density", "hertz", "damping_ratio"});
    Car car;
    take(value, place, "name", car.name);
    take(value, place, "position", car.position);
    take(value, place, "heading", car.heading);
    take(value, place, "friction", car.friction);
    take(value, place, "brake", car.brake);
    take(value, place, "speed", car.speed);
    take_positive(value, place, "size", car.size);
    take_positive(value, place, "density", car.density);
    take_positive(value, place, "hertz", car.hertz);
    take(value, place, "damping_ratio", car.damping_ratio);
    return add_car(scene, car);
}

std::size_t add_cart_of(Scene& scene, const json& value) {
    const Place list = root / "carts", place = list / scene.vehicles.size();
    only(value, place, {"name", "position", "heading", "friction", "brake"});
    Cart cart;
    take(value, place, "name", cart.name);
    take(value, place, "position", cart.position);
    take(value, place, "heading", cart.heading);
    take(value, place, "friction", cart.friction);
    take(value, place, "brake", cart.brake);
    return add_cart(scene, cart);
}

using Add = std::size_t (*)(SceneObject&, const json&);
const std::vector<std::pair<std::string, Add>>& additions() {
    static const std::vector<std::pair<std::string, Add>> all{
        {"joints", [](SceneObject& to, const json& value) { return add_joint(to.document.scene, value); }},
        {"vehicles",
         [](SceneObject& to, const json& value) {
             Scene& scene = to.document.scene;
             scene.vehicles.push_back(next_of(scene.vehicles, "vehicles", value, scene));
             return scene.vehicles.size() - 1;
         }},
        {"events", [](SceneObject& to, const json& value) { return add_event(to.document, value); }},
        {"grains", [](SceneObject& to, const json& value) { return add_grains_of(to.document, value, to.notes); }},
        {"bonds",
         [](SceneObject& to, const json& value) {
             const std::size_t first = to.document.scene.bonds.size();
             add_bonds(to.document.scene, next_of(to.document.bonds, "bonds", value, to.document.scene));
             return first;
         }},
        {"servo_walls",
         [](SceneObject& to, const json& value) {
             Scene& scene = to.document.scene;
             return add_servo_wall(scene, next_of(to.document.servo_walls, "servo_walls", value, scene));
         }},
        {"exclusions", [](SceneObject& to, const json& value) { return add_exclusion(to.document.scene, value); }},
        {"cars", [](SceneObject& to, const json& value) { return add_car_of(to.document.scene, value); }},
        {"carts", [](SceneObject& to, const json& value) { return add_cart_of(to.document.scene, value); }}};
    return all;
}

// ---- How it is run and shown

template <class Part>
void set_optional(SceneDocument& document, std::optional<Part>& part, const char* key, const json& value) {
    if (value.is_null()) return part.reset();
    Part made = part.value_or(Part{});
    read_value(value, root / key, made, "", names_of(document.scene));
    schema::check_fields(root / key, made);
    part = std::move(made);
}

using Set = void (*)(SceneDocument&, const json&);
const std::vector<std::pair<std::string, Set>>& parts() {
    static const std::vector<std::pair<std::string, Set>> all{
        {"settings", [](SceneDocument& of, const json& value) { set_optional(of, of.settings, "settings", value); }},
        {"picture", [](SceneDocument& of, const json& value) { set_optional(of, of.picture, "picture", value); }},
        {"camera", [](SceneDocument& of, const json& value) { set_optional(of, of.viewpoint, "camera", value); }},
        {"fields",
         [](SceneDocument& of, const json& value) {
             Fields made = of.scene.fields;
             read_value(value, root / "fields", made, "", {});
             check_world_fields(made);
             of.scene.fields = std::move(made);
         }},
        {"periodic",
         [](SceneDocument& of, const json& value) {
             PeriodicCell made;
             read_value(value, root / "periodic", made, "", {});
             schema::check_fields(root / "periodic", made);
             of.scene.periodic = made;
         }},
        {"gravity",
         [](SceneDocument& of, const json& value) {
             vec3 gravity;
             read(value, root / "gravity", gravity);
             of.scene.gravity = gravity;
         }},
        {"duration", [](SceneDocument& of, const json& value) {
             float seconds = 0;
             read(value, root / "duration", seconds);
             if (!(seconds >= 0 && seconds <= 1e6f)) json_reading::refuse(root / "duration", "must be between 0 and 1000000 s");
             of.duration = seconds;
         }}};
    return all;
}

template <class Value>
std::string value_json(const Value& value) {
    Text text;
    write_value(text, value);
    return text.take();
}
template <class Value>
std::string value_json(const std::optional<Value>& value) {
    return value ? value_json(*value) : "null";
}

// With the meshes of files in it, wherever it is read.
std::string portable_json(SceneDocument whole) {
    for (Body& body : whole.scene.bodies)
        if (auto* mesh = std::get_if<Mesh>(&body.shape); mesh && !mesh->vertices.empty()) {
            mesh->file.clear();
            mesh->scale = 1;
        }
    return scene_to_json(whole);
}

using Get = std::string (*)(const SceneObject&);
const std::vector<std::pair<std::string, Get>>& questions() {
    static const std::vector<std::pair<std::string, Get>> all{
        {"settings", [](const SceneObject& of) { return whole_json(of.document.settings.value_or(Settings{})); }},
        {"picture", [](const SceneObject& of) { return value_json(of.document.picture); }},
        {"camera", [](const SceneObject& of) { return value_json(of.document.viewpoint); }},
        {"fields", [](const SceneObject& of) { return value_json(of.document.scene.fields); }},
        {"gravity", [](const SceneObject& of) { return value_json(of.document.scene.gravity); }},
        {"periodic", [](const SceneObject& of) { return value_json(of.document.scene.periodic); }},
        {"duration", [](const SceneObject& of) { return value_json(of.document.duration); }},
        {"notes", [](const SceneObject& of) { return json_of_words(of.notes); }},
        {"bodies", [](const SceneObject& of) { return names_json(of.document.scene.bodies, of.document.scene.bodies.size()); }},
        {"joints", [](const SceneObject& of) { return names_json(of.document.scene.joints, of.document.scene.joints.size()); }},
        {"vehicles",
         [](const SceneObject& of) { return names_json(of.document.scene.vehicles, of.document.scene.vehicles.size()); }},
        {"scene", [](const SceneObject& of) { return scene_to_json(of.document); }},
        {"whole", [](const SceneObject& of) { return portable_json(of.document); }}};
    return all;
}

// ---- Making

std::shared_ptr<SceneObject> made_scene(SceneDocument document, std::vector<std::string> notes = {}) {
    auto object = std::make_shared<SceneObject>();
    object->document = std::move(document);
    object->notes = std::move(notes);
    return object;
}

std::shared_ptr<SceneObject> loaded(const std::string& path, const scree_load_options& given) {
    ImportOptions options;
    options.strict = given.strict != 0;
    options.axes = given.file_axes != 0 ? ImportedAxes::file : ImportedAxes::y_up;
    const std::string base = text_or_none(given.base, "base");
    if (!base.empty() && base != "fixed" && base != "free") refuse("base: is \"" + base + "\"; known: fixed, free");
    options.base = base.empty() ? ImportedBase::usual : base == "free" ? ImportedBase::free : ImportedBase::fixed;
    options.ground = given.ground != 0;
    options.keyframe = text_or_none(given.keyframe, "keyframe");
    options.allow_outside = given.allow_outside != 0;
    if (given.packages_json != nullptr) {
        const json packages = json_given(given.packages_json, "packages_json");
        if (!packages.is_object()) refuse("packages_json: must be an object of folders, is " + kind(packages));
        for (const auto& [name, folder] : packages.items()) {
            if (!folder.is_string()) refuse("packages_json: the folder of \"" + name + "\" is " + kind(folder));
            options.packages[name] = folder.get<std::string>();
        }
    }
    std::vector<std::string> notes;
    try {
        SceneDocument document = load_scene(path, options, &notes);
        if (!is_scene_import(path)) {
            checked(document.scene, &notes);
            if (options.strict && !notes.empty()) throw SceneError("", notes.front());
        }
        return made_scene(std::move(document), std::move(notes));
    } catch (const SceneError& error) {  // imports name their file themselves
        throw Failure(SCREE_BAD_SCENE, path + ": " + error.what(), error.pointer);
    }
}

std::shared_ptr<SceneObject> demo_scene(const std::string& name, std::size_t bodies, std::uint64_t seed) {
    const demos::LoadedScene subject = demo_given(name, bodies, seed);
    std::vector<std::string> notes;
    if (subject.before_step) notes.push_back(name + ": its scripted actions during a run are no part of the scene");
    return made_scene(demos::document_of(subject), std::move(notes));
}

}  // namespace

demos::LoadedScene demo_given(const std::string& name, std::size_t bodies, std::uint64_t seed) {
    demos::SceneOptions options;
    options.name = name;
    options.bodies = bodies;
    options.seed = seed;
    if (!demos::find_demo(name)) {
        Names known;
        for (const demos::Demo& demo : demos::all_demos())
            if (!demo.trial) known.push_back(demo.name);
        refuse(unknown("demo", name, known));
    }
    try {
        return demos::load_subject(options);
    } catch (const demos::UsageError& error) {  // of the command line: "--bodies: the demo has"
        const std::string what = error.what();
        refuse(what.substr(what.starts_with("--") ? 2 : 0));
    }
}

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

const char* scree_version(void) {
    static const std::string version = library_version();
    return version.c_str();
}

int scree_has_vulkan(void) {
#ifdef SCREE_WITH_VULKAN
    return 1;
#else
    return 0;
#endif
}

scree_result scree_describe(const char* what, const char* name, const char** text) {
    return called([&] {
        const std::string asked = text_of(what, "what");
        given(text, "json");
        if (asked == "schema")
            *text = kept_text(scene_schema());
        else if (asked == "settings")
            *text = kept_text(whole_json(Settings{}));
        else if (asked == "demos")
            *text = kept_text(demos_json());
        else if (asked == "keys")
            *text = kept_text(json_of_words(named(described(), "name", text_of(name, "name"))()));
        else
            refuse(unknown("what", asked, {"schema", "settings", "demos", "keys"}));
    });
}

scree_result scree_scene_create(scree_scene** scene) {
    return called([&] { given(scene, "scene") = handle_of(std::make_shared<SceneObject>()); });
}

scree_result scree_scene_copy(const scree_scene* scene, scree_scene** copy) {
    return called([&] {
        given(copy, "copy");
        const ReadScene from(scene);
        *copy = handle_of(made_scene(from->document, from->notes));
    });
}

void scree_scene_release(scree_scene* scene) {
    ended(HandleKind::scene, scene);
}

scree_result scree_scene_from_json(const char* text, scree_scene** scene) {
    return called([&] {
        given(scene, "scene");
        *scene = handle_of(made_scene(scene_from_json(text_of(text, "json"))));
    });
}

scree_result scree_scene_load(const char* path, const scree_load_options* options, scree_scene** scene) {
    return called([&] {
        given(scene, "scene");
        *scene = handle_of(loaded(text_of(path, "path"), options_of(options)));
    });
}

scree_result scree_is_import(const char* path, int* is_import) {
    return called([&] { given(is_import, "is_import") = is_scene_import(text_of(path, "path")) ? 1 : 0; });
}

scree_result scree_scene_demo(const char* name, size_t bodies, uint64_t seed, scree_scene** scene) {
    return called([&] {
        given(scene, "scene");
        *scene = handle_of(demo_scene(text_of(name, "name"), bodies, seed));
    });
}

scree_result scree_scene_add_bodies(scree_scene* scene, const char* body_json, size_t count, const scree_column* columns,
                                    size_t column_count, size_t* first) {
    return called([&] {
        const UsedScene to(scene);
        std::vector<Body>& all = to->document.scene.bodies;
        const Place bodies = root / "bodies", place = bodies / all.size();
        Body body = body_of(json_given(body_json, "body_json"), place);
        read_mesh_file(body, place);
        const Columns rows(columns, column_count, count, body_columns());
        const std::size_t before = all.size();
        if (count > all.max_size() - before) throw Failure(SCREE_NO_MEMORY, std::to_string(count) + " bodies are too many");
        try {
            all.resize(before + count, body);
            set_columns(std::span(all).subspan(before), rows);
        } catch (...) {
            all.resize(std::min(all.size(), before));
            throw;
        }
        if (first != nullptr) *first = before;
    });
}

scree_result scree_scene_add(scree_scene* scene, const char* list, const char* text, size_t* index) {
    return called([&] {
        const UsedScene to(scene);
        const Add add = named(additions(), "list", text_of(list, "list"));
        const std::size_t made = add(*to, json_given(text, "json"));
        if (index != nullptr) *index = made;
    });
}

scree_result scree_scene_set(scree_scene* scene, const char* key, const char* text) {
    return called([&] {
        const UsedScene to(scene);
        const Set set = named(parts(), "key", text_of(key, "key"));
        set(to->document, json_given(text, "json"));
    });
}

scree_result scree_scene_get(const scree_scene* scene, const char* key, const char** text) {
    return called([&] {
        given(text, "json");
        const ReadScene from(scene);
        *text = kept_text(named(questions(), "key", text_of(key, "key"))(*from));
    });
}

namespace {

using Counts = std::vector<std::pair<std::string, std::size_t>>;

Counts counts_of(const SceneDocument& of) {
    return {{"bodies", of.scene.bodies.size()},
            {"joints", of.scene.joints.size()},
            {"vehicles", of.scene.vehicles.size()},
            {"events", of.events.size()}};
}

}  // namespace

scree_result scree_scene_count(const scree_scene* scene, const char* list, size_t* count) {
    return called([&] {
        given(count, "count");
        const ReadScene from(scene);
        const Counts counts = counts_of(from->document);
        *count = named(counts, "list", text_of(list, "list"));
    });
}

scree_result scree_scene_find(const scree_scene* scene, const char* list, const char* name, scree_array* indices) {
    return called([&] {
        given(indices, "indices");
        const ReadScene from(scene);
        const std::string in = text_of(list, "list"), wanted = text_of(name, "name");
        const Scene& of = from->document.scene;
        if (in == "bodies")
            *indices = kept_array(first_named(of.bodies, of.bodies.size(), wanted));
        else if (in == "joints")
            *indices = kept_array(first_named(of.joints, of.joints.size(), wanted));
        else if (in == "vehicles")
            *indices = kept_array(first_named(of.vehicles, of.vehicles.size(), wanted));
        else
            refuse(unknown("list", in, {"bodies", "joints", "vehicles"}));
    });
}

scree_result scree_scene_body_name(const scree_scene* scene, size_t body, const char** name) {
    return called([&] {
        given(name, "name");
        const ReadScene from(scene);
        const std::vector<Body>& bodies = from->document.scene.bodies;
        *name = kept_text(bodies[c::index_of(body, bodies.size(), "body")].name);
    });
}

scree_result scree_scene_vehicle_bodies(const scree_scene* scene, size_t vehicle, scree_array* bodies) {
    return called([&] {
        given(bodies, "bodies");
        const ReadScene from(scene);
        const Scene& of = from->document.scene;
        const Vehicle& one = of.vehicles[c::index_of(vehicle, of.vehicles.size(), "vehicle")];
        std::vector<std::uint64_t> made{one.chassis};
        for (const Wheel& wheel : one.wheels) made.push_back(of.joints[c::index_of(wheel.joint, of.joints.size(), "joint")].b);
        *bodies = kept_array(std::move(made));
    });
}

scree_result scree_scene_check(const scree_scene* scene, const char** notes_json) {
    return called([&] {
        const ReadScene from(scene);
        std::vector<std::string> notes;
        checked(from->document.scene, &notes);
        if (notes_json != nullptr) *notes_json = kept_text(json_of_words(notes));
    });
}

scree_result scree_scene_hash(const scree_scene* scene, uint64_t* hash) {
    return called([&] {
        given(hash, "hash");
        const ReadScene from(scene);
        *hash = hash_of(checked(from->document.scene));
    });
}

scree_result scree_scene_save(const scree_scene* scene, const char* path) {
    return called([&] {
        const ReadScene from(scene);
        host::write_atomically(text_of(path, "path"), scene_to_json(from->document));
    });
}

scree_result scree_mass_properties(const char* body_json, float density, float* mass, float inertia[3]) {
    return called([&] {
        given(mass, "mass");
        given(inertia, "inertia");
        if (!(density > 0 && density <= 1e12f)) refuse("density: must be above 0 and at most 1e12 kg/m^3");
        const Body body = body_of(json_given(body_json, "body_json"), root);
        const Scene scene = checked(Scene{vec3(0), {body}, {}});
        const MassProperties made = mass_properties(scene.bodies.front().shape, density);
        *mass = made.mass;
        for (int k = 0; k < 3; ++k) inertia[k] = made.inertia[k];
    });
}
