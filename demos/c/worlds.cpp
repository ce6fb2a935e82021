// The C interface: worlds that are made, stepped, saved and told about.
#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "compute/checkpoint.h"
#include "demos/c/json.h"
#include "demos/c/objects.h"

namespace scree::c {

using namespace json_reading;

namespace {

// Backends that were opened, kept open: a Vulkan device takes as long to open as many a run.
struct Backends {
    std::mutex mutex;
    std::map<std::tuple<std::string, std::string, int, bool>, demos::Backend> opened;
};
Backends& backends() {
    static auto* made = new Backends;
    return *made;
}

demos::Backend backend_of(const scree_world_options& given) {
    demos::MachineOptions options;
    const std::string backend = text_or_none(given.backend, "backend");
    options.backend = backend.empty() ? "auto" : backend;
    const Names known{"auto", "cpu", "vulkan"};
    if (std::find(known.begin(), known.end(), options.backend) == known.end()) refuse(unknown("backend", options.backend, known));
    options.device = text_or_none(given.device, "device");
    if (given.threads < 0 || given.threads > 4096)
        refuse("threads: must be between 0 and 4096, is " + std::to_string(given.threads));
    options.threads = given.threads;
    options.validate = given.validate != 0;
    Backends& all = backends();
    const std::lock_guard lock(all.mutex);
    const auto key = std::tuple(options.backend, options.device, options.threads, options.validate);
    auto found = all.opened.find(key);
    if (found == all.opened.end()) found = all.opened.emplace(key, demos::choose_machine(options, demos::Choice::fastest)).first;
    return found->second;
}

Settings settings_of(const SceneDocument& document, const char* given) {
    Settings settings = document.settings.value_or(Settings{});
    if (given == nullptr) return settings;
    const json value = json_given(given, "settings_json");
    const Place place = root / "settings";
    only(value, place, keys_of<Settings>());
    read_fields(value, place, settings);
    schema::check_fields(place, settings);
    return settings;
}

// `copies`: how many of the scene; 0: itself. `vary`: what each is to be instead.
std::shared_ptr<WorldObject> made_world(const SceneDocument& document, const scree_world_options& options, std::size_t copies,
                                        const VaryCopy& vary) {
    check_events(document.events, document.scene);
    if (copies > 0 && !document.events.empty())
        refuse("copies: the scene has timed events, which copies do not perform; take them out of it");
    const Settings settings = settings_of(document, options.settings_json);
    const demos::Backend machine = backend_of(options);
    if (copies == 0)
        return std::make_shared<WorldObject>(document, World(document.scene, settings, machine.make_runner()), machine);
    return std::make_shared<WorldObject>(document, World(document.scene, settings, machine.make_runner(), copies, vary), machine);
}

// Steps in batches of about 20 ms, between which progress is told and exports take their pictures.
class Stepping {
public:
    Stepping(WorldObject& object, std::uint64_t count, scree_progress progress, void* user)
        : object_(object), count_(count), progress_(progress), user_(user) {
        for (const auto& page : object.recordings)
            if (auto held = page.lock()) pages_.push_back(std::move(held));
    }

    void run() {
        const bool has_events = !object_.shown.events.empty() || object_.before_step;
        for (std::uint64_t done = 0; done < count_;) {
            if (!object_.shown.events.empty()) perform_due(object_.shown.events, object_.world);
            if (object_.before_step) {
                object_.require_no_views("stepped after a demo");
                object_.before_step(object_.world);
            }
            int batch =
                has_events ? 1 : static_cast<int>(std::min<std::uint64_t>(static_cast<std::uint64_t>(batch_), count_ - done));
            for (const auto& file : object_.exports) batch = std::min(batch, file->steps_until_due(object_.world));
            for (const auto& page : pages_) batch = std::min(batch, page->steps_until_due());
            if (object_.measuring && object_.measuring->watches_steps()) batch = 1;
            step(batch);
            done += static_cast<std::uint64_t>(batch);
            if (progress_ != nullptr && progress_(user_, done, count_) != 0 && done < count_)
                throw Failure(SCREE_STOPPED,
                              "stopped after " + std::to_string(done) + " of " + std::to_string(count_) + " steps");
        }
    }

private:
    static constexpr double batch_seconds = 0.02;
    static constexpr int largest_batch = 1024;

