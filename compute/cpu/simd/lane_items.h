// What lanes take: the next items of a list, records chosen or copied lane by lane. For compute/cpu/simd/simd_stages.cpp, after
// the laws.
#pragma once

LAWS_BEGIN

namespace {

using reference::WideTables;

SCREE_INLINE Words lane_numbers() {
    Words numbers;
    for (int lane = 0; lane < lanes; ++lane) numbers[lane] = static_cast<std::uint32_t>(lane);
    return numbers;
}
// The next items; lanes beyond the end repeat the last one.
SCREE_INLINE Uint listed(const std::uint32_t* items, std::size_t first, std::size_t last) {
    Words found;
    if (last - first >= lanes) {
        __builtin_memcpy(&found, items + first, sizeof found);
    } else {
        for (int lane = 0; lane < lanes; ++lane) {
            const std::size_t item = first + static_cast<std::size_t>(lane);
            found[lane] = items[item < last ? item : last - 1];
        }
    }
    return found;
}
SCREE_INLINE Bool living(std::size_t first, std::size_t last) {
    return Uint(lane_numbers()) < Uint(static_cast<std::uint32_t>(last - first < lanes ? last - first : lanes));
}

// Prefetches the record at that index of a table: for the next group, while this one is computed.
template <typename Record>
SCREE_INLINE void prefetch(const std::uint32_t* table, std::uint32_t index) {
    constexpr std::size_t words = sizeof(Record) / sizeof(Words), bytes = words * sizeof *table;
    const char* const record = reinterpret_cast<const char*>(table + words * index);
    for (std::size_t at = 0; at < bytes; at += 64) __builtin_prefetch(record + at);
    __builtin_prefetch(record + bytes - 1);  // records begin anywhere in a line
}
// A Pair of the tables.
struct PairWords {
    std::uint32_t rows[2], pair_type, previous;
    SCREE_INLINE PairWords(const WideTables& tables, std::size_t index) {
        static_assert(sizeof(PairWords) == sizeof(Pair) / lanes);
        __builtin_memcpy(this, tables.pairs + sizeof(PairWords) / sizeof(std::uint32_t) * index, sizeof(PairWords));
    }
};

SCREE_INLINE Uint body_of(Uint row, const BodyProperties& properties) {
    return choose(is_part(properties), properties.owner, row);
}

// The image of B that A meets, of two rows whose bodies are `a` and `b`.
SCREE_INLINE Image image_met(const WideTables& tables, const BodyProperties& ta, const Indices& a, const BodyProperties& tb,
                             const Indices& b, const Parameters& p) {
    return image_of_b(ta, tb, gather<Pose>(tables.poses, b).position - gather<Pose>(tables.poses, a).position, p);
}

// Of each lane the record of one or the other.
template <typename Record>
SCREE_INLINE Record choose_record(Bool condition, const Record& a, const Record& b) {
    Record chosen;
    for (std::size_t word = 0; word < sizeof(Record) / sizeof(Words); ++word) {
        AnyWords of_a, of_b;
        __builtin_memcpy(&of_a, reinterpret_cast<const AnyWords*>(&a) + word, sizeof of_a);
        __builtin_memcpy(&of_b, reinterpret_cast<const AnyWords*>(&b) + word, sizeof of_b);
        reinterpret_cast<AnyWords*>(&chosen)[word] = condition.v ? of_a : of_b;
    }
    return chosen;
}
// By vectors: of a record this long compilers make a string instruction.
template <typename Record>
SCREE_INLINE void copy_record(Record& to, const Record& from) {
#pragma GCC unroll 64
    for (std::size_t word = 0; word < sizeof(Record) / sizeof(Words); ++word)
        reinterpret_cast<AnyWords*>(&to)[word] = reinterpret_cast<const AnyWords*>(&from)[word];
}

}  // namespace

LAWS_END
