// A world as chunks of a recording: its shapes and bodies once, as they appear, and of each frame what the bodies do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/film/pages/chunk_bytes.h"
#include "demos/film/pages/frame_encoder.h"
#include "demos/program/copies.h"

namespace scree::demos {

class WorldChunks {
public:
    explicit WorldChunks(const CopiesShown& shown = {}) : shown_(shown) {}

    // Appends the chunks of bodies and joints that were not there before ("mesh", "body", "join"); none, if there are none.
    void take_new(std::string& block, const World& world);
    // What every body does now. A body keeps its place, also after it is gone; a later one never gets it.
    const std::vector<BodyMoment>& look(const World& world);
    // Appends all points that touch, and all joints. `units` as for the frame, whose bodies `followers` tell.
    void add_contacts(ChunkBytes& to, const World& world, const FrameUnits& units, const std::vector<Follower>& followers,
                      bool whole);
    void add_joints(ChunkBytes& to, const World& world, const FrameUnits& units, bool whole);
    // Of a body of the world at present, plus 1; 0: none.
    std::uint32_t place_of(std::size_t body) const { return body < places_.size() ? places_[body] : 0; }

private:
    struct Followed {
        std::size_t id = 0;
        BodyHandle handle;
        bool plane = false, gone = false;
        glm::vec3 offset{0};  // of a copy that is shown beside others
    };
    // A point that touches, of the bodies with these places plus 1. Of what changes the place beside a body, the normal as an
    // octahedron's bytes, and the level of the force.
    struct TouchingPoint {
        std::uint32_t a = 0, b = 0;
        std::array<double, 6> exact{};
        std::array<std::int32_t, 6> told{};
    };

public:
    using ContactsTold = std::vector<TouchingPoint>;
    // Readers of different rates have been told of different contacts.
    void exchange_told(ContactsTold& told) { touching_.swap(told); }

private:
    std::vector<TouchingPoint> touching(const World& world, const FrameUnits& units,
                                        const std::vector<Follower>& followers) const;
    std::uint32_t mesh_of(std::string& block, const void* key, const Shape& shape);
    void add_part(std::string& block, ChunkBytes& to, const Shape& shape, glm::vec3 position, glm::vec4 orientation);
    ChunkBytes described(std::string& block, const World& world, std::size_t id);
    void take_joints(std::string& block, const World& world);

    CopiesShown shown_;
    std::vector<Followed> bodies_;       // by place
    std::vector<std::uint32_t> places_;  // by id, plus 1
    std::map<const void*, std::uint32_t> meshes_;
    std::vector<std::shared_ptr<const void>> kept_;  // what the keys of meshes_ point at
    std::vector<BodyMoment> moments_;
    std::vector<float> forces_;  // by row
    LevelTrack joint_forces_;
    std::vector<TouchingPoint> touching_;  // as told
    std::uint64_t arrangements_ = 0;
    std::size_t joints_ = 0;
    bool begun_ = false;
};

}  // namespace scree::demos
