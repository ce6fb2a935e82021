// The simulation behind scree serve: its clock, its viewers, and what they ask for. One of them drives, with the interaction of
// the window (demos/play); all get frames.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "demos/play/interaction.h"
#include "demos/program/backend.h"
#include "demos/program/options/options.h"
#include "demos/program/serve/live_stream.h"
#include "demos/program/serve/viewer_message.h"
#include "demos/program/serve/web_server.h"

namespace scree::demos {

struct ServeOptions {
    SceneOptions scene;
    MachineOptions machine;
    PictureOptions pictures;  // --color, --show, --fps
    ServerOptions server;
    double speed = 1;  // simulated seconds a second
    std::string report;
};

class LiveSession {
public:
    LiveSession(const ServeOptions& options, Backend machine, WebServer& server);
    void run();  // until it is interrupted, or the last step is done
    void write_report();

private:
    using Clock = std::chrono::steady_clock;
    struct Viewer {
        bool watches = true;   // its page is shown
        bool begun = false;    // it knows the scene
        bool in_step = false;  // with its lane; else it begins with a whole frame
        std::size_t lane = 0, slowest_asked = 0;
        std::uint64_t sent = 0, seen = 0;  // frames
        std::deque<std::size_t> underway;  // bytes of frames that it has not seen
        std::size_t bytes_underway = 0;
        Clock::time_point progress;      // when it last saw one, or had none to see
        Clock::time_point fluent;        // since when it keeps up
        std::chrono::seconds trial{10};  // of keeping up, before it gets more
        bool is_ready() const;
    };

    void hear(const Heard& heard);
    void obey(std::uint64_t viewer, const ViewerMessage& message);
    void obey_driver(const ViewerMessage& message);
    void open(const ViewerMessage& message);
    void point(const PointerAt& at);
    void dismiss(std::uint64_t viewer, const std::string& reason);
    void leave(std::uint64_t viewer);
    void leave_wheel();
    template <typename Work>
    void attempt(const Work& work);
    void advance(double seconds);
    void look_after_stream();
    void tick();
    void count_sent();
    void promote(Viewer& viewer, Clock::time_point now);
    void send_state();
    std::string state() const;
    std::string welcome(std::uint64_t viewer) const;
    std::string shown_name() const;
    void drop_the_stuck();
    bool is_over() const;
    double step_seconds() const { return 1 / static_cast<double>(session_.world().settings().rate); }

    const ServeOptions& options_;
    Backend machine_;
    WebServer& server_;
    Session session_;
    Interaction interaction_;
    std::map<std::uint64_t, Viewer> viewers_;
    std::uint64_t driver_ = 0;  // 0: nobody
    std::optional<Session::Moment> kept_;
    std::string kept_scene_;

    std::mutex sent_mutex_;
    std::vector<std::pair<std::uint64_t, std::size_t>> sent_;  // frames: to whom, bytes; by the encoder
    std::unique_ptr<LiveStream> stream_;                       // after them: its thread uses them until it ends
    std::uint64_t streamed_beginning_ = 0;
    glm::vec3 streamed_gravity_{0};
    int streamed_substeps_ = 0;
    std::uint64_t every_ = 1;  // steps from frame to frame
    std::uint64_t told_step_ = 0, ticks_ = 0;
    std::size_t told_acts_ = 0;
    Clock::time_point told_at_{};
    bool frame_is_due_ = true;

    double debt_ = 0;      // s of simulated time that are due
    std::string trouble_;  // of a step that failed
    std::string told_state_;
    Clock::time_point stated_at_{};
    bool state_is_urgent_ = false;
    std::optional<std::uint64_t> last_step_;
    StreamFigures earlier_figures_;
    double real_pace_ = 0;  // simulated seconds a second, measured
    Clock::time_point paced_at_{};
    double paced_time_ = 0;
    Clock::time_point started_ = Clock::now();
};

}  // namespace scree::demos
