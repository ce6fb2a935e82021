// Resolution of a window's pictures.
#include "demos/program/window/detail.h"

namespace scree::demos {

namespace {

constexpr double slow = 0.075;  // s for a picture: slower, and ten a second with their steps are out of reach
constexpr int settling = 4;     // pictures at a level before its time counts

}  // namespace

bool PictureDetail::drawn(double seconds, bool moves) {
    if (!adapts_) return false;
    // What stands still is drawn finely.
    still_ = moves ? 0 : still_ + 1;
    if (still_ > settling) {
        const bool changes = level_ != 0;
        level_ = 0;
        count_ = 0;
        return changes;
    }
    mean_ = count_ == 0 ? seconds : mean_ + 0.3 * (seconds - mean_);
    if (++count_ < settling) return false;
    int next = level_;
    if (mean_ > slow && level_ + 1 < levels) next = level_ + 1;
    if (level_ > 0) {
        // The cost of a picture grows at most with its pixels.
        const double ratio = static_cast<double>(divisors[level_]) / static_cast<double>(divisors[level_ - 1]);
        if (mean_ * ratio * ratio < 0.7 * slow) next = level_ - 1;
    }
    if (next == level_) return false;
    level_ = next;
    count_ = 0;
    return true;
}

}  // namespace scree::demos
