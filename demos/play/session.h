// An interactive session: a world with its script, restarts, and a recording of all user commands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "demos/play/replay.h"
#include "demos/program/loaded_scene.h"

namespace scree::demos {

class Session {
public:
    using MakeRunner = std::function<std::unique_ptr<Runner>()>;
    using Prepare = std::function<void(World&)>;
    // `prepare` is called with each world before its first step. Throws as load_subject and World do.
    Session(SceneOptions options, MakeRunner make_runner, Prepare prepare = {});

    void reset();                        // restarts the scene with a new recording
    void open(const std::string& name);  // another demo or scene file; throws UsageError and keeps the current one
    void open(SceneOptions options);     // likewise

    // Performs a command now and records it; throws like scree::demos::perform, recording nothing.
    void perform(const UserCommand& act);
    void step();

    // Goes back, or forward again as far as the session has been, by playing the commands again from the last state that was
    // kept before, or from the start: the bits are the same. Steps from there repeat the later commands until the next one by the
    // user, which begins a branch.
    void go_to(std::uint64_t step);
    // Takes the last command back, and what followed: goes to the moment before it. Commands of one drag, and equal ones in quick
    // succession, are taken back together. Returns whether there was one.
    bool undo();
    // A state to return to, with the recording that led to it. Returning throws std::logic_error where the scene is another one,
    // and ends drags.
    struct Moment {
        Input input;
        std::vector<std::byte> bytes;
    };
    Moment moment() const;
    void return_to(const Moment& moment);
    std::size_t kept_states() const { return kept_.size(); }
    std::size_t kept_bytes() const;
    std::uint64_t farthest_step() const { return std::max(farthest_, world_->steps()); }

    World& world() { return *world_; }
    const World& world() const { return *world_; }
    const LoadedScene& subject() const { return subject_; }
    const SceneOptions& options() const { return options_; }
    std::uint64_t beginnings() const { return beginnings_; }  // number of worlds so far, including this one
    Input input() const;                                      // recording of the current world
    std::size_t acts() const { return performed_; }           // commands of the user in it so far
    // Recordings of the worlds before this one in which the user has done something, oldest first.
    const std::vector<Input>& earlier() const { return earlier_; }

private:
    // A state right after its step, before the script's and the user's commands.
    struct Kept {
        std::uint64_t step = 0;
        std::size_t performed = 0;
        std::vector<std::byte> bytes;
    };

    void keep();
    void forget_some();
    void begin();
    void begin_world();
    void run_script();
    void perform_recorded();
    void branch();
    void release_held();
    void keep_recording();
    void replay(std::uint64_t step);
    std::size_t last_deed() const;

    SceneOptions options_;
    MakeRunner make_runner_;
    Prepare prepare_;  // may be empty
    LoadedScene subject_;
    std::optional<World> world_;
    Input input_;
    std::vector<Input> earlier_;
    std::size_t performed_ = 0;  // commands of input_ so far; later ones are those of a future that was left
    std::uint64_t farthest_ = 0;
    std::vector<Kept> kept_;    // ascending by step
    double since_kept_ = 0;     // s of wall time that steps took
    double keeping_takes_ = 0;  // s, the last time
    std::uint64_t beginnings_ = 0;
};

}  // namespace scree::demos
