// Worlds: making and stepping them.
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <future>
#include <map>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "demos/python/module/world_object.h"

namespace scree::python {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

// Backends that were opened, kept open: a Vulkan device takes as long to open as many a run.
using BackendKey = std::tuple<std::string, std::string, int, bool>;
std::map<BackendKey, demos::Backend>& backends() {
    static auto* opened = new std::map<BackendKey, demos::Backend>;
    return *opened;
}

const demos::Backend& backend_named(const std::string& backend, const std::string& device, int threads, bool validate) {
    const BackendKey key(backend, device, threads, validate);
    const auto found = backends().find(key);
    if (found != backends().end()) return found->second;
    demos::MachineOptions options;
    options.backend = backend;
    options.device = device;
    options.threads = threads;
    options.validate = validate;
    demos::Backend opened = [&] {
        const py::gil_scoped_release unlocked;
        return demos::choose_machine(options, demos::Choice::fastest);
    }();
    return backends().emplace(key, std::move(opened)).first->second;
}

Settings settings_of(const SceneDocument& document, const std::string& text) {
    using namespace json_reading;
    Settings settings = document.settings.value_or(Settings{});
    const json given = json_of(text);
    const Place place = root / "settings";
    only(given, place, keys_of<Settings>());
    read_fields(given, place, settings);
    schema::check_fields(place, settings);
    return settings;
}

// `scenes`: one, of which there are `copies` (0: none but itself), or one for each copy.
std::shared_ptr<WorldObject> make_world(const std::vector<Description>& scenes, const std::string& settings,
                                        const std::string& backend, const std::string& device, int threads, bool validate,
                                        std::size_t copies) {
    const SceneDocument& first = scenes.at(0).document;
    check_events(first.events, first.scene);
    if (copies > 0 && !first.events.empty())
        throw py::value_error("copies: the scene acts on its bodies over time (Scene.at), which copies do not");
    const Settings chosen = settings_of(first, settings);
    const demos::Backend& machine = backend_named(backend, device, threads, validate);
    const py::gil_scoped_release unlocked;
    if (copies == 0) return std::make_shared<WorldObject>(first, World(first.scene, chosen, machine.make_runner()), machine);
    VaryCopy vary;
    if (scenes.size() > 1) vary = [&](std::size_t copy, Scene& scene) { scene = scenes[copy].document.scene; };
    return std::make_shared<WorldObject>(first, World(first.scene, chosen, machine.make_runner(), copies, vary), machine);
}

// Steps without Python's lock, in batches of about 20 ms, between which signals are heard and progress is told.
constexpr double batch_seconds = 0.02, seconds_between_reports = 0.1;
constexpr int largest_batch = 1024;
// A batch that may take longer than this runs on a thread of its own, so that Ctrl-C is heard while it runs.
constexpr double long_batch_seconds = 0.1;
constexpr std::chrono::milliseconds hearing(50);

void advance(WorldObject& object, int batch) {
    const Clock::time_point start = Clock::now();
    try {
        object.world.step(batch);
    } catch (const std::length_error& error) {
        throw BeyondMemory(error.what());
    }
    for (const auto& file : object.exports) file->after_step(object.world);
    object.batch_seconds = seconds_since(start);
}

bool ends_soon(const std::future<void>& work) {
    const py::gil_scoped_release unlocked;
    return work.wait_for(hearing) == std::future_status::ready;
}

class Stepping {
public:
    Stepping(WorldObject& object, int count, py::object report)
        : object_(object), use_(object), count_(count), report_(std::move(report)) {}

    void run() {
        const bool has_events = !object_.shown.events.empty();
        for (int done = 0; done < count_;) {
            if (has_events) perform_due(object_.shown.events, object_.world);
            int batch = has_events ? 1 : std::min(batch_, count_ - done);
            for (const auto& file : object_.exports) batch = std::min(batch, file->steps_until_due(object_.world));
            step(batch);
            done += batch;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (done < count_ && !report_.is_none() && seconds_since(reported_) > seconds_between_reports) {
                reported_ = Clock::now();
                report_(done, count_);
            }
        }
    }

private:
    void step(int batch) {
        if (object_.batch_seconds > long_batch_seconds) {
            step_aside(batch);
        } else {
            const py::gil_scoped_release unlocked;
            advance(object_, batch);
        }
        const double seconds = object_.batch_seconds;
        if (seconds < 0.5 * batch_seconds) batch_ = std::min(2 * batch_, largest_batch);
        if (seconds > 2 * batch_seconds) batch_ = std::max(batch_ / 2, 1);
    }

    // Interrupted, the batch goes on by itself, and whatever uses the world next waits for it.
    void step_aside(int batch) {
        std::packaged_task<void()> task([world = object_.shared_from_this(), batch] { advance(*world, batch); });
        std::future<void> work = task.get_future();
        std::thread(std::move(task)).detach();
        while (!ends_soon(work)) {
            if (PyErr_CheckSignals() == 0) continue;
            object_.left = std::move(work);
            throw py::error_already_set();
        }
        work.get();
    }

