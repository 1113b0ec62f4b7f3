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

inline constexpr unsigned lanes = 1;
using Floats = float;
using Ints = std::uint32_t;
/// Vertices of one triangle in each lane.
struct CornerNumbers {
    Ints a, b, c;
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
/// The second when one is not a number.
inline Floats smaller(Floats a, Floats b) { return minimum(a, b); }
inline Floats larger(Floats a, Floats b) { return maximum(a, b); }
inline Floats divide(Floats a, Floats b) { return a / b; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) { return a <= b ? then : otherwise; }
/// One bit a lane: a <= b.
inline unsigned at_most(Floats a, Floats b) { return a <= b ? 1u : 0u; }
inline Floats bytes_to_floats(const std::byte* at) { return static_cast<float>(load_u8(at)); }
inline Floats to_floats(Ints a) { return static_cast<float>(a); }
/// Corner 0, 1 or 2 of triangles; bits above the corner's may stay where look_up ignores them.
inline Ints corner_of(Ints triangles, unsigned corner, unsigned width) {
    return (triangles >> (corner * width)) & ((1u << width) - 1u);
}
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) { return load_field(stream, width, first); }
inline Ints load_ints(const std::uint32_t* from) { return *from; }
inline void prefetch(const std::byte*) {}

/// Values by vertex.
template <unsigned groups>
struct Table {
    float value[groups];
    static unsigned groups_of(unsigned vertex_count) { return vertex_count; }
    void set(unsigned group, Floats a) { value[group] = a; }
    [[nodiscard]] Floats look_up(Ints index) const { return value[index]; }
};
template <unsigned max_vertices, class Function>
inline auto with_table_groups(unsigned, Function function) {
    return function(std::integral_constant<unsigned, max_vertices>{});
}

inline std::uint32_t first_triangle_in_lanes(const IndexedLeaf& leaf) { return first_triangle(leaf); }

#include <runtime/simd/strip_corners_portable.inl>
#include <runtime/simd/leaf_corners.inl>
#include <runtime/simd/frames_portable.inl>

}  // namespace espalier::detail::scalar
