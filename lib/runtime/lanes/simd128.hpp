// The vocabulary of the lanes for WebAssembly's SIMD128: four lanes.
#pragma once

#include <runtime/lanes/select.hpp>
#if ESPALIER_SIMD128
#include <wasm_simd128.h>

#include <runtime/lanes/vocabulary.hpp>

namespace espalier::detail::simd128 {

inline constexpr unsigned lanes = 4;
using Floats = Vector<float, lanes>;
using Ints = Vector<std::uint32_t, lanes>;
using SignedInts = Vector<std::int32_t, lanes>;
using Compared = SignedInts;

inline unsigned bits_of(SignedInts comparison) { return wasm_i32x4_bitmask(comparison); }
ESPALIER_ALWAYS_INLINE inline Ints load_bytes(const std::byte* at) {
    return Ints(wasm_u32x4_extend_low_u16x8(wasm_u16x8_extend_low_u8x16(wasm_v128_load32_zero(at))));
}
inline Ints load_words(const std::byte* at) { return Ints(wasm_u32x4_load16x4(at)); }
/// Each byte by its number; 0 for those behind the last.
inline Ints shuffle_bytes(const std::byte* bytes, const std::uint8_t* numbers) {
    return Ints(wasm_i8x16_swizzle(wasm_v128_load(bytes), wasm_v128_load(numbers)));
}
/// Converts numbers below 2^31.
inline Floats to_floats(Ints a) {
    ESPALIER_AS_IF_CHANGED(a, "r");  // else Clang converts what was widened from 16 bits one by one
    return wasm_f32x4_convert_i32x4(a);
}

#include <runtime/lanes/arithmetic.inl>

inline AxisInts round_to_integers(Axes a) { return AxisInts(wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_nearest(a))); }

inline Floats square_roots(Floats a) { return wasm_f32x4_sqrt(a); }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return a * b - c; }
inline Ints pair_of(Floats x, Floats y) {
    return Ints(wasm_i16x8_shuffle(x, __builtin_bit_cast(Ints, y) << 16, 0, 9, 2, 11, 4, 13, 6, 15));
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const v128_t swapped = wasm_i16x8_shuffle(q, q, 1, 0, 3, 2, 5, 4, 7, 6);
    const v128_t second = wasm_i32x4_const_splat(static_cast<int>(0xFFFF0000u));
    return SignedInts(wasm_i32x4_dot_i16x8(p, wasm_i16x8_sub(wasm_v128_xor(swapped, second), second)));
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const v128_t two = wasm_i16x8_add_sat(wasm_i16x8_abs(a), wasm_i16x8_abs(b));
    return SignedInts(wasm_i32x4_dot_i16x8(wasm_i16x8_add_sat(two, wasm_i16x8_abs(c)),
                                           wasm_i16x8_splat(static_cast<std::int16_t>(weight))));
}

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    v128_t low = wasm_i64x2_splat(moved), high = low;
    for (int k = 0; k < 3; ++k) {
        const v128_t factor = wasm_i32x4_splat(row[k]);
        low = wasm_i64x2_add(low, wasm_i64x2_extmul_low_i32x4(vertex[k], factor));
        high = wasm_i64x2_add(high, wasm_i64x2_extmul_high_i32x4(vertex[k], factor));
    }
    const auto bits = static_cast<std::uint32_t>(fraction_bits);
    return to_floats(Ints(wasm_i32x4_shuffle(wasm_i64x2_shr(low, bits), wasm_i64x2_shr(high, bits), 0, 2, 4, 6)));
}

#include <runtime/lanes/four_lanes.inl>

/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline AxisInts shift_left_each(const std::byte* word) {
    static_assert(x == 23 && z >= 9);
    const v128_t factors = wasm_i32x4_const(1 << (x - 9), 1 << (y - 9), 1 << (z - 9), 0);
    return AxisInts(wasm_i32x4_dot_i16x8(wasm_v128_load32_splat(word), factors)) << 9;
}

#include <runtime/lanes/axes.inl>
#include <runtime/lanes/leaves.inl>

}  // namespace espalier::detail::simd128
#endif
