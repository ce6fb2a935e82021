// Motion blur: the poses of past steps, and those between them.
#include "demos/film/motion_blur.h"

#include <algorithm>

namespace scree::demos {

namespace {

physics::Pose between(const physics::Pose& a, const physics::Pose& b, float part) {
    physics::Pose pose = b;
    pose.position = a.position + part * (b.position - a.position);
    const vec4 to = glm::dot(a.orientation, b.orientation) < 0 ? -b.orientation : b.orientation;
    pose.orientation = glm::normalize(a.orientation + part * (to - a.orientation));
    return pose;
}

}  // namespace

void PastPoses::keep(const World& world) {
    if (arrangements_ != world.arrangements()) moments_.clear();
    arrangements_ = world.arrangements();
    if (!moments_.empty() && moments_.back().time >= world.time()) return;
    Moment moment;
    // The oldest one whose next is old enough for the whole span gives its memory.
    while (moments_.size() > 1 && moments_[1].time <= world.time() - span_) {
        moment = std::move(moments_.front());
        moments_.pop_front();
    }
    moment.time = world.time();
    moment.poses = world.state().poses;
    moments_.push_back(std::move(moment));
}

const std::vector<physics::Pose>& PastPoses::at(double before) {
    const double time = moments_.back().time - before;
    const auto later = std::find_if(moments_.begin(), moments_.end(), [&](const Moment& m) { return m.time >= time; });
    if (later == moments_.begin()) return later->poses;
    const Moment &a = *std::prev(later), &b = *later;
    const auto part = static_cast<float>((time - a.time) / (b.time - a.time));
    between_.resize(b.poses.size());
    for (std::size_t i = 0; i < between_.size(); ++i) between_[i] = between(a.poses[i], b.poses[i], part);
    return between_;
}

}  // namespace scree::demos
