// Bytes of the chunks of a recording (demos/docs/guide/viewer.md): little-endian numbers, variable-length integers, texts.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

namespace scree::demos {

class ChunkBytes {
public:
    void u8(std::uint32_t value) { bytes.push_back(static_cast<char>(value & 255u)); }
    void u32(std::uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8) u8(value >> shift);
    }
    void f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }
    void f64(double value) {
        const auto word = std::bit_cast<std::uint64_t>(value);
        u32(static_cast<std::uint32_t>(word));
        u32(static_cast<std::uint32_t>(word >> 32));
    }
    void vector(glm::vec3 value) {
        for (glm::length_t i = 0; i < 3; ++i) f32(value[i]);
    }
    // Seven bits a byte, low ones first; the high bit says that more follow.
    void count(std::uint64_t value) {
        for (; value > 127; value >>= 7) u8(static_cast<std::uint32_t>(value & 127u) | 128u);
        u8(static_cast<std::uint32_t>(value));
    }
    // Likewise of 2 n for n >= 0 and of -2 n - 1 below.
    void integer(std::int32_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        count((bits << 1) ^ (value < 0 ? 0xFFFFFFFFu : 0u));
    }
    void text(std::string_view value) {
        count(value.size());
        bytes.append(value);
    }
    void append(const ChunkBytes& other) { bytes += other.bytes; }
    // A part that readers may pass over: its length, then its bytes.
    void part(const ChunkBytes& other) { text(other.bytes); }

    std::string bytes;
};

// A bit for each of a row of things, low bits first.
class BitRow {
public:
    void add(bool on) {
        if (used_ % 8 == 0) row.u8(0);
        if (on) row.bytes.back() = static_cast<char>(row.bytes.back() | (1 << (used_ % 8)));
        ++used_;
    }
    ChunkBytes row;

private:
    std::size_t used_ = 0;
};

// A chunk of a block: a name of four letters, the length of what follows, and that.
inline void append_chunk(std::string& block, std::string_view name, const ChunkBytes& content) {
    ChunkBytes head;
    head.bytes = name;
    head.u32(static_cast<std::uint32_t>(content.bytes.size()));
    block += head.bytes;
    block += content.bytes;
}

}  // namespace scree::demos
