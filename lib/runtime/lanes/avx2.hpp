// The vocabulary of the lanes for AVX2: eight lanes.
#pragma once

#include <runtime/lanes/intrinsics.hpp>

#include <runtime/lanes/vocabulary.hpp>

#define ESPALIER_AVX2 "avx2,fma,bmi,bmi2,lzcnt,popcnt"

namespace espalier::detail::avx2 {

// A ray for the slab test of packed nodes. It stands before the region that is compiled for AVX2, because code of
// AVX-512 inlines it, too.

/// Lattice coordinates as floats, without a conversion: coordinate * 2^-(bits + 1) + 1. Its mantissa is the coordinate
/// in 22 bits, so the float's bits are a sum of shifted integers. From 23 bits on the lowest bits are cut off.
namespace placed {

inline constexpr unsigned mantissa_bits = 22;
inline constexpr std::uint32_t one = 0x3F800000u;  ///< the bits of coordinate 0
/// A plane, in the top byte of a word, is shifted right by at least this: then no plane overflows, and planes that
/// are as far apart as the lattice is large still leave it.
inline constexpr std::uint32_t least_shift = 24 - mantissa_bits;
/// How far slab tests move planes outward for the roundings of placed coordinates, in units of the mantissa.
inline constexpr float slack_units = 3.0f;

/// How far a node's base is shifted left.
constexpr std::uint32_t base_shift(unsigned bits) { return mantissa_bits - (bits < 16 ? bits : 16u); }
/// How far a plane in a word's top byte is shifted right, less the shift of its axis.
constexpr std::uint32_t plane_shift(unsigned bits) { return bits + least_shift; }
/// A unit of the mantissa, in lattice steps.
constexpr float unit(unsigned bits) { return power_of_two(static_cast<int>(bits) - static_cast<int>(mantissa_bits)); }
/// By how much a placed coordinate grows in a lattice step, and the inverse.
constexpr float step(unsigned bits) { return power_of_two(-1 - static_cast<int>(bits)); }
constexpr float steps_to_one(unsigned bits) { return power_of_two(1 + static_cast<int>(bits)); }

}  // namespace placed

/// RayLanes for placed coordinates: tau of a plane is placed coordinate * inverse + offset.
struct PlacedRayLanes {
    alignas(16) float inverse[4];
    alignas(16) float near_offset[4];
    alignas(16) float far_offset[4];
    float tau_min;  ///< not -0
    std::uint32_t base_shift, plane_shift;
    PlaneOrder planes;

    static constexpr const std::array<PlaneOrder, 8>& plane_orders() { return packed_plane_orders; }
    static float box_slack(const BlobData& blob) { return placed::slack_units * placed::unit(blob.bits); }
    void set_inverse(const BlobData& blob, unsigned k, float of_step) {
        inverse[k] = of_step * placed::steps_to_one(blob.bits);
        base_shift = placed::base_shift(blob.bits);
        plane_shift = placed::plane_shift(blob.bits);
    }
    [[nodiscard]] float low(unsigned k) const { return inverse[k]; }
    [[nodiscard]] float high(const BlobData& blob, unsigned k) const {
        return blob.extent_steps[k] * placed::step(blob.bits) * inverse[k] + inverse[k];
    }
};

/// What the slab tests of a kind of node need.
template <class Node>
using RayLanesOf = std::conditional_t<std::is_same_v<Node, PackedNode>, PlacedRayLanes, detail::RayLanesOf<Node>>;

}  // namespace espalier::detail::avx2

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {

inline constexpr unsigned lanes = 8;
using Floats = Vector<float, lanes>;
using Ints = Vector<std::uint32_t, lanes>;
using SignedInts = Vector<std::int32_t, lanes>;
using WideInts = Vector<std::uint64_t, lanes / 2>;
using Compared = SignedInts;

inline unsigned bits_of(SignedInts comparison) {
    return static_cast<unsigned>(_mm256_movemask_ps(__builtin_bit_cast(Floats, comparison)));
}
ESPALIER_ALWAYS_INLINE inline Ints load_bytes(const std::byte* at) {
    return Ints(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))));
}
inline Ints load_words(const std::byte* at) {
    return Ints(_mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at))));
}
/// Converts numbers below 2^31.
inline Floats to_floats(Ints a) { return _mm256_cvtepi32_ps(__m256i(a)); }

#include <runtime/lanes/arithmetic.inl>

inline unsigned bits_of(AxisInts comparison) {
    return static_cast<unsigned>(_mm_movemask_ps(__builtin_bit_cast(Axes, comparison)));
}

