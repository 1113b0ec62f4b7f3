// The vocabulary of the lanes for SSE4.2: four lanes.
#pragma once

#include <runtime/lanes/intrinsics.hpp>

#include <runtime/lanes/vocabulary.hpp>

#define ESPALIER_SSE42 "sse4.2,popcnt"

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {

inline constexpr unsigned lanes = 4;
using Floats = Vector<float, lanes>;
using Ints = Vector<std::uint32_t, lanes>;
using SignedInts = Vector<std::int32_t, lanes>;
using WideInts = Vector<std::uint64_t, lanes / 2>;
using Compared = SignedInts;

inline unsigned bits_of(SignedInts comparison) {
    return static_cast<unsigned>(_mm_movemask_ps(__builtin_bit_cast(Floats, comparison)));
}
ESPALIER_ALWAYS_INLINE inline Ints load_bytes(const std::byte* at) {
    return Ints(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(load_u32(at)))));
}
inline Ints load_words(const std::byte* at) {
    return Ints(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))));
}
/// Each byte by its number; 0 for those behind the last.
inline Ints shuffle_bytes(const std::byte* bytes, const std::uint8_t* numbers) {
    return Ints(_mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes)),
                                 _mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers))));
}
/// Converts numbers below 2^31.
inline Floats to_floats(Ints a) { return _mm_cvtepi32_ps(__m128i(a)); }

#include <runtime/lanes/arithmetic.inl>

inline Floats square_roots(Floats a) { return _mm_sqrt_ps(a); }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return a * b - c; }
inline Ints pair_of(Floats x, Floats y) {
    return Ints(_mm_blend_epi16(__m128i(x), __m128i(__builtin_bit_cast(Ints, y) << 16), 0xAA));
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const __m128i swapped = _mm_shufflehi_epi16(_mm_shufflelo_epi16(__m128i(q), 0xB1), 0xB1);
    const __m128i signs = _mm_set1_epi32(static_cast<int>(0xFFFF0001u));
    return SignedInts(_mm_madd_epi16(__m128i(p), _mm_sign_epi16(swapped, signs)));
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const __m128i two = _mm_adds_epi16(_mm_abs_epi16(__m128i(a)), _mm_abs_epi16(__m128i(b)));
    return SignedInts(
        _mm_madd_epi16(_mm_adds_epi16(two, _mm_abs_epi16(__m128i(c))), _mm_set1_epi16(static_cast<short>(weight))));
}
/// Products of the even lanes.
inline WideInts multiply_even(WideInts a, std::int32_t b) {
    return WideInts(_mm_mul_epi32(__m128i(a), _mm_set1_epi32(b)));
}

#include <runtime/lanes/four_lanes.inl>
#include <runtime/lanes/x86.inl>

/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline AxisInts shift_left_each(const std::byte* word) {
    static_assert(x == 23 && z >= 9);
    const __m128i spread = _mm_set1_epi32(static_cast<int>(load_u32(word)));
    return AxisInts(_mm_madd_epi16(spread, _mm_setr_epi32(1 << (x - 9), 1 << (y - 9), 1 << (z - 9), 0))) << 9;
}

#include <runtime/lanes/axes.inl>
#include <runtime/lanes/leaves.inl>

}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
