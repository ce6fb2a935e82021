// Common to all runners: counting uploaded bytes, so that tests can limit what an edit uploads, and timing transfers.
#include "compute/runner.h"

#include "compute/tables/table_ranges.h"
#include "compute/timeline.h"

namespace scree {

Timeline* Runner::timeline() const {
    return timeline_ && timeline_->wants_stages() ? timeline_.get() : nullptr;
}

void Runner::upload(const TableRanges& ranges) {
    const std::uint64_t bytes = bytes_of(ranges);
    uploaded_bytes_ += bytes;
    const Timeline::Time begin = Timeline::Clock::now();
    send(ranges);
    if (Timeline* told = timeline(); told && !in_place())
        told->slice(Timeline::caller, "upload", begin, Timeline::Clock::now(), {{"bytes", static_cast<double>(bytes)}});
}

void Runner::download(const TableRanges& ranges) {
    const Timeline::Time begin = Timeline::Clock::now();
    receive(ranges);
    if (Timeline* told = timeline(); told && !in_place())
        told->slice(Timeline::caller, "download", begin, Timeline::Clock::now(),
                    {{"bytes", static_cast<double>(bytes_of(ranges))}});
}

}  // namespace scree