    WorldObject& object_;
    Use use_;
    int count_, batch_ = 1;
    py::object report_;
    Clock::time_point reported_ = Clock::now();
};

void step(WorldObject& object, int count, py::object report) {
    if (count < 0) throw py::value_error("step: the number of steps must not be negative");
    Stepping(object, count, std::move(report)).run();
}

py::dict statistics_of(const Statistics& s) {
    const auto three = [](const double(&v)[3]) { return py::make_tuple(v[0], v[1], v[2]); };
    py::dict made;
    made["bodies"] = s.bodies;
    made["broken"] = s.broken;
    made["pieces"] = s.pieces;
    made["manifolds"] = s.manifolds;
    made["points"] = s.points;
    made["penetration_mean"] = s.penetration_mean;
    made["penetration_max"] = s.penetration_max;
    made["penetration_resting"] = s.penetration_resting;
    made["max_speed"] = s.max_speed;
    made["max_spin"] = s.max_spin;
    made["spin_limited"] = s.spin_limited;
    made["kinetic_energy"] = s.kinetic_energy;
    made["potential_energy"] = s.potential_energy;
    made["momentum"] = three(s.momentum);
    made["angular_momentum"] = three(s.angular_momentum);
    made["drift_max"] = s.drift_max;
    made["asleep"] = s.asleep;
    made["not_finite"] = s.not_finite;
    made["below_ground"] = s.below_ground;
    made["joints"] = s.joints;
    made["joints_broken"] = s.joints_broken;
    made["joint_force_max"] = s.joint_force_max;
    made["joint_torque_max"] = s.joint_torque_max;
    return made;
}

// An animation that is recorded from now on. The file is there at once, and written again by close().
struct Export {
    std::shared_ptr<WorldObject> object;
    std::shared_ptr<demos::Animation> file;
};

std::unique_ptr<Export> start_export(const std::shared_ptr<WorldObject>& object, const std::string& path, int every, int clips) {
    if (every < 1) throw py::value_error("every: must be at least 1 step");
    if (clips < 0) throw py::value_error("clips: must be at least 0 moments");
    if (clips > 0 && !path.ends_with(".usda")) throw py::value_error("clips: are of a .usda");
    Use world(*object);
    auto file = std::make_shared<demos::Animation>(demos::ExportOptions{path, every, false, clips}, *world);
    file->write();
    object->exports.push_back(file);
    return std::make_unique<Export>(Export{object, std::move(file)});
}

void close_export(Export& made) {
    if (!made.file) return;
    Use world(*made.object);
    std::erase(made.object->exports, made.file);
    const std::shared_ptr<demos::Animation> file = std::exchange(made.file, nullptr);
    const py::gil_scoped_release unlocked;
    file->write();
}

py::bytes save(WorldObject& object) {
    Use world(object);
    std::vector<std::byte> bytes;
    {
        const py::gil_scoped_release unlocked;
        bytes = world->save();
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void restore(WorldObject& object, const std::string_view saved) {
    object.require_no_views("restored");
    Use world(object);
    const py::gil_scoped_release unlocked;
    world->restore(std::as_bytes(std::span(saved)));
}

void roll_back(WorldObject& object, std::uint64_t steps) {
    object.require_no_views("rolled back");
    Use world(object);
    const py::gil_scoped_release unlocked;
    world->roll_back(steps);
}

Description snapshot(WorldObject& object, std::optional<std::size_t> copy) {
    Use world(object);
    Description made{object.shown, {}};
    made.document.scene = copy ? world->snapshot_of(*copy) : world->snapshot();
    made.document.settings = world->settings();
    made.document.events = coming_events(object.shown.events, *world);
    if (made.document.events.size() != object.shown.events.size() && world->statistics().broken > 0 &&
        !object.shown.events.empty())
        made.notes.emplace_back("bodies have broken, which numbers them anew: its timed events are left out");
    return made;
}

void reset(WorldObject& object, const py::array_t<bool, py::array::c_style | py::array::forcecast>& mask) {
    Use world(object);
    const std::vector<std::uint8_t> which(mask.data(), mask.data() + mask.size());
    const py::gil_scoped_release unlocked;
    world->reset(which);
}

}  // namespace

WorldObject::WorldObject(const SceneDocument& document, World made, const demos::Backend& backend)
    : machine(backend),
      shown{{}, document.viewpoint, document.settings, document.duration, document.picture, document.events},
      world(std::move(made)) {}

void WorldObject::await_left() {
    if (!left.valid()) return;
    while (!ends_soon(left))
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    std::exchange(left, {}).get();
}

WorldObject::~WorldObject() {
    try {
        close_exports();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "scree: %s\n", error.what());
    }
}

void WorldObject::close_exports() {
    for (const auto& file : std::exchange(exports, {})) file->write();
}

const demos::LoadedScene& WorldObject::as_subject() {
    if (!subject) {
        SceneDocument document = shown;
        document.scene = world.scene();  // at the start: what is yet to fall sets the ranges of colours
        document.events.clear();
        subject = demos::subject_of(std::move(document), "scene");
    }
    return *subject;
}

void WorldObject::require_no_views(const char* what) const {
    if (views == 0) return;
    throw py::buffer_error("the world cannot be " + std::string(what) + " while " + std::to_string(views) +
                           " arrays look into its tables (World.tables); delete or copy them first");
}

void bind_worlds(py::module_& module) {
    py::class_<Export>(module, "Export", plain_class()).def("close", &close_export);
    WorldClass of_world(module, "World", plain_class());
    of_world.def(py::init(&make_world))
        .def("step", &step)
        .def("export_to", &start_export)
        .def("close_exports",
             [](WorldObject& object) {
                 object.await_left();
                 object.close_exports();
             })
        .def("is_stepping", [](const WorldObject& object) { return object.left.valid(); })
        .def("save", &save)
        .def("restore", &restore)
        .def("keep_state",
             [](WorldObject& object) {
                 Use world(object);
                 const py::gil_scoped_release unlocked;
                 world->keep_state();
             })
        .def("roll_back", &roll_back)
        .def("kept_states",
             [](WorldObject& object) {
                 Use world(object);
                 return world->kept_states();
             })
        .def("drop_states",
             [](WorldObject& object) {
                 Use world(object);
                 world->drop_states();
             })
        .def("snapshot", &snapshot, py::arg("copy") = py::none())
        .def("write_checkpoint",
             [](WorldObject& object, const std::string& path, const std::string& note) {
                 Use world(object);
                 write_checkpoint(path, *world, note);
             })
        .def("read_checkpoint",
             [](WorldObject& object, const std::string& path) {
                 object.require_no_views("restored");
                 Use world(object);
                 const CheckpointFile file = read_checkpoint(path);
                 world->restore(file.state);
                 return file.note;
             })
        .def(
            "statistics",
            [](WorldObject& object, std::optional<std::size_t> copy) {
                Use world(object);
                return statistics_of(copy ? world->statistics_of(*copy) : world->statistics());
            },
            py::arg("copy") = py::none())
        .def("copies", [](WorldObject& object) { return Use(object)->copies(); })
        .def("state_hashes",
             [](WorldObject& object) {
                 std::vector<std::string> made;
                 for (const std::uint64_t hash : Use(object)->state_hashes()) made.push_back(hash_text(hash));
                 return made;
             })
        .def("reset", &reset)
        .def("gravity_of",
             [](WorldObject& object, std::size_t copy) {
                 const vec3 gravity = Use(object)->gravity_of(copy);
                 return py::make_tuple(gravity.x, gravity.y, gravity.z);
             })
        .def("set_gravity_of",
             [](WorldObject& object, std::size_t copy, std::array<float, 3> gravity) {
                 Use(object)->set_gravity_of(copy, {gravity[0], gravity[1], gravity[2]});
             })
        .def("wake_copy", [](WorldObject& object, std::size_t copy) { Use(object)->wake_copy(copy); })
        .def("settings", [](WorldObject& object) { return settings_dict(Use(object)->settings()); })
        .def("state_hash", [](WorldObject& object) { return hash_text(Use(object)->state_hash()); })
        .def("stage_times",
             [](WorldObject& object) {
                 py::dict times;
                 for (const auto& [stage, ms] : Use(object)->stage_times()) times[stage.c_str()] = ms;
                 return times;
             })
        .def("set_profiling", [](WorldObject& object, bool on) { Use(object)->set_profiling(on); })
        .def_property_readonly("steps", [](WorldObject& object) { return Use(object)->steps(); })
        .def_property_readonly("time", [](WorldObject& object) { return Use(object)->time(); })
        .def_property_readonly("backend", [](WorldObject& object) { return Use(object)->runner().backend(); })
        .def_property_readonly("device", [](WorldObject& object) { return Use(object)->runner().device(); })
        .def_property_readonly("remark", [](WorldObject& object) { return object.machine.remark; })
        .def_property_readonly("buffer_bytes", [](WorldObject& object) { return Use(object)->buffer_bytes(); })
        .def_property_readonly("buffer_growths", [](WorldObject& object) { return Use(object)->buffer_growths(); });
    bind_state(of_world);
    bind_changes(of_world);
    bind_records(module, of_world);
    bind_queries(module, of_world);
    bind_pictures(module, of_world);
    bind_tables(of_world);
    module.def("close_backends", [] { backends().clear(); });
}

}  // namespace scree::python
