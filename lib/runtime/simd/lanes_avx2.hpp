// The vocabulary of the lanes for AVX2: eight lanes.
#pragma once

#include <immintrin.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/float_bits.hpp>
#include <runtime/copies.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/placed_planes.hpp>
#include <runtime/ray_lanes.hpp>
#include <runtime/simd/pivot_table.hpp>
#include <runtime/simd/target.hpp>
#include <runtime/simd/unpack_table.hpp>
#include <runtime/vertex_word.hpp>

#define ESPALIER_AVX2 "avx2,fma,bmi,bmi2,lzcnt,popcnt"

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {

/// What the slab tests of a kind of node need.
template <class Node>
using RayLanesOf =
    std::conditional_t<std::is_same_v<Node, PackedNode>, PlacedRayLanes, typename RayLanesFor<Node>::Type>;

inline constexpr unsigned lanes = 8;
/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = true;
struct Floats {
    __m256 v;
};
struct Ints {
    __m256i v;
};
struct SignedInts {
    __m256i v;
};
/// A vertex for each lane, and the three vertices of a triangle in each.
using Numbers = Ints;
struct CornerNumbers {
    Numbers a, b, c;
};

inline Floats splat(float x) { return {_mm256_set1_ps(x)}; }
inline void store(float* to, Floats a) { _mm256_storeu_ps(to, a.v); }
inline Floats add(Floats a, Floats b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return {_mm256_fmsub_ps(a.v, b.v, c.v)}; }
inline Floats negate(Floats a) { return {_mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f))}; }
inline Floats magnitude(Floats a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
inline Floats smaller(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Floats divide(Floats a, Floats b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) {
    return {_mm256_blendv_ps(otherwise.v, then.v, _mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ))};
}
inline unsigned at_most(Floats a, Floats b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
inline Floats bytes_to_floats(const std::byte* at) {
    return {_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))))};
}
inline Ints add(Ints a, std::uint32_t b) { return {_mm256_add_epi32(a.v, _mm256_set1_epi32(static_cast<int>(b)))}; }
inline Floats to_floats(Ints a) { return {_mm256_cvtepi32_ps(a.v)}; }
inline Ints load_bytes(const std::byte* at) {
    return {_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at)))};
}
inline Ints load_words(const std::byte* at) {
    return {_mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at)))};
}
inline Ints with_high_bytes(Ints words, Ints bytes) {
    return {_mm256_or_si256(words.v, _mm256_slli_epi32(bytes.v, 16))};
}
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const std::byte* at = stream + first / 8 * width;
    const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
    const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at + width / 2));
    const UnpackEntry& entry = unpack_table[width];
    const __m256i spread = _mm256_shuffle_epi8(_mm256_set_m128i(high, low),
                                               _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.shuffle)));
    const __m256i shifted =
        _mm256_srlv_epi32(spread, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.shift)));
    return {_mm256_and_si256(shifted, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.mask)))};
}
inline SignedInts splat_integer(std::int32_t x) { return {_mm256_set1_epi32(x)}; }
inline SignedInts add(SignedInts a, SignedInts b) { return {_mm256_add_epi32(a.v, b.v)}; }
template <int bits>
inline SignedInts shift_right(SignedInts a) {
    return {_mm256_srai_epi32(a.v, bits)};
}
inline SignedInts negate(SignedInts a) { return {_mm256_sub_epi32(_mm256_setzero_si256(), a.v)}; }
inline SignedInts smaller(SignedInts a, SignedInts b) { return {_mm256_min_epi32(a.v, b.v)}; }
inline SignedInts larger(SignedInts a, SignedInts b) { return {_mm256_max_epi32(a.v, b.v)}; }
inline unsigned at_most(SignedInts a, SignedInts b) {
    return 255u & ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))));
}
inline SignedInts to_compared(Floats a) { return {_mm256_castps_si256(a.v)}; }
inline void store_compared(float* to, SignedInts a) { _mm256_storeu_ps(to, _mm256_castsi256_ps(a.v)); }
inline Ints pair_of(Floats x, Floats y) {
    return {_mm256_blend_epi16(_mm256_castps_si256(x.v), _mm256_slli_epi32(_mm256_castps_si256(y.v), 16), 0xAA)};
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const __m256i swap =
        _mm256_set_epi64x(0x0D0C0F0E09080B0A, 0x0504070601000302, 0x0D0C0F0E09080B0A, 0x0504070601000302);
    const __m256i signs = _mm256_set1_epi32(static_cast<int>(0xFFFF0001u));
    return {_mm256_madd_epi16(p.v, _mm256_sign_epi16(_mm256_shuffle_epi8(q.v, swap), signs))};
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const __m256i two = _mm256_adds_epi16(_mm256_abs_epi16(a.v), _mm256_abs_epi16(b.v));
    return {_mm256_madd_epi16(_mm256_adds_epi16(two, _mm256_abs_epi16(c.v)),
                              _mm256_set1_epi16(static_cast<short>(weight)))};
}
inline Ints load_ints(const std::uint32_t* from) {
    return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))};
}
inline Numbers load_numbers(const std::byte* bytes) { return load_bytes(bytes); }
inline Numbers load_numbers(const std::uint32_t* from) { return load_ints(from); }
inline void store(std::uint32_t* to, Ints a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.v); }
inline void prefetch(const std::byte* at) { _mm_prefetch(reinterpret_cast<const char*>(at), _MM_HINT_T0); }

