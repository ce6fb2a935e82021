// Loading the scene to simulate, and checks against free memory.
#include "demos/program/loaded_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>

#include "compute/scene/meshes/decomposed.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/load_scene.h"
#include "compute/schema/settings.h"
#include "demos/film/camera.h"
#include "demos/program/backend.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/scene_edits.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"
#include "host/files/file.h"
#include "host/system/machine.h"

namespace scree::demos {

namespace {

// Memory per body during a run: scene, tables on host and device, contacts. With a smaller estimate runs would end
// out of memory.
constexpr double bytes_per_body = 7000;

std::size_t most_bodies() {
    // Body ids have 32 bits, and the highest ones are reserved.
    return static_cast<std::size_t>(std::min(host::available_memory() / bytes_per_body, 4.0e9));
}

bool is_file_name(const std::string& name) {
    return std::filesystem::path(name).has_parent_path() || name.ends_with(".json") || is_scene_import(name);
}

struct BoundingSphere {
    vec3 position;
    float radius;
};

// Of the initial bodies: of moving ones if there are any, else of all but planes.
std::vector<BoundingSphere> spheres_of(const Scene& scene) {
    std::vector<BoundingSphere> spheres;
    for (const bool moving : {true, false}) {
        for (const Body& body : scene.bodies) {
            if (std::holds_alternative<Plane>(body.shape) || (moving && body.motion != Motion::dynamic)) continue;
            spheres.push_back({body.position, bounding_radius(body.shape)});
        }
        if (!spheres.empty()) break;
    }
    return spheres;
}

// Removes outliers, so that a few bodies far away do not make the rest tiny: at most a tenth, further than 6 times the diagonal
// of the middle half (on each axis the quartiles, with the median radius).
void remove_outliers(std::vector<BoundingSphere>& spheres) {
    if (spheres.size() < 10) return;
    std::vector<float> values(spheres.size());
    const auto quantile = [&](double share, auto&& value_of) {
        std::ranges::transform(spheres, values.begin(), value_of);
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::ranges::nth_element(values, place);
        return *place;
    };
    const float radius = quantile(0.5, [](const BoundingSphere& sphere) { return sphere.radius; });
    vec3 low(0), high(0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto place = [axis](const BoundingSphere& sphere) { return sphere.position[axis]; };
        low[axis] = quantile(0.25, place) - radius;
        high[axis] = quantile(0.75, place) + radius;
    }
    const vec3 middle = 0.5f * (low + high);
    const float furthest = 6 * glm::length(high - low);
    const auto is_far = [&](const BoundingSphere& sphere) { return glm::length(sphere.position - middle) > furthest; };
    if (10 * std::ranges::count_if(spheres, is_far) <= std::ssize(spheres)) std::erase_if(spheres, is_far);
}

// Sets the box that cameras see whole.
void set_bounds(LoadedScene& subject) {
    std::vector<BoundingSphere> spheres = spheres_of(subject.scene);
    remove_outliers(spheres);
    if (spheres.empty()) spheres.push_back({vec3(0), 1});
    subject.low = subject.high = spheres.front().position;
    for (const BoundingSphere& sphere : spheres) {
        subject.low = glm::min(subject.low, sphere.position - sphere.radius);
        subject.high = glm::max(subject.high, sphere.position + sphere.radius);
    }
    for (const TimedEvent& event : subject.events) {
        const auto* pour = std::get_if<PourEvent>(&event.action);
        if (!pour) continue;
        const GrainBox box = box_about(pour->grains.region);
        subject.low = glm::min(subject.low, box.low);
        subject.high = glm::max(subject.high, box.high);
    }
}

bool are_default(const Settings& settings) {
    bool all = true;
    schema::for_each_field<Settings>([&](const auto& field) { all = all && settings.*field.member == Settings{}.*field.member; });
    return all;
}

std::string free_memory() {
    return fmt::format("{:.1f} GB are free, enough for about {:.0f} thousand bodies", host::available_memory() / 1e9,
                       static_cast<double>(most_bodies()) / 1e3);
}

// Counts the pre-allocated fragments, too (compute/scene/fracture.h).
void require_memory_for_pieces(const Scene& scene, const std::string& what) {
    constexpr std::size_t deepest = 4;
    double pieces = 0;
    for (const Body& body : scene.bodies) {
        if (!body.fracture) continue;
        double of_level = 1;
        for (std::size_t level = 0; level < std::min(body.fracture->depth, deepest); ++level)
            pieces += of_level *= static_cast<double>(body.fracture->pieces);
    }
    const double rows = static_cast<double>(scene.bodies.size()) + pieces;
    if (pieces == 0 || rows <= static_cast<double>(most_bodies())) return;
    throw UsageError(
        fmt::format("{}: beyond memory: {} bodies and the {:.0f} pieces that they may break into need about {:.3g} "
                    "GB, {}, pieces included; ask for fewer",
                    what, scene.bodies.size(), pieces, rows * bytes_per_body / 1e9, free_memory()));
}

void require_import(const SceneOptions& options) {
    if (is_scene_import(options.name)) return;
    ImportOptions plain = options.imported;
    plain.strict = false;
    plain.allow_outside = false;
    if (!(plain == ImportOptions{}))
        throw UsageError("--axes, --base, --ground, --keyframe, --package: are for files of other programs; leave them out");
}

// With the user's changes; an import is changed as the scene that it has become.
SceneDocument document_of_file(const SceneOptions& options, std::vector<std::string>& notes) {
    const std::filesystem::path path = options.name;
    if (options.edits.empty()) return load_scene(path, options.imported, &notes, most_bodies());
    if (is_scene_import(path)) {
        const SceneDocument imported = load_scene(path, options.imported, &notes, most_bodies());
        return scene_from_json(edited(scene_to_json(imported), options.edits), most_bodies());
    }
    return scene_from_text(edited(host::read_text(path), options.edits), path.parent_path(), most_bodies(),
                           options.imported.allow_outside, &notes);
}

LoadedScene from_file(const SceneOptions& options) {
    const std::string& path = options.name;
    stop_decompositions_if(is_interrupted);
    tell_of_decompositions([](const std::string& what, double done) { say("scree: {}: {:.0f}%\n", what, 100 * done); });
    LoadedScene subject;
    try {
        std::vector<std::string> notes, of_scene;
        const bool translated = is_scene_import(path);
        SceneDocument document = document_of_file(options, notes);
        require_memory_for_pieces(document.scene, path);
        subject = subject_of(std::move(document), path, &of_scene);
        static std::set<std::string> told;  // a window loads its scene again
        for (const std::string& note : notes)
            if (told.insert(note).second) say("scree: note: {}\n", printable(note));
        if (translated) return subject;  // its notes tell of the shapes, too
        for (const std::string& note : of_scene) say("scree: note: {}: {}\n", path, note);
        if (options.imported.strict && !of_scene.empty()) throw UsageError(path + ": " + of_scene.front() + " (--strict)");
    } catch (const SceneError& error) {
        throw UsageError(path + ": " + error.what());
    }
    if (subject.events.empty()) return subject;
    subject.before_step = [path, events = subject.events](World& world) {
        try {
            perform_due(events, world);
        } catch (const SceneError& error) {
            throw UsageError(path + ": " + error.what());
        }
    };
    return subject;
}

// A demo keeps its script and its promise.
void edit(LoadedScene& subject, const std::vector<SceneEdit>& edits) {
    try {
        SceneDocument changed = scene_from_json(edited(scene_to_json(document_of(subject)), edits), most_bodies());
        subject.scene = checked(std::move(changed.scene));
        if (changed.settings) subject.of_scene = *changed.settings;
        if (changed.duration > 0) subject.seconds = static_cast<double>(changed.duration);
        subject.measures = std::move(changed.measures);
    } catch (const SceneError& error) {
        throw UsageError(subject.name + ", changed by --set: " + error.what());
    }
}

}  // namespace

void require_memory_for(std::size_t bodies) {
    if (bodies <= most_bodies()) return;
    throw UsageError(fmt::format("--bodies {}: beyond memory: they need about {:.3g} GB, {}; ask for fewer", bodies,
                                 static_cast<double>(bodies) * bytes_per_body / 1e9, free_memory()));
}

// A rank has its tables on the host, whatever device has them too; one of a software device has them there twice.
void limit_memory(World& world, const Backend& machine) {
    const bool on_host = world.runner().in_place();
    if (machine.options.memory != 0) return world.set_memory_limit(machine.options.memory);
    if (machine.has_own_memory() && !on_host) return;
    const double free = host::available_memory() / (on_host && machine.device && !machine.has_own_memory() ? 2 : 1);
    world.set_memory_limit(world.buffer_bytes() + static_cast<std::size_t>(free));
}

LoadedScene subject_of(SceneDocument document, std::string name, std::vector<std::string>* notes) {
    LoadedScene subject;
    subject.name = std::move(name);
    subject.scene = checked(std::move(document.scene), notes);
    subject.events = std::move(document.events);
    set_bounds(subject);
    subject.viewpoint = view_of(subject.low, subject.high, 30, 20);
    subject.viewpoint.fit = true;
    if (document.viewpoint) subject.viewpoint = *document.viewpoint;
    if (document.settings) subject.of_scene = *document.settings;
    if (document.duration > 0) subject.seconds = static_cast<double>(document.duration);
    const auto colored = [](const Body& body) { return body.color.has_value(); };
    if (document.picture)
        subject.style = *document.picture;
    else if (std::ranges::any_of(subject.scene.bodies, colored))
        subject.style.color = ShownQuantity::own;
    subject.measures = std::move(document.measures);
    return subject;
}

Settings LoadedScene::settings(const SceneOptions& options) const {
    return options.settings(of_scene);
}

std::string LoadedScene::title() const {
    return std::filesystem::path(name).filename().string();
}

SceneDocument document_of(const LoadedScene& subject) {
    SceneDocument document{subject.scene, subject.viewpoint, {}, 0, {}, subject.events, {}, subject.measures};
    if (!are_default(subject.of_scene)) document.settings = subject.of_scene;
    if (subject.seconds != LoadedScene{}.seconds) document.duration = static_cast<float>(subject.seconds);
    if (!(subject.style == PictureStyle{})) document.picture = subject.style;
    return document;
}

SceneDocument document_of(const LoadedScene& subject, const World& world, std::optional<std::size_t> copy) {
    SceneDocument document = document_of(subject);
    document.scene = copy ? world.snapshot_of(*copy) : world.snapshot();
    document.events = coming_events(subject.events, world);
    // Bodies that broke are numbered anew.
    if (document.measures && std::ranges::any_of(world.scene().bodies, [](const Body& body) { return body.piece_of != no_body; }))
        document.measures->bodies.clear();
    return document;
}

namespace {

const Demo& demo_named(const SceneOptions& options) {
    const Demo* demo = find_demo(options.name);
    if (!demo) {
        std::vector<std::string> names;
        for (const Demo& known : all_demos()) names.emplace_back(known.name);
        const std::string near = nearest(options.name, names);
        throw UsageError(
            fmt::format("unknown demo \"{}\"{}; `scree list` shows all, and a scene file ends in .json, .xml, .mjcf, .urdf, "
                        ".gltf, .glb, .usda, .usdc, .usdz, .stl or .obj",
                        options.name, near.empty() ? "" : ", nearest: \"" + near + "\""));
    }
    if (options.bodies && !demo->takes_bodies) {
        throw UsageError(
            fmt::format("--bodies: the demo {} has a fixed number of bodies; pile, mix and avalanche take any", demo->name));
    }
    return *demo;
}

LoadedScene subject_of(const Demo& demo, DemoScene built) {
    Settings settings;
    settings.sleeping = built.sleeping;
    LoadedScene subject{
        demo.name, std::move(built.scene),       built.viewpoint, built.low, built.high, built.seconds, std::move(built.promise),
        settings,  std::move(built.before_step), built.picture};
    subject.others = std::move(built.others);
    return subject;
}

bool is_scene_file(const SceneOptions& options) {
    return !find_demo(options.name) && is_file_name(options.name);
}

void require_no_bodies_of_file(const SceneOptions& options) {
    if (options.bodies) throw UsageError("--bodies: a scene file has its own bodies; leave the option out");
}

}  // namespace

LoadedScene load_subject(const SceneOptions& options) {
    require_import(options);
    if (is_scene_file(options)) {
        require_no_bodies_of_file(options);
        try {
            return from_file(options);
        } catch (const std::bad_alloc&) {
            throw UsageError(options.name + ": beyond memory; " + free_memory());
        }
    }
    const Demo& demo = demo_named(options);
    require_memory_for(options.bodies);
    DemoScene built = build(demo, {options.bodies, options.seed});
    require_memory_for_pieces(built.scene, options.bodies ? fmt::format("--bodies {}", options.bodies) : options.name);
    LoadedScene subject = subject_of(demo, std::move(built));
    if (!options.edits.empty()) edit(subject, options.edits);
    return subject;
}

LoadedScene load_streamed(const SceneOptions& options, int ranks) {
    if (ranks == 1 || !options.edits.empty()) return load_subject(options);
    require_import(options);
    if (!is_scene_file(options)) {
        const Demo& demo = demo_named(options);
        require_memory_for(options.bodies / static_cast<std::size_t>(ranks));
        DemoScene built = build_streamed(demo, {options.bodies, options.seed});
        require_memory_for_pieces(built.scene, options.bodies ? fmt::format("--bodies {}", options.bodies) : options.name);
        return subject_of(demo, std::move(built));
    }
    require_no_bodies_of_file(options);
    try {
        std::vector<std::string> notes;
        std::optional<StreamedDocument> found = stream_scene(options.name, options.imported, &notes);
        if (!found) return load_subject(options);
        LoadedScene subject = subject_of(std::move(found->document), options.name);
        subject.others = [path = options.name, bodies = std::move(found->bodies)](const TakeBody& take) {
            try {
                bodies(take);
            } catch (const SceneError& error) {
                throw UsageError(path + ": " + error.what());
            }
        };
        for (const std::string& note : notes) say("scree: note: {}: {}\n", options.name, note);
        if (options.imported.strict && !notes.empty()) throw UsageError(options.name + ": " + notes.front() + " (--strict)");
        return subject;
    } catch (const SceneError& error) {
        throw UsageError(options.name + ": " + error.what());
    }
}

}  // namespace scree::demos
