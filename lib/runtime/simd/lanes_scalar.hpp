// The vocabulary of the lanes, one lane wide: for every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/bytes.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/copies.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/ray_lanes.hpp>

namespace espalier::detail::scalar {

/// What the slab tests of a kind of node need.
template <class Node>
using RayLanesOf = typename RayLanesFor<Node>::Type;

inline constexpr unsigned lanes = 1;
/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = false;
using Floats = float;
using Ints = std::uint32_t;
using SignedInts = std::int32_t;
/// A vertex for each lane, and the three vertices of a triangle in each.
using Numbers = Ints;
struct CornerNumbers {
    Numbers a, b, c;
};

inline Floats splat(float x) { return x; }
inline void store(float* to, Floats a) { *to = a; }
inline Floats add(Floats a, Floats b) { return a + b; }
inline Floats subtract(Floats a, Floats b) { return a - b; }
inline Floats multiply(Floats a, Floats b) { return a * b; }
/// a * b + c and a * b - c: fused or not, as the machine likes.
inline Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return a * b - c; }
inline Floats negate(Floats a) { return -a; }
inline Floats magnitude(Floats a) { return absolute(a); }
/// The same numbers in the form that the slab test compares faster: floats, or their bits as integers. Integers order
/// numbers from 0 on, but not -0, as floats do, and negative ones below them.
inline Floats to_compared(Floats a) { return a; }
inline void store_compared(float* to, Floats a) { store(to, a); }
/// The second when one is not a number.
inline Floats smaller(Floats a, Floats b) { return minimum(a, b); }
inline Floats larger(Floats a, Floats b) { return maximum(a, b); }
inline Floats divide(Floats a, Floats b) { return a / b; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) { return a <= b ? then : otherwise; }
/// One bit a lane: a <= b.
inline unsigned at_most(Floats a, Floats b) { return a <= b ? 1u : 0u; }
inline Floats bytes_to_floats(const std::byte* at) { return static_cast<float>(load_u8(at)); }
inline Ints add(Ints a, std::uint32_t b) { return a + b; }
inline Floats to_floats(Ints a) { return static_cast<float>(a); }
inline Ints load_bytes(const std::byte* at) { return load_u8(at); }
inline Ints load_words(const std::byte* at) { return load_u16(at); }
/// Numbers of 24 bits.
inline Ints with_high_bytes(Ints words, Ints bytes) { return words | bytes << 16; }
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) { return load_field(stream, width, first); }
inline SignedInts splat_integer(std::int32_t x) { return x; }
inline SignedInts add(SignedInts a, SignedInts b) { return a + b; }
template <int bits>
inline SignedInts shift_right(SignedInts a) {
    return a >> bits;
}
inline SignedInts negate(SignedInts a) { return -a; }
inline SignedInts smaller(SignedInts a, SignedInts b) { return a < b ? a : b; }
inline SignedInts larger(SignedInts a, SignedInts b) { return a < b ? b : a; }
inline unsigned at_most(SignedInts a, SignedInts b) { return a <= b ? 1u : 0u; }
/// The low halves of the bits of two floats, as one word.
inline Ints pair_of(Floats x, Floats y) {
    return (std::bit_cast<std::uint32_t>(x) & 0xFFFFu) | std::bit_cast<std::uint32_t>(y) << 16;
}
/// x of p times y of q less y of p times x of q, of pairs of integers: exact within +-32767.
inline SignedInts cross_pairs(Ints p, Ints q) {
    const auto x = [](Ints pair) { return std::int32_t{static_cast<std::int16_t>(pair)}; };
    const auto y = [](Ints pair) { return static_cast<std::int32_t>(pair) >> 16; };
    return x(p) * y(q) - y(p) * x(q);
}
/// The same for all of |a| + |b| + |c|: the sum of both coordinates' times the weight, below 2^15.
inline SignedInts weigh_magnitudes(Ints a, Ints b, Ints c, std::int32_t weight) {
    const auto magnitudes = [](Ints pair) {
        const std::int32_t x = static_cast<std::int16_t>(pair), y = static_cast<std::int32_t>(pair) >> 16;
        return (x < 0 ? -x : x) + (y < 0 ? -y : y);
    };
    const std::int32_t sum = magnitudes(a) + magnitudes(b) + magnitudes(c);
    return (sum < 0xFFFF ? sum : 0xFFFF) * weight;
}
inline Ints load_ints(const std::uint32_t* from) { return *from; }
inline Numbers load_numbers(const std::byte* bytes) { return load_bytes(bytes); }
inline Numbers load_numbers(const std::uint32_t* from) { return load_ints(from); }
inline void store(std::uint32_t* to, Ints a) { *to = a; }
inline void prefetch(const std::byte*) {}

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    return static_cast<float>(
        static_cast<std::int32_t>((std::int64_t{row[0]} * vertex[0] + std::int64_t{row[1]} * vertex[1] +
                                   std::int64_t{row[2]} * vertex[2] + moved) >>
                                  fraction_bits));
}

/// Values by vertex.
template <unsigned groups>
struct Table {
    float value[groups];
    static unsigned groups_of(unsigned vertex_count) { return vertex_count; }
    void set(unsigned group, Floats a) { value[group] = a; }
    [[nodiscard]] Floats look_up(Ints index) const { return value[index]; }
    template <unsigned>
    [[nodiscard]] Floats look_up_among(Ints index) const {
        return value[index];
    }
};
/// Pairs of integers by vertex.
template <unsigned groups>
struct PairTable {
    Ints value[groups];
    static unsigned groups_of(unsigned vertex_count) { return vertex_count; }
    void set(unsigned group, Ints pair) { value[group] = pair; }
    [[nodiscard]] Ints look_up(Ints index) const { return value[index]; }
};
template <unsigned max_vertices, class Function>
constexpr auto with_table_groups(unsigned, Function function) {
    return function(std::integral_constant<unsigned, max_vertices>{});
}

#include <runtime/simd/strip_corners_portable.inl>
#include <runtime/simd/leaf_corners.inl>
#include <runtime/simd/frames_portable.inl>
#include <runtime/simd/slab_frame_portable.inl>

}  // namespace espalier::detail::scalar