/// row . (x, y, z) + moved, of the even lanes.
inline __m256i place_even(const std::int32_t* row, std::int64_t moved, __m256i x, __m256i y, __m256i z) {
    const __m256i xy = _mm256_add_epi64(_mm256_mul_epi32(x, _mm256_set1_epi32(row[0])),
                                        _mm256_mul_epi32(y, _mm256_set1_epi32(row[1])));
    return _mm256_add_epi64(
        xy, _mm256_add_epi64(_mm256_mul_epi32(z, _mm256_set1_epi32(row[2])), _mm256_set1_epi64x(moved)));
}
/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    // Words of 64 bits have no arithmetic shift here: 2^62 keeps them above zero, and is taken away again modulo 2^32.
    constexpr std::int64_t above = std::int64_t{1} << 62;
    const __m128i shift = _mm_cvtsi32_si128(fraction_bits);
    const __m256i even_lanes =
        _mm256_srl_epi64(place_even(row, moved + above, vertex[0].v, vertex[1].v, vertex[2].v), shift);
    const __m256i odd_lanes =
        _mm256_srl_epi64(place_even(row, moved + above, _mm256_srli_epi64(vertex[0].v, 32),
                                    _mm256_srli_epi64(vertex[1].v, 32), _mm256_srli_epi64(vertex[2].v, 32)),
                         shift);
    const __m256i both = _mm256_blend_epi32(even_lanes, _mm256_slli_epi64(odd_lanes, 32), 0xAA);
    const auto too_much = static_cast<std::uint32_t>(above >> fraction_bits);
    return {_mm256_cvtepi32_ps(_mm256_sub_epi32(both, _mm256_set1_epi32(static_cast<int>(too_much))))};
}

/// Values by vertex, in registers.
template <unsigned groups>
struct Table {
    __m256 group[groups];
    static unsigned groups_of(unsigned) { return groups; }
    void set(unsigned number, Floats a) { group[number] = a.v; }
    /// By the low bits of each index; bits above those that number the vertices are ignored.
    [[nodiscard]] Floats look_up(Ints index) const { return {pick<0, groups>(index.v)}; }
    /// Where only the first groups are set.
    template <unsigned used>
    [[nodiscard]] Floats look_up_among(Ints index) const {
        return {pick<0, used>(index.v)};
    }

private:
    template <unsigned first, unsigned count>
    [[nodiscard]] __m256 pick(__m256i index) const {
        if constexpr (count == 1) {
            return _mm256_permutevar8x32_ps(group[first], index);
        } else {
            constexpr unsigned half = std::bit_ceil(count) / 2;
            constexpr int bit_above = 31 - std::countr_zero(8 * half);  // moves the deciding bit to the sign
            return _mm256_blendv_ps(pick<first, half>(index), pick<first + half, count - half>(index),
                                    _mm256_castsi256_ps(_mm256_slli_epi32(index, bit_above)));
        }
    }
};
/// Pairs of integers by vertex.
template <unsigned groups>
struct PairTable : Table<groups> {
    void set(unsigned number, Ints pair) { Table<groups>::set(number, {_mm256_castsi256_ps(pair.v)}); }
    [[nodiscard]] Ints look_up(Ints index) const { return {_mm256_castps_si256(Table<groups>::look_up(index).v)}; }
};
template <unsigned max_vertices, class Function>
constexpr auto with_table_groups(unsigned vertex_count, Function function) {
    if (vertex_count <= 8) return function(std::integral_constant<unsigned, 1>{});
    if (vertex_count <= 16) return function(std::integral_constant<unsigned, 2>{});
    if (vertex_count <= 24) return function(std::integral_constant<unsigned, 3>{});
    if (max_vertices <= 32 || vertex_count <= 32) return function(std::integral_constant<unsigned, 4>{});
    if (vertex_count <= 40) return function(std::integral_constant<unsigned, 5>{});
    if (vertex_count <= 48) return function(std::integral_constant<unsigned, 6>{});
    return function(std::integral_constant<unsigned, 7>{});
}

#if defined(__x86_64__)

/// The windows of a strip, eight at a time; numbers of entries as bytes of a word.
class StripCorners {
public:
    explicit StripCorners(const StripLeaf& leaf)
        : marks_(leaf.marks),
          first_uses_(leaf.first_uses),
          pivots_(leaf.pivots),
          field_(ones * ((1u << leaf.reference_width) - 1)),
          width_(leaf.reference_width),
          bit_(leaf.references_at) {
        entries_ = next_entries();
    }
    /// The vertices that all entries name, a byte each, as far as they have been decoded.
    void keep_entries(std::uint8_t* to) {
        kept_ = to;
        kept_end_ = to + format::max_leaf_entries;
        keep(entries_);
    }
    /// The vertices that the eight entries at hand name.
    [[nodiscard]] std::uint64_t entries() const { return entries_; }
    void advance() { entries_ = next_entries(); }
    [[gnu::always_inline]] CornerNumbers next() {
        const std::uint64_t following = next_entries();
        if (kept_ != kept_end_) keep(following);
        const auto marked = static_cast<unsigned>(pivots_ & 255);
        const auto to_lanes = [](std::uint64_t bytes) {
            return Ints{_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(bytes)))};
        };
        const __m128i choices = _mm_set_epi64x(static_cast<long long>(pivot_), static_cast<long long>(entries_));
        const __m128i chosen =
            _mm_shuffle_epi8(choices, _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pivot_table[marked].data())));
        const CornerNumbers numbers = {{_mm256_cvtepu8_epi32(chosen)},
                                       to_lanes(entries_ >> 8 | following << 56),
                                       to_lanes(entries_ >> 16 | following << 48)};
        pivot_ = marked != 0 ? entries_ >> (8 * (std::bit_width(marked) - 1)) : pivot_;
        pivots_ >>= 8;
        entries_ = following;
        return numbers;
    }

private:
    static constexpr std::uint64_t ones = 0x0101010101010101;

    void keep(std::uint64_t entries) {
        __builtin_memcpy(kept_, &entries, sizeof entries);
        kept_ += sizeof entries;
    }
    std::uint64_t next_entries() {
        const std::uint64_t fresh = _pdep_u64(first_uses_, ones);
        const std::uint64_t fresh_bytes = (fresh << 8) - fresh;
        const std::uint64_t used = fresh * ones + used_;  // how many up to and with each entry
        const std::uint64_t references = load_u64(marks_ + bit_ / 8) >> (bit_ % 8);
        const std::uint64_t entries = ((used - ones) & fresh_bytes) | _pdep_u64(references, field_ & ~fresh_bytes);
        bit_ += width_ * (8 - static_cast<unsigned>(std::popcount(first_uses_ & 255)));
        used_ = (used >> 56) * ones;
        first_uses_ >>= 8;
        return entries;
    }

    const std::byte* marks_;
    std::uint64_t first_uses_;
    std::uint64_t pivots_;
    std::uint64_t field_;  ///< the low bits of each byte that a reference fills
    unsigned width_;
    unsigned bit_;  ///< of the next reference
    std::uint64_t used_ = 0;
    std::uint64_t entries_;
    std::uint64_t pivot_ = 0;  ///< in its lowest byte
    std::uint8_t* kept_ = nullptr;
    std::uint8_t* kept_end_ = nullptr;
};

#if ESPALIER_PREDICTED_STRIPS
#include <runtime/simd/predicted_points.inl>

