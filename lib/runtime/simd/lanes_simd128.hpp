// The vocabulary of the lanes for WebAssembly's SIMD128: four lanes.
#pragma once

#include <wasm_simd128.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/float_bits.hpp>
#include <runtime/copies.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/ray_lanes.hpp>
#include <runtime/simd/unpack_table.hpp>

namespace espalier::detail::simd128 {

/// What the slab tests of a kind of node need.
template <class Node>
using RayLanesOf = typename RayLanesFor<Node>::Type;

inline constexpr unsigned lanes = 4;
/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = false;
struct Floats {
    v128_t v;
};
struct Ints {
    v128_t v;
};
struct SignedInts {
    v128_t v;
};

inline Floats splat(float x) { return {wasm_f32x4_splat(x)}; }
inline void store(float* to, Floats a) { wasm_v128_store(to, a.v); }
inline Floats add(Floats a, Floats b) { return {wasm_f32x4_add(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {wasm_f32x4_sub(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {wasm_f32x4_mul(a.v, b.v)}; }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return add(multiply(a, b), c); }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return subtract(multiply(a, b), c); }
inline Floats negate(Floats a) { return {wasm_f32x4_neg(a.v)}; }
inline Floats magnitude(Floats a) { return {wasm_f32x4_abs(a.v)}; }
/// The second when one is not a number. The pseudo-minimum and maximum are one instruction on every machine.
inline Floats smaller(Floats a, Floats b) { return {wasm_f32x4_pmin(b.v, a.v)}; }
inline Floats larger(Floats a, Floats b) { return {wasm_f32x4_pmax(b.v, a.v)}; }
inline Floats divide(Floats a, Floats b) { return {wasm_f32x4_div(a.v, b.v)}; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) {
    return {wasm_v128_bitselect(then.v, otherwise.v, wasm_f32x4_le(a.v, b.v))};
}
inline unsigned at_most(Floats a, Floats b) { return wasm_i32x4_bitmask(wasm_f32x4_le(a.v, b.v)); }
inline Ints load_bytes(const std::byte* at) {
    return {wasm_u32x4_extend_low_u16x8(wasm_u16x8_extend_low_u8x16(wasm_v128_load32_zero(at)))};
}
inline Ints load_words(const std::byte* at) { return {wasm_u32x4_load16x4(at)}; }
inline Ints with_high_bytes(Ints words, Ints bytes) { return {wasm_v128_or(words.v, wasm_i32x4_shl(bytes.v, 16))}; }
inline Ints add(Ints a, std::uint32_t b) { return {wasm_i32x4_add(a.v, wasm_u32x4_splat(b))}; }
inline Floats to_floats(Ints a) {
    asm("" : "+r"(a.v));  // else Clang converts what was widened from 16 bits one by one
    return {wasm_f32x4_convert_i32x4(a.v)};
}
inline Floats bytes_to_floats(const std::byte* at) { return to_floats(load_bytes(at)); }
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const unsigned half = first / 4 % 2;
    const std::byte* at = stream + first / 8 * width + half * (width / 2);
    const UnpackEntry& entry = unpack_table[width];
    const v128_t spread = wasm_i8x16_swizzle(wasm_v128_load(at), wasm_v128_load(entry.shuffle + 16 * half));
    // Lanes cannot be shifted by different counts: each is moved to a common place by multiplying.
    const v128_t raised = wasm_i32x4_mul(spread, wasm_v128_load(unpack_raise_table[width].data() + 4 * half));
    return {wasm_v128_and(wasm_u32x4_shr(raised, unpack_raised_bits), wasm_v128_load(entry.mask))};
}
inline SignedInts to_compared(Floats a) { return {a.v}; }
inline void store_compared(float* to, SignedInts a) { wasm_v128_store(to, a.v); }
inline SignedInts splat_integer(std::int32_t x) { return {wasm_i32x4_splat(x)}; }
inline SignedInts add(SignedInts a, SignedInts b) { return {wasm_i32x4_add(a.v, b.v)}; }
template <int bits>
inline SignedInts shift_right(SignedInts a) {
    return {wasm_i32x4_shr(a.v, bits)};
}
inline SignedInts negate(SignedInts a) { return {wasm_i32x4_neg(a.v)}; }
inline SignedInts smaller(SignedInts a, SignedInts b) { return {wasm_i32x4_min(a.v, b.v)}; }
inline SignedInts larger(SignedInts a, SignedInts b) { return {wasm_i32x4_max(a.v, b.v)}; }
inline unsigned at_most(SignedInts a, SignedInts b) { return 15u ^ wasm_i32x4_bitmask(wasm_i32x4_gt(a.v, b.v)); }
inline Ints pair_of(Floats x, Floats y) {
    return {wasm_i16x8_shuffle(x.v, wasm_i32x4_shl(y.v, 16), 0, 9, 2, 11, 4, 13, 6, 15)};
}
inline SignedInts cross_pairs(Ints p, Ints q) {
    const v128_t swapped = wasm_i16x8_shuffle(q.v, q.v, 1, 0, 3, 2, 5, 4, 7, 6);
    const v128_t second = wasm_i32x4_const_splat(static_cast<int>(0xFFFF0000u));
    return {wasm_i32x4_dot_i16x8(p.v, wasm_i16x8_sub(wasm_v128_xor(swapped, second), second))};
}
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const v128_t two = wasm_i16x8_add_sat(wasm_i16x8_abs(a.v), wasm_i16x8_abs(b.v));
    return {wasm_i32x4_dot_i16x8(wasm_i16x8_add_sat(two, wasm_i16x8_abs(c.v)),
                                 wasm_i16x8_splat(static_cast<std::int16_t>(weight)))};
}
inline Ints load_ints(const std::uint32_t* from) { return {wasm_v128_load(from)}; }
inline void store(std::uint32_t* to, Ints a) { wasm_v128_store(to, a.v); }
inline void prefetch(const std::byte*) {}

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    v128_t low = wasm_i64x2_splat(moved), high = low;
    for (int k = 0; k < 3; ++k) {
        const v128_t factor = wasm_i32x4_splat(row[k]);
        low = wasm_i64x2_add(low, wasm_i64x2_extmul_low_i32x4(vertex[k].v, factor));
        high = wasm_i64x2_add(high, wasm_i64x2_extmul_high_i32x4(vertex[k].v, factor));
    }
    const auto bits = static_cast<std::uint32_t>(fraction_bits);
    return {wasm_f32x4_convert_i32x4(
        wasm_i32x4_shuffle(wasm_i64x2_shr(low, bits), wasm_i64x2_shr(high, bits), 0, 2, 4, 6))};
}

