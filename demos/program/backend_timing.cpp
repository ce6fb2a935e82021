// Comparison of two runners.
#include "demos/program/backend_timing.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "compute/world.h"
#include "host/files/file.h"
#include "host/system/machine.h"

namespace scree::demos {

namespace {

constexpr int heap_rows = 10;  // a pile of heap_rows^3 boxes
static_assert(heap_rows * heap_rows * heap_rows == heap_bodies);
constexpr int steps_to_warm = 4, steps_to_time = 6;

// Layers of boxes, shifted by half a box, so that most rest on four others, as in a pile.
Scene resting_heap() {
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < heap_bodies; ++i) {
        const int layer = i / (heap_rows * heap_rows), row = i / heap_rows % heap_rows, column = i % heap_rows;
        Body box{.name = "box", .shape = Box{}};
        const float shift = layer % 2 == 0 ? 0.0f : 0.5f;
        box.position = vec3(static_cast<float>(column) * 1.01f + shift, 0.4995f + 0.999f * static_cast<float>(layer),
                            static_cast<float>(row) * 1.01f + shift);
        scene.bodies.push_back(box);
    }
    return scene;
}

double step_ms(World& world) {
    const auto start = std::chrono::steady_clock::now();
    world.step();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Identifies the build of this program.
std::string this_program() {
    std::error_code none;
    const auto time = std::filesystem::last_write_time(host::own_file(), none);
    return none ? "" : std::to_string(static_cast<long long>(time.time_since_epoch().count()));
}

std::filesystem::path file_of_paces() {
    const std::filesystem::path folder = host::cache_folder();
    if (folder.empty()) return folder;
    return folder / (host::own_file().extension() == ".so" ? "paces-python.json" : "paces.json");
}

nlohmann::json known_paces() {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file_of_paces(), none)) return nlohmann::json::object();
    try {
        nlohmann::json all = nlohmann::json::parse(host::read_text(file_of_paces()));
        return all.is_object() && all.value("program", "") == this_program() ? all : nlohmann::json::object();
    } catch (const std::exception&) {
        return nlohmann::json::object();
    }
}

std::optional<Paces> remembered(const nlohmann::json& all, const std::string& key) {
    const auto found = all.find(key);
    if (found == all.end() || !found->is_array() || found->size() != 2) return std::nullopt;
    if (!(*found)[0].is_number() || !(*found)[1].is_number()) return std::nullopt;
    return Paces{(*found)[0].get<double>(), (*found)[1].get<double>(), true};
}

}  // namespace

Paces measure_paces(const MakeRunner& on_device, const MakeRunner& on_processor) {
    const Scene heap = resting_heap();
    Settings settings;
    settings.sleeping = false;
    std::array<World, 2> worlds{World(heap, settings, on_device()), World(heap, settings, on_processor())};
    std::array<double, 2> least{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    for (int step = 0; step < steps_to_warm + steps_to_time; ++step) {
        for (std::size_t i = 0; i < worlds.size(); ++i) {
            const double ms = step_ms(worlds[i]);
            if (step >= steps_to_warm) least[i] = std::min(least[i], ms);
        }
    }
    return {least[0], least[1], false};
}

Paces paces_of(const std::string& key, const std::function<Paces()>& measure) {
    nlohmann::json all = known_paces();
    if (const std::optional<Paces> known = remembered(all, "on " + key)) return *known;
    const Paces paces = measure();
    all["program"] = this_program();
    all["on " + key] = {paces.device, paces.processor};
    if (!file_of_paces().empty()) {
        try {
            host::make_folder(host::cache_folder());
            host::write_atomically(file_of_paces(), all.dump(1));
        } catch (const host::FileError&) {  // not cached: measured again next time
        }
    }
    return paces;
}

}  // namespace scree::demos
