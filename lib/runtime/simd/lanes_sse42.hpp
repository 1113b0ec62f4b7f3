// The vocabulary of the lanes for SSE4.2: four lanes.
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
#include <runtime/simd/target.hpp>
#include <runtime/simd/unpack_table.hpp>

#define ESPALIER_SSE42 "sse4.2,popcnt"

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {

/// What the slab tests of a kind of node need.
template <class Node>
using RayLanesOf = typename RayLanesFor<Node>::Type;

inline constexpr unsigned lanes = 4;
/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = false;
struct Floats {
    __m128 v;
};
struct Ints {
    __m128i v;
};
struct SignedInts {
    __m128i v;
};

inline Floats splat(float x) { return {_mm_set1_ps(x)}; }
inline void store(float* to, Floats a) { _mm_storeu_ps(to, a.v); }
inline Floats add(Floats a, Floats b) { return {_mm_add_ps(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return {_mm_add_ps(_mm_mul_ps(a.v, b.v), c.v)}; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return {_mm_sub_ps(_mm_mul_ps(a.v, b.v), c.v)}; }
inline Floats negate(Floats a) { return {_mm_xor_ps(a.v, _mm_set1_ps(-0.0f))}; }
inline Floats magnitude(Floats a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0f), a.v)}; }
inline Floats smaller(Floats a, Floats b) { return {_mm_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm_max_ps(a.v, b.v)}; }
inline Floats divide(Floats a, Floats b) { return {_mm_div_ps(a.v, b.v)}; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) {
    return {_mm_blendv_ps(otherwise.v, then.v, _mm_cmple_ps(a.v, b.v))};
}
inline unsigned at_most(Floats a, Floats b) { return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v))); }
inline Floats bytes_to_floats(const std::byte* at) {
    return {_mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(load_u32(at)))))};
}
inline Ints add(Ints a, std::uint32_t b) { return {_mm_add_epi32(a.v, _mm_set1_epi32(static_cast<int>(b)))}; }
inline Floats to_floats(Ints a) { return {_mm_cvtepi32_ps(a.v)}; }
inline Ints load_bytes(const std::byte* at) {
    return {_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(load_u32(at))))};
}
inline Ints load_words(const std::byte* at) {
    return {_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at)))};
}
inline Ints with_high_bytes(Ints words, Ints bytes) { return {_mm_or_si128(words.v, _mm_slli_epi32(bytes.v, 16))}; }
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const unsigned half = first / 4 % 2;
    const std::byte* at = stream + first / 8 * width + half * (width / 2);
    const UnpackEntry& entry = unpack_table[width];
    const __m128i spread =
        _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at)),
                         _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry.shuffle + 16 * half)));
    // Lanes cannot be shifted right by different counts before AVX2: shift left to a common place by multiplying.
    const auto* raise = reinterpret_cast<const __m128i*>(unpack_raise_table[width].data() + 4 * half);
    const __m128i raised = _mm_mullo_epi32(spread, _mm_loadu_si128(raise));
    return {_mm_and_si128(_mm_srli_epi32(raised, unpack_raised_bits),
                          _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry.mask)))};
}
inline SignedInts to_compared(Floats a) { return {_mm_castps_si128(a.v)}; }
inline void store_compared(float* to, SignedInts a) { _mm_storeu_ps(to, _mm_castsi128_ps(a.v)); }
inline SignedInts splat_integer(std::int32_t x) { return {_mm_set1_epi32(x)}; }
inline SignedInts add(SignedInts a, SignedInts b) { return {_mm_add_epi32(a.v, b.v)}; }
template <int bits>
inline SignedInts shift_right(SignedInts a) {
    return {_mm_srai_epi32(a.v, bits)};
}
inline SignedInts negate(SignedInts a) { return {_mm_sub_epi32(_mm_setzero_si128(), a.v)}; }
inline SignedInts smaller(SignedInts a, SignedInts b) { return {_mm_min_epi32(a.v, b.v)}; }
inline SignedInts larger(SignedInts a, SignedInts b) { return {_mm_max_epi32(a.v, b.v)}; }
inline unsigned at_most(SignedInts a, SignedInts b) {
    return 15u & ~static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(_mm_cmpgt_epi32(a.v, b.v))));
}
inline Ints pair_of(Floats x, Floats y) {
    return {_mm_blend_epi16(_mm_castps_si128(x.v), _mm_slli_epi32(_mm_castps_si128(y.v), 16), 0xAA)};
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const __m128i swapped = _mm_shufflehi_epi16(_mm_shufflelo_epi16(q.v, 0xB1), 0xB1);
    return {_mm_madd_epi16(p.v, _mm_sign_epi16(swapped, _mm_set1_epi32(static_cast<int>(0xFFFF0001u))))};
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const __m128i sum = _mm_adds_epi16(_mm_adds_epi16(_mm_abs_epi16(a.v), _mm_abs_epi16(b.v)), _mm_abs_epi16(c.v));
    return {_mm_madd_epi16(sum, _mm_set1_epi16(static_cast<short>(weight)))};
}
inline Ints load_ints(const std::uint32_t* from) { return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))}; }
inline void store(std::uint32_t* to, Ints a) { _mm_storeu_si128(reinterpret_cast<__m128i*>(to), a.v); }
inline void prefetch(const std::byte* at) { _mm_prefetch(reinterpret_cast<const char*>(at), _MM_HINT_T0); }

