// Values as bytes and back, for checkpoints. The bytes of a number are those of memory: little-endian processors only.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "compute/checkpoint.h"

namespace scree {

static_assert(std::endian::native == std::endian::little);

class ByteWriter {
public:
    ByteWriter() = default;
    explicit ByteWriter(std::vector<std::byte>&& memory) : bytes_(std::move(memory)) { bytes_.clear(); }  // used again

    template <class Value>
    void put(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        put_bytes(std::as_bytes(std::span(&value, 1)));
    }
    void put_bytes(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
    // With their number in front.
    template <class Value>
    void put_list(std::span<const Value> values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        put(std::uint64_t{values.size()});
        put_bytes(std::as_bytes(values));
    }
    void put_text(std::string_view text) { put_list(std::span(text.data(), text.size())); }

    void reserve(std::size_t bytes) { bytes_.reserve(bytes_.size() + bytes); }
    std::vector<std::byte>& bytes() { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

// Throws CheckpointError where bytes are missing.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}

    template <class Value>
    Value take() {
        static_assert(std::is_trivially_copyable_v<Value>);
        if constexpr (std::is_same_v<Value, bool>) return take<std::uint8_t>() != 0;  // any other byte is no bool
        Value value;
        std::memcpy(&value, take_bytes(sizeof value).data(), sizeof value);
        return value;
    }
    std::span<const std::byte> take_bytes(std::size_t count) {
        if (count > left_.size()) throw CheckpointError("the checkpoint is damaged: a list is longer than the rest of it");
        const auto taken = left_.first(count);
        left_ = left_.subspan(count);
        return taken;
    }
    // The bytes of a list of `record_bytes` each.
    std::span<const std::byte> take_records(std::size_t record_bytes) {
        const auto count = take<std::uint64_t>();
        if (count > left_.size() / record_bytes)
            throw CheckpointError("the checkpoint is damaged: a list is longer than the rest of it");
        return take_bytes(static_cast<std::size_t>(count) * record_bytes);
    }
    template <class Value>
    std::vector<Value> take_list() {
        static_assert(std::is_trivially_copyable_v<Value>);
        const auto bytes = take_records(sizeof(Value));
        std::vector<Value> values(bytes.size() / sizeof(Value));
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    std::string take_text() {
        const auto bytes = take_records(1);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    std::span<const std::byte> rest() const { return left_; }
    bool at_end() const { return left_.empty(); }

private:
    std::span<const std::byte> left_;
};

}  // namespace scree
