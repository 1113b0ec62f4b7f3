// The vocabulary of the lanes for AArch64: four lanes.
#pragma once

#include <runtime/lanes/select.hpp>
#if ESPALIER_NEON
#include <arm_neon.h>

#include <runtime/lanes/vocabulary.hpp>

namespace espalier::detail::neon {

inline constexpr unsigned lanes = 4;
using Floats = Vector<float, lanes>;
using Ints = Vector<std::uint32_t, lanes>;
using SignedInts = Vector<std::int32_t, lanes>;
using Compared = Floats;

inline unsigned bits_of(SignedInts comparison) {
    const uint32x4_t bit = {1u, 2u, 4u, 8u};
    return vaddvq_u32(vandq_u32(vreinterpretq_u32_s32(comparison), bit));
}
ESPALIER_ALWAYS_INLINE inline Ints load_bytes(const std::byte* at) {
    const uint8x8_t bytes = vreinterpret_u8_u32(vdup_n_u32(load_u32(at)));
    return vmovl_u16(vget_low_u16(vmovl_u8(bytes)));
}
inline Ints load_words(const std::byte* at) {
    return vmovl_u16(vreinterpret_u16_u8(vld1_u8(reinterpret_cast<const std::uint8_t*>(at))));
}
/// Each byte by its number; 0 for those behind the last.
inline Ints shuffle_bytes(const std::byte* bytes, const std::uint8_t* numbers) {
    return vreinterpretq_u32_u8(vqtbl1q_u8(vld1q_u8(reinterpret_cast<const std::uint8_t*>(bytes)), vld1q_u8(numbers)));
}
/// Converts numbers below 2^31.
inline Floats to_floats(Ints a) { return vcvtq_f32_u32(a); }

#include <runtime/lanes/arithmetic.inl>

inline AxisInts round_to_integers(Axes a) { return vcvtnq_s32_f32(a); }

inline Floats square_roots(Floats a) { return vsqrtq_f32(a); }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return vfmaq_f32(c, a, b); }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return vfmaq_f32(-c, a, b); }
/// The number when one is not a number.
inline Floats smaller(Floats a, Floats b) { return vminnmq_f32(a, b); }
inline Floats larger(Floats a, Floats b) { return vmaxnmq_f32(a, b); }
inline Ints pair_of(Floats x, Floats y) { return vsliq_n_u32(vreinterpretq_u32_f32(x), vreinterpretq_u32_f32(y), 16); }
inline SignedInts cross_pairs(Ints p, Ints q) {
    const auto x = [](Ints pair) { return __builtin_bit_cast(SignedInts, pair << 16) >> 16; };
    const auto y = [](Ints pair) { return __builtin_bit_cast(SignedInts, pair) >> 16; };
    return x(p) * y(q) - y(p) * x(q);
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const auto magnitudes = [](Ints pair) { return vabsq_s16(vreinterpretq_s16_u32(pair)); };
    const int16x8_t sum = vqaddq_s16(vqaddq_s16(magnitudes(a), magnitudes(b)), magnitudes(c));
    return vpaddlq_s16(sum) * weight;
}

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    const auto place = [&](auto half) {
        int64x2_t sum = vdupq_n_s64(moved);
        for (int k = 0; k < 3; ++k) sum = vmlal_s32(sum, half(vreinterpretq_s32_u32(vertex[k])), vdup_n_s32(row[k]));
        return vmovn_s64(vshlq_s64(sum, vdupq_n_s64(-fraction_bits)));
    };
    const int32x2_t low = place([](int32x4_t v) { return vget_low_s32(v); });
    const int32x2_t high = place([](int32x4_t v) { return vget_high_s32(v); });
    return vcvtq_f32_s32(vcombine_s32(low, high));
}

#include <runtime/lanes/four_lanes.inl>

/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline AxisInts shift_left_each(const std::byte* word) {
    return (AxisInts{} + static_cast<std::int32_t>(load_u32(word))) << AxisInts{x, y, z, z};
}

#include <runtime/lanes/axes.inl>
#include <runtime/lanes/leaves.inl>

}  // namespace espalier::detail::neon
#endif