/// row . (x, y, z) + moved, of the even lanes.
inline __m128i place_even(const std::int32_t* row, std::int64_t moved, __m128i x, __m128i y, __m128i z) {
    const __m128i xy =
        _mm_add_epi64(_mm_mul_epi32(x, _mm_set1_epi32(row[0])), _mm_mul_epi32(y, _mm_set1_epi32(row[1])));
    return _mm_add_epi64(xy, _mm_add_epi64(_mm_mul_epi32(z, _mm_set1_epi32(row[2])), _mm_set1_epi64x(moved)));
}
/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    // Words of 64 bits have no arithmetic shift here: 2^62 keeps them above zero, and is taken away again modulo 2^32.
    constexpr std::int64_t above = std::int64_t{1} << 62;
    const __m128i shift = _mm_cvtsi32_si128(fraction_bits);
    const __m128i even_lanes =
        _mm_srl_epi64(place_even(row, moved + above, vertex[0].v, vertex[1].v, vertex[2].v), shift);
    const __m128i odd_lanes =
        _mm_srl_epi64(place_even(row, moved + above, _mm_srli_epi64(vertex[0].v, 32), _mm_srli_epi64(vertex[1].v, 32),
                                 _mm_srli_epi64(vertex[2].v, 32)),
                      shift);
    const __m128i both = _mm_blend_epi16(even_lanes, _mm_slli_epi64(odd_lanes, 32), 0xCC);
    const auto too_much = static_cast<std::uint32_t>(above >> fraction_bits);
    return {_mm_cvtepi32_ps(_mm_sub_epi32(both, _mm_set1_epi32(static_cast<int>(too_much))))};
}

/// The same bits.
inline Floats as_floats(Ints a) { return {_mm_castsi128_ps(a.v)}; }
inline Ints as_ints(Floats a) { return {_mm_castps_si128(a.v)}; }
inline Floats gather(const float* a, const float* b, const float* c, const float* d) {
    return {_mm_setr_ps(*a, *b, *c, *d)};
}

#include <runtime/simd/table_in_memory.inl>

inline __m128 multiply_add(__m128 a, __m128 b, __m128 c) { return _mm_add_ps(_mm_mul_ps(a, b), c); }
/// The three elements of a vector to all lanes each.
inline void spread(__m128 a, Floats* to) {
    to[0] = {_mm_shuffle_ps(a, a, 0x00)};
    to[1] = {_mm_shuffle_ps(a, a, 0x55)};
    to[2] = {_mm_shuffle_ps(a, a, 0xAA)};
}
/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline __m128i shift_left_each(const std::byte* word) {
    static_assert(x == 23 && z >= 9);
    const __m128i spread = _mm_set1_epi32(static_cast<int>(load_u32(word)));
    return _mm_slli_epi32(_mm_madd_epi16(spread, _mm_setr_epi32(1 << (x - 9), 1 << (y - 9), 1 << (z - 9), 0)), 9);
}

#include <runtime/simd/strip_corners_portable.inl>
#include <runtime/simd/leaf_corners.inl>
#include <runtime/simd/frames_x86.inl>

/// The planes of a node as tau along a ray: plane * scale + offset.
struct SlabFrame {
    Floats scale[3];
    Floats near_offset[3];
    Floats far_offset[3];
};
inline SlabFrame load_slab_frame(const PackedNode& node, const RayLanes& ray) {
    // Adding a shift to the exponent multiplies by its power of two.
    const __m128i inverse = _mm_load_si128(reinterpret_cast<const __m128i*>(ray.inverse));
    const __m128 slope = _mm_load_ps(ray.base_inverse);
    const __m128 bases = load_bases(node);
    SlabFrame frame;
    spread(_mm_castsi128_ps(_mm_add_epi32(load_shifts(node), inverse)), frame.scale);
    spread(multiply_add(bases, slope, _mm_load_ps(ray.near_offset)), frame.near_offset);
    spread(multiply_add(bases, slope, _mm_load_ps(ray.far_offset)), frame.far_offset);
    return frame;
}

}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