inline Floats smaller(Floats a, Floats b) { return _mm256_min_ps(a, b); }
inline Floats larger(Floats a, Floats b) { return _mm256_max_ps(a, b); }
inline Floats square_roots(Floats a) { return _mm256_sqrt_ps(a); }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return _mm256_fmsub_ps(a, b, c); }
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const std::byte* at = stream + first / 8 * width;
    const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
    const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at + width / 2));
    const UnpackEntry& entry = unpack_table[width];
    const __m256i spread = _mm256_shuffle_epi8(_mm256_set_m128i(high, low),
                                               _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.shuffle)));
    return Ints(spread) >> load_ints(entry.shift) & load_ints(entry.mask);
}
inline Ints pair_of(Floats x, Floats y) {
    return Ints(_mm256_blend_epi16(__m256i(x), __m256i(__builtin_bit_cast(Ints, y) << 16), 0xAA));
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const __m256i swap =
        _mm256_set_epi64x(0x0D0C0F0E09080B0A, 0x0504070601000302, 0x0D0C0F0E09080B0A, 0x0504070601000302);
    const __m256i signs = _mm256_set1_epi32(static_cast<int>(0xFFFF0001u));
    return SignedInts(_mm256_madd_epi16(__m256i(p), _mm256_sign_epi16(_mm256_shuffle_epi8(__m256i(q), swap), signs)));
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const __m256i two = _mm256_adds_epi16(_mm256_abs_epi16(__m256i(a)), _mm256_abs_epi16(__m256i(b)));
    return SignedInts(_mm256_madd_epi16(_mm256_adds_epi16(two, _mm256_abs_epi16(__m256i(c))),
                                        _mm256_set1_epi16(static_cast<short>(weight))));
}
/// Products of the even lanes.
inline WideInts multiply_even(WideInts a, std::int32_t b) {
    return WideInts(_mm256_mul_epi32(__m256i(a), _mm256_set1_epi32(b)));
}

/// From the first of `count` registers on.
template <unsigned count>
inline Floats look_up_in(const Floats* group, Ints index) {
    if constexpr (count == 1) {
        return _mm256_permutevar8x32_ps(group[0], __m256i(index));
    } else {
        constexpr unsigned half = std::bit_ceil(count) / 2;
        constexpr int bit_above = 31 - std::countr_zero(8 * half);  // moves the deciding bit to the sign
        return _mm256_blendv_ps(look_up_in<half>(group, index), look_up_in<count - half>(group + half, index),
                                __builtin_bit_cast(Floats, index << bit_above));
    }
}
#include <runtime/lanes/tables.inl>

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
    ESPALIER_ALWAYS_INLINE CornerNumbers next() {
        const std::uint64_t following = next_entries();
        if (kept_ != kept_end_) keep(following);
        const auto marked = static_cast<unsigned>(pivots_ & 255);
        const auto to_lanes = [](std::uint64_t bytes) {
            return Ints(_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(bytes))));
        };
        const __m128i choices = _mm_set_epi64x(static_cast<long long>(pivot_), static_cast<long long>(entries_));
        const __m128i chosen =
            _mm_shuffle_epi8(choices, _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pivot_table[marked].data())));
        const CornerNumbers numbers = {Ints(_mm256_cvtepu8_epi32(chosen)), to_lanes(entries_ >> 8 | following << 56),
                                       to_lanes(entries_ >> 16 | following << 48)};
        pivot_ = marked != 0 ? entries_ >> (8 * (std::bit_width(marked) - 1)) : pivot_;
        pivots_ >>= 8;
        entries_ = following;
        return numbers;
    }

private:
    static constexpr std::uint64_t ones = 0x0101010101010101;

    void keep(std::uint64_t entries) {
        ESPALIER_COPY_BYTES(kept_, &entries, sizeof entries);
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
/// An axis of eight vertices.
template <unsigned shift>
inline void store_fields(std::uint32_t* to, const std::uint64_t* words) {
    const auto field = [&](unsigned first) {
        return __builtin_bit_cast(
            Floats, load_as<WideInts>(words + first) >> shift & vertex_word::field(vertex_word::axis_bits, 0));
    };
    const Floats both = _mm256_shuffle_ps(field(0), field(4), 0x88);
    store(to, Ints(_mm256_permute4x64_epi64(__m256i(both), 0xD8)));
}
#include <runtime/lanes/predicted_points.inl>

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
            ESPALIER_COPY_BYTES(to + used, &of_fresh, sizeof of_fresh);
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
#endif

#else

#include <runtime/lanes/strip_corners_portable.inl>

#endif

inline Axes multiply_add(Axes a, Axes b, Axes c) { return _mm_fmadd_ps(a, b, c); }
inline Axes words_to_axes(const std::byte* at) {
    return _mm_cvtepi32_ps(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))));
}
inline Axes bytes_to_axes(std::uint32_t bytes) {
    return _mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(bytes))));
}
/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline AxisInts shift_left_each(const std::byte* word) {
    // One instruction loads and spreads a word, if the compiler takes it for a float.
    return AxisInts(_mm_sllv_epi32(__m128i(_mm_set1_ps(load_as<float>(word))), _mm_setr_epi32(x, y, z, z)));
}

#include <runtime/lanes/x86.inl>
#include <runtime/lanes/axes.inl>
#include <runtime/lanes/leaves.inl>

}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET
