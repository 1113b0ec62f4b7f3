// The vocabulary of the lanes, one lane wide: for every machine.
#pragma once

#if defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>  // pairs of 16 bits in one instruction
#endif

#include <runtime/lanes/vocabulary.hpp>

namespace espalier::detail::scalar {

inline constexpr unsigned lanes = 1;
using Floats = float;
using Ints = std::uint32_t;
using SignedInts = std::int32_t;
using Compared = Floats;

inline unsigned bits_of(bool comparison) { return comparison ? 1u : 0u; }
inline Floats to_floats(Ints a) { return static_cast<float>(a); }
ESPALIER_ALWAYS_INLINE inline Ints load_bytes(const std::byte* at) { return load_u8(at); }
ESPALIER_ALWAYS_INLINE inline Ints load_words(const std::byte* at) { return load_u16(at); }

#include <runtime/lanes/arithmetic.inl>

/// a * b + c and a * b - c: fused or not, as the machine likes.
inline Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return a * b - c; }
inline Floats square_roots(Floats a) { return square_root(a); }
inline Floats magnitude(Floats a) { return absolute(a); }  // one instruction on more machines
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) { return load_field(stream, width, first); }
/// The low halves of the bits of two floats, as one word.
inline Ints pair_of(Floats x, Floats y) {
    return (std::bit_cast<std::uint32_t>(x) & 0xFFFFu) | std::bit_cast<std::uint32_t>(y) << 16;
}
/// x of p times y of q less y of p times x of q, of pairs of integers: exact within +-32767, else modulo 2^32.
inline SignedInts cross_pairs(Ints p, Ints q) {
#if defined(__ARM_FEATURE_SIMD32)
    return __smusdx(static_cast<std::int32_t>(p), static_cast<std::int32_t>(q));
#else
    const auto x = [](Ints pair) { return std::int32_t{static_cast<std::int16_t>(pair)}; };
    const auto y = [](Ints pair) { return static_cast<std::int32_t>(pair) >> 16; };
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x(p) * y(q)) - static_cast<std::uint32_t>(y(p) * x(q)));
#endif
}
/// Returns the sum of both coordinates of |a| + |b| + |c|, saturated to 16 bits, times a weight below 2^15.
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const auto magnitudes = [](Ints pair) {
        const std::int32_t x = static_cast<std::int16_t>(pair), y = static_cast<std::int32_t>(pair) >> 16;
        // mutant(< -> <= 1, < -> <= 2) equivalent: 0 is its own opposite
        return (x < 0 ? -x : x) + (y < 0 ? -y : y);
    };
    const std::int32_t sum = magnitudes(a) + magnitudes(b) + magnitudes(c);
    // mutant(< -> <=) equivalent: both sides are equal then
    return (sum < 0xFFFF ? sum : 0xFFFF) * weight;
}

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    return static_cast<float>(
        static_cast<std::int32_t>((std::int64_t{row[0]} * vertex[0] + std::int64_t{row[1]} * vertex[1] +
                                   std::int64_t{row[2]} * vertex[2] + moved) >>
                                  fraction_bits));
}

template <unsigned>
inline Floats look_up_in(const Floats* value, Ints index) {
    return value[index];
}
#include <runtime/lanes/tables.inl>
#include <runtime/lanes/strip_corners_portable.inl>
#include <runtime/lanes/leaves.inl>

inline Frame load_frame(const PackedNode& node, const BlobData& blob) {
    Frame frame;
    for (int k = 0; k < 3; ++k) {
        frame.scale[k] = power_of_two(static_cast<int>(node.shift(k)));
        frame.base[k] = static_cast<float>(node.base(k, blob.bits));
    }
    return frame;
}

inline SlabFrame load_slab_frame(const PackedNode& node, const RayLanes& ray) {
    SlabFrame frame;
    for (int k = 0; k < 3; ++k) {
        const float base = static_cast<float>(node.base(k, 0)) * ray.base_inverse[k];
        frame.scale[k] = power_of_two(static_cast<int>(node.shift(k))) * ray.inverse[k];
        frame.near_offset[k] = base + ray.near_offset[k];
        frame.far_offset[k] = base + ray.far_offset[k];
    }
    return frame;
}

}  // namespace espalier::detail::scalar