inline PredictedFrom predicted_from(const StripLeaf& leaf) {
    PredictedFrom from;
    StripCorners strip(leaf);
    const std::uint64_t predicted = format::predicted_strip::predicted_entries(leaf.windows);
    std::uint64_t entries_before = 0, pivots_before = 0;
    unsigned used = 0;
    for (unsigned first = 0; first < leaf.entry_count(); first += 8) {
        const std::uint64_t entries = strip.entries();
        const auto& places = pivot_table[leaf.pivots >> first & 255];
        const __m128i candidates =
            _mm_set_epi64x(static_cast<long long>(pivots_before >> 56), static_cast<long long>(entries));
        const auto pivots = static_cast<std::uint64_t>(_mm_cvtsi128_si64(
            _mm_shuffle_epi8(candidates, _mm_loadl_epi64(reinterpret_cast<const __m128i*>(places.data())))));
        const std::uint64_t turns = _pdep_u64(leaf.pivots << 2 >> first, every_byte) * 255;
        const std::uint64_t is_predicted = _pdep_u64(predicted >> first, every_byte) * 255;
        const std::uint64_t last_pivots = pivots << 24 | pivots_before >> 40;
        const std::uint64_t last_but_one = entries << 16 | entries_before >> 48;
        const std::uint64_t fresh = _pdep_u64(leaf.first_uses >> first, every_byte) * 255;
        const auto put = [&](std::uint8_t* to, std::uint64_t numbers) {
            const std::uint64_t or_none = (numbers & is_predicted) | (~is_predicted & every_byte * PredictedFrom::none);
            const std::uint64_t of_fresh = _pext_u64(or_none, fresh);
            __builtin_memcpy(to + used, &of_fresh, sizeof of_fresh);
        };
        put(from.pivot, pivots << 16 | pivots_before >> 48);
        put(from.before, entries << 8 | entries_before >> 56);
        put(from.opposite, (last_pivots & turns) | (last_but_one & ~turns));
        used += static_cast<unsigned>(std::popcount(leaf.first_uses >> first & 255));
        entries_before = entries;
        pivots_before = pivots;
        strip.advance();
    }
    return from;
}
/// Stores the vertices of a leaf, of which `open` has proved the numbers, axis by axis; more than there are.
inline void decode_points(const StripLeaf& leaf, std::uint32_t* x, std::uint32_t* y, std::uint32_t* z) {
    if (!fit_into_words(leaf)) return store_predicted_vertices(leaf, x, y, z);
    alignas(32) std::uint64_t words[format::max_leaf_entries];
    decode_words(leaf, predicted_from(leaf), words);
    const __m256i low = _mm256_set1_epi64x((1 << axis_bits) - 1);
    for (unsigned first = 0; first < leaf.vertex_count; first += 8) {
        const __m256i four = _mm256_load_si256(reinterpret_cast<const __m256i*>(words + first));
        const __m256i more = _mm256_load_si256(reinterpret_cast<const __m256i*>(words + first + 4));
        const auto put = [&](std::uint32_t* to, __m256i a, __m256i b) {
            const __m256 both = _mm256_shuffle_ps(_mm256_castsi256_ps(_mm256_and_si256(a, low)),
                                                  _mm256_castsi256_ps(_mm256_and_si256(b, low)), 0x88);
            store(to + first, Ints{_mm256_permute4x64_epi64(_mm256_castps_si256(both), 0xD8)});
        };
        put(x, four, more);
        put(y, _mm256_srli_epi64(four, axis_bits), _mm256_srli_epi64(more, axis_bits));
        put(z, _mm256_srli_epi64(four, 2 * axis_bits), _mm256_srli_epi64(more, 2 * axis_bits));
    }
}
#endif

#else

#include <runtime/simd/strip_corners_portable.inl>

#endif

inline __m128 multiply_add(__m128 a, __m128 b, __m128 c) { return _mm_fmadd_ps(a, b, c); }
/// The three elements of a vector to all lanes each.
inline void spread(__m128 a, Floats* to) {
    to[0] = {_mm256_broadcastss_ps(a)};
    to[1] = {_mm256_broadcastss_ps(_mm_movehdup_ps(a))};
    to[2] = {_mm256_broadcastss_ps(_mm_unpackhi_ps(a, a))};
}
/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline __m128i shift_left_each(const std::byte* word) {
    float bits;  // never calculated with; as a float it is loaded and spread by one instruction
    __builtin_memcpy(&bits, word, sizeof bits);
    return _mm_sllv_epi32(_mm_castps_si128(_mm_set1_ps(bits)), _mm_setr_epi32(x, y, z, z));
}

#include <runtime/simd/leaf_corners.inl>
#include <runtime/simd/frames_x86.inl>

}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET
