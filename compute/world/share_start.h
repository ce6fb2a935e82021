// The tables with which a rank's share of a world begins, compiled from bodies that come one after the other: no rank ever has
// those of all bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "compute/compile/grid_layout.h"
#include "compute/scene/validation/body_validation.h"
#include "compute/scene_stream.h"
#include "compute/settings.h"
#include "compute/tables/state.h"

namespace scree {

// Three passes over the bodies, to be made in this order. What depends on all bodies (the grid, the shapes, the fingerprint of
// the scene) is that of scree::State and SceneCompiler for the whole scene.
class ShareStart {
public:
    ShareStart(const StreamedScene& scene, const Settings& settings, std::uint32_t group_size, std::uint32_t ranks);

    // Checks all bodies and finds the grid and the tables of shapes. False: a scene that ranks hold whole (joints, bodies that
    // break, moving compounds and so on). Throws SceneError.
    bool survey();
    // The places of all dynamic bodies on the Morton curve.
    std::vector<std::uint64_t> find_places();
    // The owners of all bodies, by the first place of every rank but the first; keeps those of this rank. Calls see(body, id) for
    // each body, checked.
    std::vector<int> keep_own(const std::vector<std::uint64_t>& borders, int rank,
                              const std::function<void(const Body& body, std::size_t id)>& see);

    std::size_t bodies() const { return bodies_; }
    const std::map<std::size_t, Body>& still() const { return still_; }  // all that are not dynamic, by id
    std::uint64_t fingerprint() const { return hash_; }                  // of state_bytes.h, after all passes
    const Scene& scene() const { return scene_; }                        // without bodies
    // With rows of the bodies that are not dynamic, and of their parts. The caller may move it away after the passes.
    State& state() { return state_; }
    std::vector<std::uint32_t> own_ids() const;  // in the order of their places
    void put_own(State& state) const;            // into their rows

private:
    struct OwnBody {
        std::uint64_t place = 0;
        std::uint32_t id = 0;
        physics::BodyProperties properties;
        physics::Pose pose;
        physics::Velocity velocity;
    };
    // Calls visit(body, id) for each body that is dynamic, checked, and pass(id) for each other one.
    void for_each(const std::function<void(Body& body, std::uint32_t id)>& visit,
                  const std::function<void(std::uint32_t id)>& pass);
    bool can_keep_still(const Body& body) const;
    void keep_still(Body body, std::uint32_t id);
    void lay_out_still();
    std::uint32_t part_rows() const { return state_.fixed().bodies - state_.fixed().first_part; }

    const StreamedScene& from_;
    const Settings& settings_;
    std::uint32_t ranks_;
    Scene scene_;
    State state_;
    BodyValidation validation_;
    GridLayout layout_;
    std::map<std::size_t, Body> still_;
    std::map<std::size_t, std::uint32_t> still_rows_;  // by id
    std::vector<OwnBody> own_;
    std::size_t bodies_ = 0;
    std::uint64_t hash_ = 0;
};

}  // namespace scree
