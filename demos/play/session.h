// A world that a person plays with: begun and begun again, stepped by its script, and all that is done to it recorded.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "demos/play/replay.h"
#include "demos/program/loaded_scene.h"

namespace scree::demos {

class Session {
public:
    using MakeRunner = std::function<std::unique_ptr<Runner>()>;
    // Throws as load_subject and World do.
    Session(SceneOptions options, MakeRunner make_runner);

    void reset();                        // the same scene from its start, and a new recording
    void open(const std::string& name);  // another demo or scene file; throws UsageError and keeps what there is

    // At once, and into the recording; throws as scree::demos::perform does, and records nothing then.
    void perform(const UserCommand& act);
    void step();

    World& world() { return *world_; }
    const World& world() const { return *world_; }
    const LoadedScene& subject() const { return subject_; }
    const SceneOptions& options() const { return options_; }
    std::uint64_t beginnings() const { return beginnings_; }  // worlds so far, this one included
    Input input() const;                                      // from this world's beginning until now

private:
    void begin();
    void run_script();

    SceneOptions options_;
    MakeRunner make_runner_;
    LoadedScene subject_;
    std::optional<World> world_;
    Input input_;
    std::uint64_t beginnings_ = 0;
};

}  // namespace scree::demos
