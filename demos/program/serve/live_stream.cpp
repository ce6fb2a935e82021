// Frames of a running world, encoded and packed beside the simulation.
#include "demos/program/serve/live_stream.h"

#include <chrono>
#include <cstring>
#include <utility>

#include "demos/film/pages/page_parts.h"

namespace scree::demos {

namespace {

using Clock = std::chrono::steady_clock;

// From so many bodies on frames may come near to what a viewer is to be sent. Then they are short for a while.
constexpr std::size_t crowd = 20'000;
constexpr double most_bytes_a_second = 20e6;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

LiveStream::Message shared(std::string bytes) {
    return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace

LiveStream::LiveStream(World& world, PageOptions options, double seconds, Deliver deliver)
    : options_(std::move(options)), deliver_(std::move(deliver)), chunks_(options_.shown) {
    for (std::size_t i = 0; i < lanes; ++i) {
        const double apart = seconds * static_cast<double>(std::size_t{1} << i);
        lane_[i].seconds = apart;
        lane_[i].units = units_of(world, options_, apart, world.scene().bodies.size() >= crowd);
        lane_[i].encoder = std::make_unique<FrameEncoder>(lane_[i].units);
        ChunkBytes told;
        told.bytes = head_of(world, options_, lane_[i].units, apart, 0);
        append_chunk(lane_[i].head, "head", told);
    }
    if (options_.events) world.take_events();  // of the time before
    news(world);
    worker_ = std::thread([this] { work(); });
}

LiveStream::~LiveStream() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    worker_.join();
}

// Joints are told anew when there are more; bodies and meshes add to those before.
void LiveStream::remember(const std::string& block) {
    for (std::size_t at = 0; at < block.size();) {
        std::uint32_t length = 0;
        for (std::size_t k = 0; k < 4; ++k)
            length |= static_cast<std::uint32_t>(static_cast<unsigned char>(block[at + 4 + k])) << (8 * k);
        const std::string chunk = block.substr(at, 8 + length);
        if (chunk.starts_with("join"))
            joints_ = chunk;
        else
            bodies_ += chunk;
        at += chunk.size();
    }
}

LiveStream::Message LiveStream::news(const World& world) {
    std::string block;
    chunks_.take_new(block, world);
    if (block.empty()) return nullptr;
    remember(block);
    return shared(packed_block(block));
}

LiveStream::Message LiveStream::beginning(std::size_t lane) {
    return shared(packed_block(lane_[lane].head + bodies_ + joints_));
}

LiveStream::Message LiveStream::head(std::size_t lane) {
    return shared(packed_block(lane_[lane].head));
}

bool LiveStream::is_busy() {
    const std::lock_guard lock(mutex_);
    if (error_) std::rethrow_exception(error_);
    return busy_;
}

void LiveStream::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !busy_; });
}

void LiveStream::tick(World& world, const std::vector<Audience>& audiences) {
    const auto begun = Clock::now();
    if (options_.events) {
        ChunkBytes events;
        const std::size_t count = add_events(events, world, chunks_, 0);
        for (Lane& lane : lane_) {
            if (lane.event_count > 1000) lane.events = {}, lane.event_count = 0;  // nobody is there
            lane.events.append(events);
            lane.event_count += count;
        }
    }
    if (audiences.empty()) return;
    moment_.seconds = world.time();
    moment_.step = world.steps();
    moment_.bodies = chunks_.look(world);
    moment_.audiences = audiences;
    moment_.joint_forces.clear();
    moment_.broken = {};
    moment_.has_joints = !world.scene().joints.empty();
    if (moment_.has_joints)
        for (std::size_t j = 0; const JointState& joint : world.joints()) {
            const bool has_place = !std::holds_alternative<Coupling>(world.scene().joints[j++].kind);
            moment_.joint_forces.push_back(glm::length(joint.force));
            moment_.broken.add(joint.broken || !has_place);
        }
    moment_.camera.reset();
    if (options_.camera) moment_.camera = options_.camera(world.time());
    {
        const std::lock_guard lock(mutex_);
        figures_.seconds_looking += seconds_since(begun);
        busy_ = !options_.contacts;
    }
    if (options_.contacts)
        encode(&world);  // contacts are asked of the world, which must not step meanwhile
    else
        changed_.notify_all();
}

void LiveStream::work() {
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return busy_ || ends_; });
            if (!busy_) return;
        }
        std::exception_ptr error;
        try {
            encode(nullptr);
        } catch (...) {
            error = std::current_exception();
        }
        {
            const std::lock_guard lock(mutex_);
            error_ = error;
            busy_ = false;
        }
        changed_.notify_all();
    }
}

void LiveStream::encode(const World* world) {
    for (const Audience& audience : moment_.audiences) {
        Lane& lane = lane_[audience.lane];
        const auto begun = Clock::now();
        ChunkBytes frame;
        frame.f64(moment_.seconds);
        frame.count(moment_.step);
        frame.u8((audience.whole ? 1u : 0u) | (world ? 2u : 0u) | (moment_.has_joints ? 4u : 0u) | (moment_.camera ? 8u : 0u));
        lane.encoder->encode(frame, moment_.bodies, audience.whole);
        if (world) {
            chunks_.exchange_told(lane.contacts);
            chunks_.add_contacts(frame, *world, lane.units, lane.encoder->followers(), audience.whole);
            chunks_.exchange_told(lane.contacts);
        }
        if (moment_.has_joints) {
            frame.count(moment_.joint_forces.size());
            frame.part(moment_.broken.row);
            lane.joints.encode(frame, moment_.joint_forces, lane.units.force, audience.whole);
        }
        if (moment_.camera) {
            frame.vector(moment_.camera->eye);
            frame.vector(moment_.camera->target);
            frame.f32(moment_.camera->vertical_fov);
            frame.u8(moment_.camera->orthographic ? 1 : 0);
        }
        std::string block;
        if (lane.event_count > 0) {
            ChunkBytes events;
            events.count(lane.event_count);
            events.append(lane.events);
            append_chunk(block, "evnt", events);
            lane.events = {};
            lane.event_count = 0;
        }
        append_chunk(block, "fram", frame);
        const double encoding = seconds_since(begun);
        const auto packing = Clock::now();
        const Message message = shared(packed_frame(block));
        if (lane.units.crowd) {
            const double part = static_cast<double>(message->size()) / (most_bytes_a_second * lane.seconds);
            lane.encoder->set_short(part > (lane.encoder->is_short() ? 0.6 : 0.85));
        }
        {
            const std::lock_guard lock(mutex_);
            ++figures_.frames;
            figures_.bytes += message->size();
            figures_.seconds_encoding += encoding;
            figures_.seconds_packing += seconds_since(packing);
        }
        deliver_(audience.viewers, message);
    }
}

StreamFigures LiveStream::figures() {
    const std::lock_guard lock(mutex_);
    return figures_;
}

}  // namespace scree::demos
