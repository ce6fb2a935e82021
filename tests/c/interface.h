// Scenes and worlds of the C interface for a test, which end with it.
#pragma once

#include <scree/scree.h>

#include <catch2/catch.hpp>
#include <string>
#include <utility>

namespace scree::c_tests {

// Requires that a call went well, else shows what it says.
inline void ok(scree_result result) {
    INFO((result == SCREE_OK ? "" : scree_error_message()));
    REQUIRE(result == SCREE_OK);
}

// Requires that a call is refused so, with these words in its message.
inline void refused(scree_result result, scree_result kind, const std::string& words) {
    INFO((result == SCREE_OK ? "" : scree_error_message()));
    REQUIRE(result == kind);
    CHECK(std::string(scree_error_message()).find(words) != std::string::npos);
}

class Scene {
public:
    Scene() { ok(scree_scene_create(&handle_)); }
    explicit Scene(scree_scene* made) : handle_(made) {}
    Scene(Scene&& from) noexcept : handle_(std::exchange(from.handle_, nullptr)) {}
    ~Scene() { scree_scene_release(handle_); }
    operator scree_scene*() const { return handle_; }
    std::string get(const char* key) const {
        const char* json = nullptr;
        ok(scree_scene_get(handle_, key, &json));
        return json;
    }

private:
    scree_scene* handle_ = nullptr;
};

inline Scene demo(const std::string& name, std::size_t bodies = 0) {
    scree_scene* made = nullptr;
    ok(scree_scene_demo(name.c_str(), bodies, 1, &made));
    return Scene(made);
}

class World {
public:
    explicit World(const scree_scene* scene, const char* backend = "cpu", std::size_t copies = 0) {
        scree_world_options options = SCREE_INIT(scree_world_options);
        options.backend = backend;
        options.copies = copies;
        options.threads = 2;
        ok(scree_world_create(scene, &options, &handle_));
    }
    World(const World&) = delete;
    ~World() { scree_world_release(handle_); }
    operator scree_world*() const { return handle_; }
    void step(std::uint64_t count) const { ok(scree_world_step(handle_, count, nullptr, nullptr)); }
    std::uint64_t hash() const {
        std::uint64_t made = 0;
        ok(scree_world_hash(handle_, &made));
        return made;
    }
    scree_world_info info() const {
        scree_world_info made = SCREE_INIT(scree_world_info);
        ok(scree_world_get_info(handle_, &made));
        return made;
    }

private:
    scree_world* handle_ = nullptr;
};

// Ground, and balls of 0.5 m in a row, 3 m apart and 2 m high.
inline Scene balls(std::size_t count) {
    Scene scene;
    ok(scree_scene_add_bodies(scene, R"({"motion": "fixed", "shape": {"plane": {}}})", 1, nullptr, 0, nullptr));
    std::vector<float> places;
    for (std::size_t i = 0; i < count; ++i) places.insert(places.end(), {3 * static_cast<float>(i), 2, 0});
    const scree_column columns[] = {{"position", places.data(), 0}};
    ok(scree_scene_add_bodies(scene, R"({"shape": {"sphere": {"radius": 0.5}}, "name": "ball"})", count, columns, 1, nullptr));
    return scene;
}

template <class Record>
const Record& record(const scree_array& array, std::size_t i) {
    return *reinterpret_cast<const Record*>(static_cast<const char*>(array.data) + i * array.stride);
}

}  // namespace scree::c_tests
