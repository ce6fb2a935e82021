// The motion of a run as a file for other programs: a recorder that follows the world, and writers of formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/film/export/glb_meshes.h"

namespace scree::demos {

struct AnimatedBody {
    std::size_t id = 0;
    BodyHandle handle;
    std::string name;
    Drawn drawn;
    bool plane = false, moves = false;
    std::optional<glm::vec3> color{};  // linear, where the body has its own
    double inverse_mass = 0;           // 1/kg
    bool existed = true;               // at the start
    bool exists = true;
    glm::vec3 start_position{0};  // m; planes stand in the world
    glm::vec4 start_orientation{0, 0, 0, 1};
    std::optional<BodyFrame> origin{};  // in which the body was described, in its own frame; none: that
    BodyState now;                      // the last while it existed, but for velocities, which are 0 afterwards
};

struct Moment {
    std::uint64_t step = 0;
    double time = 0;  // s since the first
};

// Bodies are those of the start, fragments included, but for removed ones.
struct Animated {
    std::vector<AnimatedBody> bodies;
    std::vector<Triangles> meshes;
    float rate = 60;  // steps a second
    int every = 1;    // steps from one moment to the next
};

class AnimationWriter {
public:
    virtual ~AnimationWriter() = default;
    virtual void begin(const Animated& all) = 0;  // throws std::invalid_argument for what the format does not bear
    virtual void add(const Animated& all, const Moment& moment) = 0;
    // The file with all that was added so far; more may be added, and the file be written again. Throws host::FileError.
    virtual void write(const Animated& all) = 0;
};

class AnimationRecorder {
public:
    // Records the beginning.
    AnimationRecorder(const World& world, int every, std::unique_ptr<AnimationWriter> writer);

    int steps_until_due(const World& world) const;
    void after_step(const World& world);  // records if it is due
    void write() { writer_->write(all_); }

private:
    void take_bodies(const World& world);
    void record(const World& world);

    std::unique_ptr<AnimationWriter> writer_;
    Animated all_;
    std::uint64_t arrangements_ = 0;
    double start_time_ = 0;                  // s
    std::optional<std::uint64_t> recorded_;  // at this step
};

}  // namespace scree::demos
