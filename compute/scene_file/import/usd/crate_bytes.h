// The bytes of a crate file: bounded reading, LZ4 blocks and its coding of integers.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace scree::imports {

struct CrateError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// A place in bytes; reading beyond their end throws CrateError. Little-endian, as the file.
class CrateCursor {
public:
    explicit CrateCursor(std::string_view bytes, std::uint64_t at = 0) : bytes_(bytes) { seek(at); }
    void seek(std::uint64_t at) {
        if (at > bytes_.size()) throw CrateError("an offset lies beyond the end");
        at_ = static_cast<std::size_t>(at);
    }
    std::uint64_t at() const { return at_; }
    std::uint64_t left() const { return bytes_.size() - at_; }
    std::string_view take(std::uint64_t count) {
        if (count > left()) throw CrateError("it ends within a value");
        const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(count));
        at_ += static_cast<std::size_t>(count);
        return taken;
    }
    template <class T>
    T read() {
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    // Of elements that take at least `size` bytes each.
    std::size_t count(std::uint64_t size = 1);

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

constexpr std::uint64_t most_crate_numbers = 50'000'000;  // of an array or a table

// Of blocks that make at most `size` bytes.
std::string unpacked_bytes(std::string_view packed, std::uint64_t size);
// Integers of 4 or 8 bytes, whose packed size stands before them.
std::vector<std::int64_t> unpacked_integers(CrateCursor& from, std::uint64_t count, bool wide);

}  // namespace scree::imports
