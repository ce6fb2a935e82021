// Common to all runners: counting uploaded bytes, so that tests can limit what an edit uploads.
#include "compute/runner.h"

#include "compute/step/table_ranges.h"

namespace scree {

void Runner::upload(const TableRanges& ranges) {
    uploaded_bytes_ += bytes_of(ranges);
    send(ranges);
}

void Runner::download(const TableRanges& ranges) {
    receive(ranges);
}

}  // namespace scree
