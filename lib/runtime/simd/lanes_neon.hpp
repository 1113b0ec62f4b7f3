// The vocabulary of the lanes for AArch64: four lanes.
#pragma once

#include <arm_neon.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/float_bits.hpp>
#include <runtime/copies.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/ray_lanes.hpp>
#include <runtime/simd/unpack_table.hpp>

namespace espalier::detail::neon {

/// What the slab tests of a kind of node need.
template <class Node>
using RayLanesOf = typename RayLanesFor<Node>::Type;

inline constexpr unsigned lanes = 4;
/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = false;
struct Floats {
    float32x4_t v;
};
struct Ints {
    uint32x4_t v;
};
struct SignedInts {
    int32x4_t v;
};

inline Floats splat(float x) { return {vdupq_n_f32(x)}; }
inline void store(float* to, Floats a) { vst1q_f32(to, a.v); }
inline Floats add(Floats a, Floats b) { return {vaddq_f32(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {vsubq_f32(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {vmulq_f32(a.v, b.v)}; }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return {vfmaq_f32(c.v, a.v, b.v)}; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return {vfmaq_f32(vnegq_f32(c.v), a.v, b.v)}; }
inline Floats negate(Floats a) { return {vnegq_f32(a.v)}; }
inline Floats magnitude(Floats a) { return {vabsq_f32(a.v)}; }
inline Floats to_compared(Floats a) { return a; }
inline void store_compared(float* to, Floats a) { store(to, a); }
/// The number when one is not a number.
inline Floats smaller(Floats a, Floats b) { return {vminnmq_f32(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {vmaxnmq_f32(a.v, b.v)}; }
inline Floats divide(Floats a, Floats b) { return {vdivq_f32(a.v, b.v)}; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) {
    return {vbslq_f32(vcleq_f32(a.v, b.v), then.v, otherwise.v)};
}
inline unsigned at_most(Floats a, Floats b) {
    const uint32x4_t bit = {1u, 2u, 4u, 8u};
    return vaddvq_u32(vandq_u32(vcleq_f32(a.v, b.v), bit));
}
inline Ints load_bytes(const std::byte* at) {
    const uint8x8_t bytes = vreinterpret_u8_u32(vdup_n_u32(load_u32(at)));
    return {vmovl_u16(vget_low_u16(vmovl_u8(bytes)))};
}
inline Floats bytes_to_floats(const std::byte* at) { return {vcvtq_f32_u32(load_bytes(at).v)}; }
inline Ints add(Ints a, std::uint32_t b) { return {vaddq_u32(a.v, vdupq_n_u32(b))}; }
inline Floats to_floats(Ints a) { return {vcvtq_f32_u32(a.v)}; }
inline Ints load_words(const std::byte* at) {
    return {vmovl_u16(vreinterpret_u16_u8(vld1_u8(reinterpret_cast<const std::uint8_t*>(at))))};
}
inline Ints with_high_bytes(Ints words, Ints bytes) { return {vsliq_n_u32(words.v, bytes.v, 16)}; }
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const unsigned half = first / 4 % 2;
    const std::byte* at = stream + first / 8 * width + half * (width / 2);
    const UnpackEntry& entry = unpack_table[width];
    const uint8x16_t bytes = vld1q_u8(reinterpret_cast<const std::uint8_t*>(at));
    const uint32x4_t spread = vreinterpretq_u32_u8(vqtbl1q_u8(bytes, vld1q_u8(entry.shuffle + 16 * half)));
    const int32x4_t shift = vreinterpretq_s32_u32(vld1q_u32(entry.shift + 4 * half));
    return {vandq_u32(vshlq_u32(spread, vnegq_s32(shift)), vld1q_u32(entry.mask))};
}
inline SignedInts splat_integer(std::int32_t x) { return {vdupq_n_s32(x)}; }
inline SignedInts add(SignedInts a, SignedInts b) { return {vaddq_s32(a.v, b.v)}; }
template <int bits>
inline SignedInts shift_right(SignedInts a) {
    return {vshrq_n_s32(a.v, bits)};
}
inline SignedInts negate(SignedInts a) { return {vnegq_s32(a.v)}; }
inline SignedInts smaller(SignedInts a, SignedInts b) { return {vminq_s32(a.v, b.v)}; }
inline SignedInts larger(SignedInts a, SignedInts b) { return {vmaxq_s32(a.v, b.v)}; }
inline unsigned at_most(SignedInts a, SignedInts b) {
    const uint32x4_t bit = {1u, 2u, 4u, 8u};
    return vaddvq_u32(vandq_u32(vcleq_s32(a.v, b.v), bit));
}
inline Ints pair_of(Floats x, Floats y) {
    return {vsliq_n_u32(vreinterpretq_u32_f32(x.v), vreinterpretq_u32_f32(y.v), 16)};
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const auto x = [](Ints pair) { return vshrq_n_s32(vshlq_n_s32(vreinterpretq_s32_u32(pair.v), 16), 16); };
    const auto y = [](Ints pair) { return vshrq_n_s32(vreinterpretq_s32_u32(pair.v), 16); };
    return {vmlsq_s32(vmulq_s32(x(p), y(q)), y(p), x(q))};
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const auto magnitudes = [](Ints pair) { return vabsq_s16(vreinterpretq_s16_u32(pair.v)); };
    const int16x8_t sum = vqaddq_s16(vqaddq_s16(magnitudes(a), magnitudes(b)), magnitudes(c));
    return {vmulq_n_s32(vpaddlq_s16(sum), weight)};
}
inline Ints load_ints(const std::uint32_t* from) { return {vld1q_u32(from)}; }
inline void store(std::uint32_t* to, Ints a) { vst1q_u32(to, a.v); }
inline void prefetch(const std::byte* at) { __builtin_prefetch(at); }

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    const auto place = [&](auto half) {
        int64x2_t sum = vdupq_n_s64(moved);
        for (int k = 0; k < 3; ++k) sum = vmlal_s32(sum, half(vreinterpretq_s32_u32(vertex[k].v)), vdup_n_s32(row[k]));
        return vmovn_s64(vshlq_s64(sum, vdupq_n_s64(-fraction_bits)));
    };
    const int32x2_t low = place([](int32x4_t v) { return vget_low_s32(v); });
    const int32x2_t high = place([](int32x4_t v) { return vget_high_s32(v); });
    return {vcvtq_f32_s32(vcombine_s32(low, high))};
}

/// The same bits.
inline Floats as_floats(Ints a) { return {vreinterpretq_f32_u32(a.v)}; }
inline Ints as_ints(Floats a) { return {vreinterpretq_u32_f32(a.v)}; }
inline Floats gather(const float* a, const float* b, const float* c, const float* d) {
    const float32x4_t result = {*a, *b, *c, *d};
    return {result};
}

#include <runtime/simd/table_in_memory.inl>
#include <runtime/simd/strip_corners_portable.inl>
#include <runtime/simd/leaf_corners.inl>
#include <runtime/simd/frames_portable.inl>
#include <runtime/simd/slab_frame_portable.inl>

}  // namespace espalier::detail::neon
