// Times of a queue's own clock on the host's.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "compute/timeline.h"

namespace scree {

// What ran on the queue did so between its submission and the moment when the host saw its end. The offset between the clocks
// is the one before wherever that agrees, so that distances between submissions are the device's own.
class QueueClock {
public:
    // `device`: timestamps of one submission, s, in order.
    std::vector<Timeline::Time> place(const std::vector<double>& device, Timeline::Time submitted, Timeline::Time ended) {
        if (device.empty() || device.back() < device.front()) return {};  // the clock began anew
        const double least = seconds(submitted) - device.front(), most = seconds(ended) - device.back();
        double offset = std::clamp(offset_.value_or(least), std::min(least, most), most);
        if (offset_ && offset + device.front() < last_) offset = last_ - device.front();  // not into the submission before
        offset_ = offset;
        last_ = offset + device.back();
        std::vector<Timeline::Time> placed;
        for (const double at : device)
            placed.push_back(origin_ +
                             std::chrono::duration_cast<Timeline::Clock::duration>(std::chrono::duration<double>(offset + at)));
        return placed;
    }

private:
    double seconds(Timeline::Time time) const { return std::chrono::duration<double>(time - origin_).count(); }

    Timeline::Time origin_ = Timeline::Clock::now();
    std::optional<double> offset_;
    double last_ = 0;  // s, end of the last submission, on the host's clock
};

}  // namespace scree