    void step(int batch) {
        const auto start = std::chrono::steady_clock::now();
        try {
            object_.world.step(batch);
        } catch (const std::length_error& error) {
            throw Failure(SCREE_NO_MEMORY, error.what());
        }
        for (const auto& file : object_.exports) file->after_step(object_.world);
        for (const auto& page : pages_) page->after_step();
        if (object_.measuring) object_.measuring->after_step(object_.world);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (seconds < 0.5 * batch_seconds) batch_ = std::min(2 * batch_, largest_batch);
        if (seconds > 2 * batch_seconds) batch_ = std::max(batch_ / 2, 1);
    }

    WorldObject& object_;
    std::vector<std::shared_ptr<demos::PageRecording>> pages_{};  // kept, should they be released meanwhile
    std::uint64_t count_;
    int batch_ = 1;
    scree_progress progress_;
    void* user_;
};

scree_statistics record_of(const Statistics& s) {
    scree_statistics made{};
    made.bodies = s.bodies;
    made.broken = s.broken;
    made.pieces = s.pieces;
    made.manifolds = s.manifolds;
    made.points = s.points;
    made.penetration_mean = s.penetration_mean;
    made.penetration_max = s.penetration_max;
    made.penetration_resting = s.penetration_resting;
    made.max_speed = s.max_speed;
    made.max_spin = s.max_spin;
    made.spin_limited = s.spin_limited;
    made.kinetic_energy = s.kinetic_energy;
    made.potential_energy = s.potential_energy;
    std::copy(std::begin(s.momentum), std::end(s.momentum), made.momentum);
    std::copy(std::begin(s.angular_momentum), std::end(s.angular_momentum), made.angular_momentum);
    made.drift_max = s.drift_max;
    made.asleep = s.asleep;
    made.not_finite = s.not_finite;
    made.below_ground = s.below_ground;
    made.joints = s.joints;
    made.joints_broken = s.joints_broken;
    made.joint_force_max = s.joint_force_max;
    made.joint_torque_max = s.joint_torque_max;
    return made;
}

std::string stage_times_json(const World& world) {
    json made = json::object();
    for (const auto& [stage, milliseconds] : world.stage_times()) made[stage] = milliseconds;
    return made.dump();
}

SceneDocument present(WorldObject& object, std::optional<std::size_t> copy, std::vector<std::string>& notes) {
    SceneDocument made = object.shown;
    made.scene = copy ? object.world.snapshot_of(*copy) : object.world.snapshot();
    made.settings = object.world.settings();
    made.events = coming_events(object.shown.events, object.world);
    if (made.measures && object.world.statistics().broken > 0) made.measures->bodies.clear();  // they are numbered anew
    if (made.events.size() != object.shown.events.size() && object.world.statistics().broken > 0 && !object.shown.events.empty())
        notes.emplace_back("bodies have broken, which numbers them anew: its timed events are left out");
    return made;
}

}  // namespace

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

void scree_close_devices(void) {
    released([] {
        Backends& all = backends();
        const std::lock_guard lock(all.mutex);
        all.opened.clear();
    });
}

scree_result scree_world_create(const scree_scene* scene, const scree_world_options* options, scree_world** world) {
    return called([&] {
        given(world, "world");
        const ReadScene of(scene);
        const scree_world_options chosen = options_of(options);
        *world = handle_of(made_world(of->document, chosen, chosen.copies, {}));
    });
}

scree_result scree_world_create_copies(const scree_scene* const* scenes, size_t count, const scree_world_options* options,
                                       scree_world** world) {
    return called([&] {
        given(world, "world");
        given_array(scenes, count, "scenes");
        if (count == 0) refuse("scenes: there are none");
        const scree_world_options chosen = options_of(options);
        if (chosen.copies != 0 && chosen.copies != count)
            refuse("copies: is " + std::to_string(chosen.copies) + ", and there are " + std::to_string(count) + " scenes");
        std::vector<ReadScene> all;
        for (std::size_t i = 0; i < count; ++i)
            if (!all.emplace_back(scenes[i])->document.events.empty())
                refuse("scenes: number " + std::to_string(i) +
                       " has timed events, which copies do not perform; take them out of it");
        const VaryCopy vary = [&](std::size_t copy, Scene& scene) { scene = all[copy]->document.scene; };
        *world = handle_of(made_world(all[0]->document, chosen, count, vary));
    });
}

void scree_world_release(scree_world* world) {
    ended(HandleKind::world, world);  // it ends here, or with the call that is in it
}

scree_result scree_world_step(scree_world* world, uint64_t count, scree_progress progress, void* user) {
    return called([&] {
        const UsedWorld of(world);
        Stepping(*of, count, progress, user).run();
    });
}

scree_result scree_world_follow_demo(scree_world* world, const char* name, size_t bodies, uint64_t seed) {
    return called([&] {
        const UsedWorld used(world);
        if (name == nullptr) {
            used->before_step = nullptr;
            return;
        }
        if (used->world.copies() > 1) refuse("name: a world of copies follows no demo");
        used->before_step = demo_given(text_of(name, "name"), bodies, seed).before_step;
    });
}

scree_result scree_world_get_info(scree_world* world, scree_world_info* info) {
    return called([&] {
        const UsedWorld used(world);
        World& of = used->world;
        scree_world_info made{};
        made.steps = of.steps();
        made.time = of.time();
        made.bodies = of.scene().bodies.size();
        made.bodies_there = of.bodies_there();
        made.joints = of.scene().joints.size();
        made.copies = of.copies();
        made.buffer_bytes = of.buffer_bytes();
        made.buffer_growths = of.buffer_growths();
        made.records_events = of.event_settings().any() ? 1 : 0;
        made.backend = kept_text(of.runner().backend());
        made.device = kept_text(of.runner().device());
        made.remark = kept_text(used->machine.remark);
        fill(info, made, "info");
    });
}

scree_result scree_world_count(scree_world* world, const char* list, size_t* count) {
    return called([&] {
        given(count, "count");
        const UsedWorld used(world);
        const World& of = used->world;
        const std::string asked = text_of(list, "list");
        if (asked == "bodies")
            *count = of.scene().bodies.size();
        else if (asked == "bodies_there")
            *count = of.bodies_there();
        else if (asked == "joints")
            *count = of.scene().joints.size();
        else if (asked == "vehicles")
            *count = of.scene().vehicles.size();
        else if (asked == "copies")
            *count = of.copies();
        else
            refuse(unknown("list", asked, {"bodies", "bodies_there", "joints", "vehicles", "copies"}));
    });
}

scree_result scree_world_get(scree_world* world, const char* key, const char** text) {
    return called([&] {
        given(text, "json");
        const UsedWorld used(world);
        const World& of = used->world;
        const std::string asked = text_of(key, "key");
        const std::size_t copies = std::max<std::size_t>(1, of.copies());
        if (asked == "settings")
            *text = kept_text(whole_json(of.settings()));
        else if (asked == "stage_times")
            *text = kept_text(stage_times_json(of));
        else if (asked == "bodies")
            *text = kept_text(names_json(of.scene().bodies, of.scene().bodies.size() / copies));
        else if (asked == "joints")
            *text = kept_text(names_json(of.scene().joints, of.scene().joints.size() / copies));
        else
            refuse(unknown("key", asked, {"settings", "stage_times", "bodies", "joints"}));
    });
}

scree_result scree_world_find(scree_world* world, const char* list, const char* name, scree_array* indices) {
    return called([&] {
        given(indices, "indices");
        const UsedWorld used(world);
        const World& of = used->world;
        const std::string in = text_of(list, "list"), wanted = text_of(name, "name");
        const std::size_t copies = std::max<std::size_t>(1, of.copies());
        if (in == "bodies")
            *indices = kept_array(first_named(of.scene().bodies, of.scene().bodies.size() / copies, wanted));
        else if (in == "joints")
            *indices = kept_array(first_named(of.scene().joints, of.scene().joints.size() / copies, wanted));
        else
            refuse(unknown("list", in, {"bodies", "joints"}));
    });
}

scree_result scree_world_statistics(scree_world* world, size_t copy, scree_statistics* statistics) {
    return called([&] {
        const UsedWorld used(world);
        const std::optional<std::size_t> one = copy_of(used->world, copy);
        fill(statistics, record_of(one ? used->world.statistics_of(*one) : used->world.statistics()), "statistics");
    });
}

scree_result scree_world_hash(scree_world* world, uint64_t* hash) {
    return called([&] {
        given(hash, "hash");
        const UsedWorld used(world);
        *hash = used->world.state_hash();
    });
}

scree_result scree_world_copy_hashes(scree_world* world, scree_array* hashes) {
    return called([&] {
        given(hashes, "hashes");
        const UsedWorld used(world);
        *hashes = kept_array(used->world.state_hashes());
    });
}

scree_result scree_world_save(scree_world* world, scree_array* bytes) {
    return called([&] {
        given(bytes, "bytes");
        const UsedWorld used(world);
        *bytes = kept_array(used->world.save());
    });
}

scree_result scree_world_restore(scree_world* world, const void* bytes, size_t count) {
    return called([&] {
        const UsedWorld used(world);
        given_array(bytes, count, "bytes");
        used->require_no_views("restored");
        used->world.restore(std::span(static_cast<const std::byte*>(bytes), count));
    });
}

scree_result scree_world_write_checkpoint(scree_world* world, const char* path, const char* note) {
    return called([&] {
        const UsedWorld used(world);
        write_checkpoint(text_of(path, "path"), used->world, text_or_none(note, "note"));
    });
}

scree_result scree_world_read_checkpoint(scree_world* world, const char* path, const char** note) {
    return called([&] {
        const UsedWorld used(world);
        used->require_no_views("restored");
        CheckpointFile file = read_checkpoint(text_of(path, "path"));
        used->world.restore(file.state);
        if (note != nullptr) *note = kept_text(std::move(file.note));
    });
}

scree_result scree_world_keep_state(scree_world* world) {
    return called([&] { UsedWorld(world)->world.keep_state(); });
}

scree_result scree_world_roll_back(scree_world* world, uint64_t steps) {
    return called([&] {
        const UsedWorld used(world);
        used->require_no_views("rolled back");
        used->world.roll_back(steps);
    });
}

scree_result scree_world_kept_states(scree_world* world, scree_array* steps) {
    return called([&] {
        given(steps, "steps");
        const UsedWorld used(world);
        *steps = kept_array(used->world.kept_states());
    });
}

scree_result scree_world_drop_states(scree_world* world) {
    return called([&] { UsedWorld(world)->world.drop_states(); });
}

scree_result scree_world_snapshot(scree_world* world, size_t copy, scree_scene** scene) {
    return called([&] {
        given(scene, "scene");
        const UsedWorld used(world);
        auto made = std::make_shared<SceneObject>();
        made->document = present(*used, copy_of(used->world, copy), made->notes);
        *scene = handle_of(std::move(made));
    });
}

scree_result scree_world_reset(scree_world* world, const uint8_t* copies, size_t count) {
    return called([&] {
        const UsedWorld used(world);
        given_array(copies, count, "copies");
        used->world.reset(std::vector<std::uint8_t>(copies, copies + count));
    });
}

scree_result scree_world_gravity(scree_world* world, size_t copy, float gravity[3]) {
    return called([&] {
        given(gravity, "gravity");
        const UsedWorld used(world);
        const std::optional<std::size_t> one = copy_of(used->world, copy);
        const vec3 of = one ? used->world.gravity_of(*one) : used->world.scene().gravity;
        for (int k = 0; k < 3; ++k) gravity[k] = of[k];
    });
}

scree_result scree_world_cell(scree_world* world, float size[3], float rate[3]) {
    return called([&] {
        given(size, "size");
        given(rate, "rate");
        const UsedWorld used(world);
        const PeriodicCell& cell = used->world.scene().periodic;
        for (int k = 0; k < 3; ++k) {
            size[k] = cell.size[k];
            rate[k] = cell.rate[k];
        }
    });
}

scree_result scree_world_set_gravity(scree_world* world, size_t copy, const float gravity[3]) {
    return called([&] {
        const UsedWorld used(world);
        const vec3 wanted = three_of(gravity, "gravity");
        if (const std::optional<std::size_t> one = copy_of(used->world, copy))
            used->world.set_gravity_of(*one, wanted);
        else
            used->world.set_gravity(wanted);
    });
}

scree_result scree_world_wake_copy(scree_world* world, size_t copy) {
    return called([&] {
        const UsedWorld used(world);
        if (const std::optional<std::size_t> one = copy_of(used->world, copy))
            used->world.wake_copy(*one);
        else
            used->world.wake_all();
    });
}