/// The same bits.
inline Floats as_floats(Ints a) { return {a.v}; }
inline Ints as_ints(Floats a) { return {a.v}; }
inline Floats gather(const float* a, const float* b, const float* c, const float* d) {
    const v128_t two = wasm_v128_load32_lane(b, wasm_v128_load32_zero(a), 1);
    return {wasm_v128_load32_lane(d, wasm_v128_load32_lane(c, two, 2), 3)};
}

#include <runtime/simd/table_in_memory.inl>
#include <runtime/simd/strip_corners_portable.inl>
#include <runtime/simd/leaf_corners.inl>
#include <runtime/simd/frames_portable.inl>

/// The planes of a node as tau along a ray: plane * scale + offset.
struct SlabFrame {
    Floats scale[3];
    Floats near_offset[3];
    Floats far_offset[3];
};
/// The three elements of a vector to all lanes each.
inline void spread(v128_t a, Floats* to) {
    to[0] = {wasm_i32x4_shuffle(a, a, 0, 0, 0, 0)};
    to[1] = {wasm_i32x4_shuffle(a, a, 1, 1, 1, 1)};
    to[2] = {wasm_i32x4_shuffle(a, a, 2, 2, 2, 2)};
}
/// All axes at once, then spread.
inline SlabFrame load_slab_frame(const PackedNode& node, const RayLanes& ray) {
    // The shifts lie in the low half of a word, 5 bits each. Products move them to a float's exponent, where adding
    // one multiplies by its power of two.
    const v128_t word = wasm_v128_load32_splat(node.bytes + format::packed_node::shifts_at);
    const v128_t raised = wasm_i32x4_shl(wasm_i32x4_dot_i16x8(word, wasm_i32x4_const(1 << 14, 1 << 9, 1 << 4, 0)), 9);
    const v128_t shifts = wasm_v128_and(raised, wasm_i32x4_const_splat(31 << 23));
    const v128_t bases = to_floats(load_words(node.bytes + format::packed_node::base_at)).v;
    const v128_t steps = wasm_f32x4_mul(bases, wasm_v128_load(ray.base_inverse));
    SlabFrame frame;
    spread(wasm_i32x4_add(shifts, wasm_v128_load(ray.inverse)), frame.scale);
    spread(wasm_f32x4_add(steps, wasm_v128_load(ray.near_offset)), frame.near_offset);
    spread(wasm_f32x4_add(steps, wasm_v128_load(ray.far_offset)), frame.far_offset);
    return frame;
}

}  // namespace espalier::detail::simd128
