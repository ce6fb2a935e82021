// LZ4 blocks (https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md), and integers of crate files: differences of 0, 1, 2
// or 4 bytes, by codes of two bits.
#include "compute/scene_file/import/usd/crate_bytes.h"

#include <algorithm>

namespace scree::imports {

namespace {

void unpack_block(std::string_view packed, std::uint64_t size, std::string& out) {
    CrateCursor from(packed);
    const auto length_of = [&](unsigned nibble) {
        std::uint64_t length = nibble;
        if (nibble < 15) return length;
        std::uint8_t more = 255;
        while (more == 255) length += more = from.read<std::uint8_t>();
        return length;
    };
    while (from.left() > 0) {
        const auto token = from.read<std::uint8_t>();
        const std::string_view literal = from.take(length_of(token >> 4));
        if (out.size() + literal.size() > size) throw CrateError("a block is longer than it says");
        out.append(literal);
        if (from.left() == 0) return;
        const auto back = from.read<std::uint16_t>();
        const std::uint64_t length = 4 + length_of(token & 15);
        if (back == 0 || back > out.size()) throw CrateError("a block repeats bytes before its begin");
        if (out.size() + length > size) throw CrateError("a block is longer than it says");
        for (std::uint64_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);
    }
}

}  // namespace

std::size_t CrateCursor::count(std::uint64_t size) {
    const auto many = read<std::uint64_t>();
    if (many > left() / size) throw CrateError("a table is longer than the file");
    return static_cast<std::size_t>(many);
}

std::string unpacked_bytes(std::string_view packed, std::uint64_t size) {
    // No block shrinks to less than a 255th.
    if (size / 256 > packed.size() || size > std::uint64_t{1} << 30)
        throw CrateError("a block is longer than its bytes can make");
    CrateCursor from(packed);
    std::string out;
    out.reserve(static_cast<std::size_t>(size));
    const auto chunks = from.read<std::uint8_t>();
    if (chunks == 0) unpack_block(from.take(from.left()), size, out);
    for (int i = 0; i < chunks; ++i) {
        const auto length = from.read<std::int32_t>();
        if (length < 0) throw CrateError("a block has a negative length");
        unpack_block(from.take(static_cast<std::uint64_t>(length)), size, out);
    }
    return out;
}

std::vector<std::int64_t> unpacked_integers(CrateCursor& from, std::uint64_t count, bool wide) {
    if (count > most_crate_numbers) throw CrateError("an array or table has more than 50000000 elements");
    const std::string_view packed = from.take(from.read<std::uint64_t>());
    const std::uint64_t size = wide ? 8 : 4, codes = (2 * count + 7) / 8;
    std::vector<std::int64_t> all;
    if (count == 0) return all;
    // What is packed may be shorter than the most that it could take.
    if (codes / 256 > packed.size()) throw CrateError("an array is longer than its bytes can make");
    const std::uint64_t most = std::min<std::uint64_t>(size + codes + size * count, 255 * packed.size() + 16);
    const std::string bytes = unpacked_bytes(packed, most);
    CrateCursor head(bytes);
    const std::int64_t common = wide ? head.read<std::int64_t>() : head.read<std::int32_t>();
    const std::string_view kinds = head.take(codes);
    all.reserve(static_cast<std::size_t>(count));
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned kind = (static_cast<unsigned char>(kinds[static_cast<std::size_t>(i / 4)]) >> (2 * (i % 4))) & 3;
        std::int64_t step = common;
        if (kind == 1) step = wide ? head.read<std::int16_t>() : head.read<std::int8_t>();
        if (kind == 2) step = wide ? head.read<std::int32_t>() : head.read<std::int16_t>();
        if (kind == 3) step = wide ? head.read<std::int64_t>() : head.read<std::int32_t>();
        value += static_cast<std::uint64_t>(step);
        all.push_back(wide ? static_cast<std::int64_t>(value) : static_cast<std::int32_t>(static_cast<std::uint32_t>(value)));
    }
    return all;
}

}  // namespace scree::imports
