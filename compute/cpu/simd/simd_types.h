// SIMD types in which the laws are compiled for SCREE_LANES bodies, pairs, contacts or joints at once: one per lane.
//
// Every lane does what scalar code does for one of them, in the same order, and + - * round in a lane as in a float: so
// the bits are the same. The words of a record stay in order, so a record of lanes is the transpose of as many records,
// and gather() and scatter() need not know any record.
//
// Files that include this are compiled for processors that not everyone has. No function of them may be shared with
// other files, or the linker might choose the copy that does not run here: so all functions are force-inlined, the
// namespace is separate, and the standard library is not included.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#define SCREE_INLINE __attribute__((always_inline)) inline
#define SCREE_JOINED(a, b) a##b
#define SCREE_NAMED(lanes) SCREE_JOINED(lanes_, lanes)
#define LAWS_BEGIN namespace scree::SCREE_NAMED(SCREE_LANES) {
#define LAWS_END }
#define LAW SCREE_INLINE
#define CONSTANT inline constexpr

LAWS_BEGIN

inline constexpr int lanes = SCREE_LANES;
using Floats [[gnu::vector_size(4 * SCREE_LANES)]] = float;
using Words [[gnu::vector_size(4 * SCREE_LANES)]] = uint32_t;
using AnyWords [[gnu::vector_size(4 * SCREE_LANES), gnu::may_alias]] = uint32_t;  // may alias any type
using Masks [[gnu::vector_size(4 * SCREE_LANES)]] = int32_t;

// Broadcast.
template <typename Vector, typename Item>
SCREE_INLINE constexpr Vector all(Item x) {
#if SCREE_LANES == 4
    return Vector{x, x, x, x};
#elif SCREE_LANES == 8
    return Vector{x, x, x, x, x, x, x, x};
#else
    return Vector{x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x};
#endif
}

struct Bool {
    Masks v;  // 0 or -1
    Bool() = default;
    SCREE_INLINE constexpr Bool(Masks mask) : v(mask) {}
    SCREE_INLINE constexpr Bool(bool x) : v(all<Masks>(x ? -1 : 0)) {}
    friend SCREE_INLINE Bool operator!(Bool a) { return ~a.v; }
    friend SCREE_INLINE Bool operator&&(Bool a, Bool b) { return a.v & b.v; }
    friend SCREE_INLINE Bool operator||(Bool a, Bool b) { return a.v | b.v; }
};
SCREE_INLINE bool none(Bool a) {
    int32_t any = 0;
    for (int lane = 0; lane < lanes; ++lane) any |= a.v[lane];
    if (__builtin_constant_p(any)) return any == 0;  // an intrinsic would not fold
#if defined(__AVX512F__) && SCREE_LANES == 16
    return _mm512_test_epi32_mask((__m512i)a.v, (__m512i)a.v) == 0;
#elif defined(__AVX2__) && SCREE_LANES == 8
    return _mm256_testz_si256((__m256i)a.v, (__m256i)a.v) != 0;
#elif defined(__SSE2__) && SCREE_LANES == 4
    return _mm_movemask_ps((__m128)a.v) == 0;
#else
    return any == 0;
#endif
}

struct Float;
struct Uint {
    Words v;
    Uint() = default;
    SCREE_INLINE constexpr Uint(Words words) : v(words) {}
    SCREE_INLINE constexpr Uint(uint32_t x) : v(all<Words>(x)) {}
    SCREE_INLINE constexpr explicit Uint(int x) : Uint(static_cast<uint32_t>(x)) {}
    SCREE_INLINE explicit Uint(Float x);  // from 0 to below 2^31
    friend SCREE_INLINE Uint operator+(Uint a, Uint b) { return a.v + b.v; }
    friend SCREE_INLINE Uint operator-(Uint a, Uint b) { return a.v - b.v; }
    friend SCREE_INLINE Uint operator&(Uint a, Uint b) { return a.v & b.v; }
    friend SCREE_INLINE Uint operator|(Uint a, Uint b) { return a.v | b.v; }
    friend SCREE_INLINE Uint operator^(Uint a, Uint b) { return a.v ^ b.v; }
    friend SCREE_INLINE Uint operator~(Uint a) { return ~a.v; }
    friend SCREE_INLINE Uint operator*(Uint a, Uint b) { return a.v * b.v; }
    friend SCREE_INLINE Uint operator<<(Uint a, uint32_t by) { return a.v << by; }
    friend SCREE_INLINE Uint operator<<(Uint a, Uint by) { return a.v << by.v; }
    friend SCREE_INLINE Uint operator>>(Uint a, uint32_t by) { return a.v >> by; }
    friend SCREE_INLINE Uint operator>>(Uint a, Uint by) { return a.v >> by.v; }
    friend SCREE_INLINE Bool operator==(Uint a, Uint b) { return a.v == b.v; }
    friend SCREE_INLINE Bool operator!=(Uint a, Uint b) { return a.v != b.v; }
    friend SCREE_INLINE Bool operator<(Uint a, Uint b) { return a.v < b.v; }
    friend SCREE_INLINE Bool operator>(Uint a, Uint b) { return a.v > b.v; }
    friend SCREE_INLINE Bool operator<=(Uint a, Uint b) { return a.v <= b.v; }
    friend SCREE_INLINE Bool operator>=(Uint a, Uint b) { return a.v >= b.v; }
};

