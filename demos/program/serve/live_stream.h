// A running world as blocks of a recording (demos/docs/guide/viewer.md) for viewers of different speeds.
//
// Every lane has its own encoder: all frames, every second, fourth or eighth one. A viewer that does not keep up moves to a
// slower lane, so nobody waits for it. Bodies and shapes are told to everyone, whatever the lane.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "demos/film/pages/chunk_bytes.h"
#include "demos/film/pages/frame_encoder.h"
#include "demos/film/pages/page_recording.h"
#include "demos/film/pages/world_chunks.h"
#include "host/canvas/camera.h"

namespace scree::demos {

struct StreamFigures {
    std::uint64_t frames = 0, bytes = 0;  // of frames, encoded once
    double seconds_encoding = 0, seconds_packing = 0, seconds_looking = 0;

    StreamFigures& operator+=(const StreamFigures& more) {
        frames += more.frames;
        bytes += more.bytes;
        seconds_encoding += more.seconds_encoding;
        seconds_packing += more.seconds_packing;
        seconds_looking += more.seconds_looking;
        return *this;
    }
};

class LiveStream {
public:
    static constexpr std::size_t lanes = 4;
    using Message = std::shared_ptr<const std::string>;
    // Which viewers get a lane's frame.
    struct Audience {
        std::size_t lane = 0;
        bool whole = false;  // somebody begins here
        std::vector<std::uint64_t> viewers;
    };
    // Called for each frame, before tick() returns or later in another thread.
    using Deliver = std::function<void(const std::vector<std::uint64_t>& viewers, Message frame)>;

    // Frames are `seconds` apart.
    LiveStream(World& world, PageOptions options, double seconds, Deliver deliver);
    ~LiveStream();
    LiveStream(const LiveStream&) = delete;
    LiveStream& operator=(const LiveStream&) = delete;

    // Whether the frame before is still being encoded. While it is, nothing may be sent that has to come after it. Throws what
    // its encoder threw, such as std::bad_alloc; the stream is then of no more use.
    bool is_busy();
    void wait();  // until it is not
    // What has appeared since the last call, as a block for all who know the rest; none.
    Message news(const World& world);
    // Everything but frames, for one who begins in this lane; and the head alone, for one who changes to it.
    Message beginning(std::size_t lane);
    Message head(std::size_t lane);
    // The present moment for these audiences. Not while busy.
    void tick(World& world, const std::vector<Audience>& audiences);
    StreamFigures figures();

private:
    struct Lane {
        double seconds = 0;  // from frame to frame
        FrameUnits units;
        std::unique_ptr<FrameEncoder> encoder;
        LevelTrack joints;
        WorldChunks::ContactsTold contacts;
        std::string head;
        ChunkBytes events;  // since its last frame
        std::size_t event_count = 0;
    };
    struct Moment {
        double seconds = 0;
        std::uint64_t step = 0;
        std::vector<BodyMoment> bodies;
        std::vector<float> joint_forces;
        BitRow broken;
        bool has_joints = false;
        std::optional<host::Camera> camera;
        std::vector<Audience> audiences;
    };
    void remember(const std::string& block);
    void encode(const World* world);
    void work();

    PageOptions options_;
    Deliver deliver_;
    WorldChunks chunks_;
    std::array<Lane, lanes> lane_;
    std::string bodies_, joints_;  // chunks so far, for those who come later
    Moment moment_;                // of the frame that is encoded
    std::mutex mutex_;
    std::condition_variable changed_;
    bool busy_ = false, ends_ = false;
    std::exception_ptr error_;  // of the encoder
    StreamFigures figures_;
    std::thread worker_;
};

}  // namespace scree::demos
