// Records as bytes in messages between ranks, which are processors of one kind.
#pragma once

#include <cstring>
#include <type_traits>

#include "compute/distributed/exchange.h"

namespace scree {

template <class Record>
void put(Bytes& bytes, const Record& record) {
    static_assert(std::is_trivially_copyable_v<Record>);
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof record);
    std::memcpy(&bytes[at], &record, sizeof record);
}

// Takes records out of a message in the order in which they were put.
class Unpacker {
public:
    explicit Unpacker(const Bytes& bytes) : bytes_(bytes) {}
    bool has_more() const { return at_ < bytes_.size(); }
    template <class Record>
    Record take() {
        Record record;
        take(record);
        return record;
    }
    template <class Record>
    Record& take(Record& record) {
        static_assert(std::is_trivially_copyable_v<Record>);
        if (at_ + sizeof record > bytes_.size()) throw RankLost("a message from another rank is too short");
        std::memcpy(static_cast<void*>(&record), &bytes_[at_], sizeof record);
        at_ += sizeof record;
        return record;
    }

private:
    const Bytes& bytes_;
    std::size_t at_ = 0;
};

}  // namespace scree