struct Float {
    Floats v;
    Float() = default;
    SCREE_INLINE constexpr Float(Floats floats) : v(floats) {}
    SCREE_INLINE constexpr Float(float x) : v(all<Floats>(x)) {}
    SCREE_INLINE explicit Float(Uint x) : v(__builtin_convertvector((Masks)x.v, Floats)) {}  // below 2^31
    friend SCREE_INLINE Float operator+(Float a, Float b) { return a.v + b.v; }
    friend SCREE_INLINE Float operator-(Float a, Float b) { return a.v - b.v; }
    friend SCREE_INLINE Float operator*(Float a, Float b) { return a.v * b.v; }
    friend SCREE_INLINE Float operator-(Float a) { return -a.v; }
    friend SCREE_INLINE Bool operator==(Float a, Float b) { return a.v == b.v; }
    friend SCREE_INLINE Bool operator!=(Float a, Float b) { return a.v != b.v; }
    friend SCREE_INLINE Bool operator<(Float a, Float b) { return a.v < b.v; }
    friend SCREE_INLINE Bool operator>(Float a, Float b) { return a.v > b.v; }
    friend SCREE_INLINE Bool operator<=(Float a, Float b) { return a.v <= b.v; }
    friend SCREE_INLINE Bool operator>=(Float a, Float b) { return a.v >= b.v; }
};
SCREE_INLINE Uint::Uint(Float x) : v((Words) __builtin_convertvector(x.v, Masks)) {}
SCREE_INLINE Uint floatBitsToUint(Float a) {
    return (Words)a.v;
}
SCREE_INLINE Float uintBitsToFloat(Uint a) {
    return (Floats)a.v;
}
SCREE_INLINE Float abs(Float a) {
    return uintBitsToFloat(floatBitsToUint(a) & 0x7FFFFFFFu);
}

SCREE_INLINE Uint choose(Bool condition, Uint a, Uint b) {
    return condition.v ? a.v : b.v;
}
SCREE_INLINE Uint choose(Bool condition, uint32_t a, uint32_t b) {
    return choose(condition, Uint(a), Uint(b));
}
SCREE_INLINE Float choose(Bool condition, Float a, Float b) {
    return condition.v ? a.v : b.v;
}
SCREE_INLINE Float choose(Bool condition, float a, float b) {
    return choose(condition, Float(a), Float(b));
}

// The greatest integer that is not above x, in two's complement; for |x| below 2^31.
SCREE_INLINE Uint whole(Float x) {
    const Masks towards_zero = __builtin_convertvector(x.v, Masks);
    return (Words)(towards_zero + (__builtin_convertvector(towards_zero, Floats) > x.v));  // true is -1
}

struct vec3 {
    Float x, y, z;
    vec3() = default;
    SCREE_INLINE explicit vec3(Float a) : x(a), y(a), z(a) {}
    SCREE_INLINE vec3(Float a, Float b, Float c) : x(a), y(b), z(c) {}
    friend SCREE_INLINE vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend SCREE_INLINE vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend SCREE_INLINE vec3 operator*(vec3 a, Float b) { return {a.x * b, a.y * b, a.z * b}; }
    friend SCREE_INLINE vec3 operator*(vec3 a, vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend SCREE_INLINE vec3 operator-(vec3 a) { return {-a.x, -a.y, -a.z}; }
};
struct vec4 {
    Float x, y, z, w;
    vec4() = default;
    SCREE_INLINE explicit vec4(Float a) : x(a), y(a), z(a), w(a) {}
    SCREE_INLINE vec4(Float a, Float b, Float c, Float d) : x(a), y(b), z(c), w(d) {}
    SCREE_INLINE vec4(vec3 a, Float b) : x(a.x), y(a.y), z(a.z), w(b) {}
    SCREE_INLINE Float& operator[](int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
    SCREE_INLINE Float operator[](int i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
    friend SCREE_INLINE vec4 operator-(vec4 a, vec4 b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
    friend SCREE_INLINE vec4 operator+(vec4 a, vec4 b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
    friend SCREE_INLINE vec4 operator*(vec4 a, Float b) { return {a.x * b, a.y * b, a.z * b, a.w * b}; }
    friend SCREE_INLINE vec4 operator-(vec4 a) { return {-a.x, -a.y, -a.z, -a.w}; }
};
struct uvec4 {
    Uint x, y, z, w;
    uvec4() = default;
    SCREE_INLINE explicit uvec4(Uint a) : x(a), y(a), z(a), w(a) {}
    SCREE_INLINE Uint& operator[](int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
    SCREE_INLINE Uint operator[](int i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
};
struct ivec3 {
    Uint x, y, z;  // in two's complement
    SCREE_INLINE ivec3(Uint a, Uint b, Uint c) : x(a), y(b), z(c) {}
};
SCREE_INLINE vec3 choose(Bool c, vec3 a, vec3 b) {
    return {choose(c, a.x, b.x), choose(c, a.y, b.y), choose(c, a.z, b.z)};
}
SCREE_INLINE vec4 choose(Bool c, vec4 a, vec4 b) {
    return {choose(c, a.x, b.x), choose(c, a.y, b.y), choose(c, a.z, b.z), choose(c, a.w, b.w)};
}
using uint = Uint;

// ---- records in memory
using Quad [[gnu::vector_size(16)]] = uint32_t;  // four words of one record
struct [[gnu::may_alias]] Block {                // four words of as many records as there are lanes
    Words words[4];
};

SCREE_INLINE Quad quad_at(const uint32_t* words) {
    Quad quad;
    __builtin_memcpy(&quad, words, sizeof quad);
    return quad;
}

#if SCREE_LANES == 4
SCREE_INLINE Words joined(const Quad* every_fourth) {
    return every_fourth[0];
}
SCREE_INLINE Quad quarter(Words words, int) {
    return words;
}
#define SCREE_PICK(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#define SCREE_OF_B 4
#elif SCREE_LANES == 8
SCREE_INLINE Words joined(const Quad* every_fourth) {
    return __builtin_shufflevector(every_fourth[0], every_fourth[4], 0, 1, 2, 3, 4, 5, 6, 7);
}
SCREE_INLINE Quad quarter(Words words, int which) {
    return which == 0 ? __builtin_shufflevector(words, words, 0, 1, 2, 3) : __builtin_shufflevector(words, words, 4, 5, 6, 7);
}
#define SCREE_PICK(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4)
#define SCREE_OF_B 8
#else
SCREE_INLINE Words joined(const Quad* every_fourth) {
    using Eight [[gnu::vector_size(32)]] = uint32_t;
    const Eight low = __builtin_shufflevector(every_fourth[0], every_fourth[4], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight high = __builtin_shufflevector(every_fourth[8], every_fourth[12], 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
SCREE_INLINE Quad quarter(Words words, int which) {
    switch (which) {
        case 0:
            return __builtin_shufflevector(words, words, 0, 1, 2, 3);
        case 1:
            return __builtin_shufflevector(words, words, 4, 5, 6, 7);
        case 2:
            return __builtin_shufflevector(words, words, 8, 9, 10, 11);
        default:
            return __builtin_shufflevector(words, words, 12, 13, 14, 15);
    }
}
#define SCREE_PICK(a, b, i, j, k, l)                                                                                          \
    __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4, i + 8, j + 8, k + 8, l + 8, i + 12, j + 12, k + 12, \
                            l + 12)
#define SCREE_OF_B 16
#endif

// Transposes 4x4 blocks of lanes; an involution.
SCREE_INLINE Block transposed(Block b) {
    const Words ab_low = SCREE_PICK(b.words[0], b.words[1], 0, SCREE_OF_B, 1, SCREE_OF_B + 1);
    const Words ab_high = SCREE_PICK(b.words[0], b.words[1], 2, SCREE_OF_B + 2, 3, SCREE_OF_B + 3);
    const Words cd_low = SCREE_PICK(b.words[2], b.words[3], 0, SCREE_OF_B, 1, SCREE_OF_B + 1);
    const Words cd_high = SCREE_PICK(b.words[2], b.words[3], 2, SCREE_OF_B + 2, 3, SCREE_OF_B + 3);
    return {{SCREE_PICK(ab_low, cd_low, 0, 1, SCREE_OF_B, SCREE_OF_B + 1),
             SCREE_PICK(ab_low, cd_low, 2, 3, SCREE_OF_B + 2, SCREE_OF_B + 3),
             SCREE_PICK(ab_high, cd_high, 0, 1, SCREE_OF_B, SCREE_OF_B + 1),
             SCREE_PICK(ab_high, cd_high, 2, 3, SCREE_OF_B + 2, SCREE_OF_B + 3)}};
}

// The record index of each lane.
inline constexpr uint32_t nowhere = 0xFFFFFFFFu;
struct Indices {
    uint32_t of[SCREE_LANES];
    SCREE_INLINE explicit Indices(Uint indices) { __builtin_memcpy(of, &indices, sizeof of); }
    // `nowhere` in the lanes not in `those`.
    SCREE_INLINE Indices only(Bool those) const {
        Words words;
        __builtin_memcpy(&words, of, sizeof of);
        return Indices(choose(those, Uint(words), Uint(nowhere)));
    }
};

#if SCREE_LANES >= 8
// Eight words of each record at once: two blocks, in half as many loads and stores.
using Row [[gnu::vector_size(32)]] = uint32_t;
struct [[gnu::may_alias]] TwoBlocks {
    Block first, second;
};
SCREE_INLINE Row row_at(const uint32_t* words) {
    Row row;
    __builtin_memcpy(&row, words, sizeof row);
    return row;
}
#if SCREE_LANES == 8
#define SCREE_ROWS(place, i) row_at(place(i))
#define SCREE_EVEN 0, 1, 2, 3, 8, 9, 10, 11
#define SCREE_ODD 4, 5, 6, 7, 12, 13, 14, 15
#define SCREE_FRONT SCREE_EVEN
#define SCREE_BACK SCREE_ODD
#else
#define SCREE_ROWS(place, i)                                                                                                  \
    __builtin_shufflevector(row_at(place(2 * i - i % 4)), row_at(place(2 * i - i % 4 + 4)), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, \
                            11, 12, 13, 14, 15)
#define SCREE_EVEN 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27
#define SCREE_ODD 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31
#define SCREE_FRONT 0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23
#define SCREE_BACK 8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31
#endif
// `place(lane)`: where the eight words of its record are.
template <typename Place>
SCREE_INLINE TwoBlocks gather_rows(const Place& place) {
    const Block front = transposed({{SCREE_ROWS(place, 0), SCREE_ROWS(place, 1), SCREE_ROWS(place, 2), SCREE_ROWS(place, 3)}});
    const Block back = transposed({{SCREE_ROWS(place, 4), SCREE_ROWS(place, 5), SCREE_ROWS(place, 6), SCREE_ROWS(place, 7)}});
    TwoBlocks found;
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
        found.first.words[k] = __builtin_shufflevector(front.words[k], back.words[k], SCREE_EVEN);
        found.second.words[k] = __builtin_shufflevector(front.words[k], back.words[k], SCREE_ODD);
    }
    return found;
}
template <typename Place>
SCREE_INLINE void scatter_rows(const TwoBlocks& blocks, const Place& place) {
    Block front, back;
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
        front.words[k] = __builtin_shufflevector(blocks.first.words[k], blocks.second.words[k], SCREE_FRONT);
        back.words[k] = __builtin_shufflevector(blocks.first.words[k], blocks.second.words[k], SCREE_BACK);
    }
    front = transposed(front);
    back = transposed(back);
#pragma GCC unroll 16
    for (int lane = 0; lane < lanes; ++lane) {
        uint32_t* const to = place(lane);
        const Words& words = (lane < lanes / 2 ? front : back).words[lane % 4];
#if SCREE_LANES == 8
        const Row row = words;
#else
        const Row row = lane % 8 < 4 ? __builtin_shufflevector(words, words, 0, 1, 2, 3, 4, 5, 6, 7)
                                     : __builtin_shufflevector(words, words, 8, 9, 10, 11, 12, 13, 14, 15);
#endif
        __builtin_memcpy(to, &row, sizeof row);
    }
}
#endif

// `place(lane)`: where its record is.
template <typename Record, typename Place>
SCREE_INLINE Record gather_from(const Place& place) {
    constexpr int blocks = sizeof(Record) / sizeof(Block);
    static_assert(sizeof(Record) % sizeof(Block) == 0);
    Record record;
    Block* const out = reinterpret_cast<Block*>(&record);
    int block = 0;
#if SCREE_LANES >= 8
#pragma GCC unroll 16
    for (; block + 1 < blocks; block += 2) {
        const TwoBlocks two = gather_rows([&](int lane) { return place(lane) + 4 * block; });
        out[block] = two.first;
        out[block + 1] = two.second;
    }
#endif
#pragma GCC unroll 16
    for (; block < blocks; ++block) {
        Quad rows[SCREE_LANES];
#pragma GCC unroll 16
        for (int lane = 0; lane < lanes; ++lane) rows[lane] = quad_at(place(lane) + 4 * block);
        out[block] = transposed({{joined(rows), joined(rows + 1), joined(rows + 2), joined(rows + 3)}});
    }
    return record;
}
template <typename Record, typename Place>
SCREE_INLINE void scatter_to(const Record& record, const Place& place) {
    constexpr int blocks = sizeof(Record) / sizeof(Block);
    const Block* const in = reinterpret_cast<const Block*>(&record);
    int block = 0;
#if SCREE_LANES >= 8
#pragma GCC unroll 16
    for (; block + 1 < blocks; block += 2)
        scatter_rows({in[block], in[block + 1]}, [&](int lane) { return place(lane) + 4 * block; });
#endif
#pragma GCC unroll 16
    for (; block < blocks; ++block) {
        const Block rows = transposed(in[block]);
#pragma GCC unroll 16
        for (int lane = 0; lane < lanes; ++lane) {
            uint32_t* const to = place(lane);
            const Quad quad = quarter(rows.words[lane % 4], lane / 4);
            __builtin_memcpy(to + 4 * block, &quad, sizeof quad);
        }
    }
}

template <typename Record>
SCREE_INLINE Record gather(const uint32_t* table, const Indices& indices) {
    constexpr size_t words = sizeof(Record) / sizeof(Words);
    return gather_from<Record>([&](int lane) { return table + words * indices.of[lane]; });
}
// Lanes with index `nowhere` write to unused memory: no branch predictor foresees which they are.
template <typename Record>
SCREE_INLINE void scatter(uint32_t* table, const Indices& indices, const Record& record) {
    constexpr size_t words = sizeof(Record) / sizeof(Words);
    uint32_t unused[words];
    scatter_to(record, [&](int lane) { return indices.of[lane] == nowhere ? unused : table + words * indices.of[lane]; });
}
// Only the member `value` at that offset in a record of lanes.
template <typename Record, typename Member>
SCREE_INLINE void scatter_member(uint32_t* table, const Indices& indices, size_t at, Member value) {
    constexpr size_t words = sizeof(Record) / sizeof(Words);
    uint32_t of[SCREE_LANES];
    static_assert(sizeof of == sizeof value);
    __builtin_memcpy(of, &value, sizeof of);
#pragma GCC unroll 16
    for (int lane = 0; lane < lanes; ++lane)
        if (indices.of[lane] != nowhere) table[words * indices.of[lane] + at / sizeof(Words)] = of[lane];
}

// Records at any places: of each lane the one at its pointer.
template <typename Record, typename Pointers>
SCREE_INLINE Record gather_at(const Pointers& pointers, size_t offset = 0) {
    return gather_from<Record>([&](int lane) { return pointers[lane] + offset; });
}
// Lanes with a null pointer write to unused memory.
template <typename Record>
SCREE_INLINE void scatter_at(uint32_t* const* pointers, size_t offset, const Record& record) {
    uint32_t unused[sizeof(Record) / sizeof(Words)];
    scatter_to(record, [&](int lane) { return pointers[lane] == nullptr ? unused : pointers[lane] + offset; });
}

// Broadcasts one record.
template <typename Record>
SCREE_INLINE void broadcast(const uint32_t* words, Record& record) {
    AnyWords* const out = reinterpret_cast<AnyWords*>(&record);
    for (size_t word = 0; word < sizeof(Record) / sizeof(Words); ++word) out[word] = all<Words>(words[word]);
}

LAWS_END

// From here on the types of the laws are lanes; compute/cpu/simd/simd_stages.cpp ends that.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
#define float Float
#define bool Bool
