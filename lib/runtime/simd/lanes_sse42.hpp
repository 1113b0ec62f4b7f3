// The vocabulary of the lanes for SSE4.2: four lanes.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/codec_fast.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/ray_lanes.hpp>
#include <runtime/simd/target.hpp>
#include <runtime/simd/unpack_table.hpp>

#define ESPALIER_SSE42 "sse4.2,popcnt"

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {

inline constexpr unsigned lanes = 4;
struct Floats {
    __m128 v;
};
struct Ints {
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
inline float largest(Floats a) {
    const __m128 two = _mm_max_ps(a.v, _mm_movehl_ps(a.v, a.v));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
}
inline unsigned at_most(Floats a, Floats b) { return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v))); }
inline Floats bytes_to_floats(const std::byte* at) {
    return {_mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(load_u32(at)))))};
}
inline Floats to_floats(Ints a) { return {_mm_cvtepi32_ps(a.v)}; }
inline Ints corner_of(Ints triangles, unsigned corner, unsigned width) {
    return {_mm_srl_epi32(triangles.v, _mm_cvtsi32_si128(static_cast<int>(corner * width)))};
}
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const unsigned half = first / 4 % 2;
    const std::byte* at = stream + first / 8 * width + half * (width / 2);
    const UnpackEntry& entry = unpack_table[width];
    const __m128i spread = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at)),
                                            _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry.shuffle + 16 * half)));
    // Lanes cannot be shifted right by different counts before AVX2: shift left to a common place by multiplying.
    const __m128i shift = _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry.shift + 4 * half));
    const __m128i power = _mm_slli_epi32(_mm_sub_epi32(_mm_set1_epi32(7 + 127), shift), 23);
    const __m128i raised = _mm_mullo_epi32(spread, _mm_cvttps_epi32(_mm_castsi128_ps(power)));
    return {_mm_and_si128(_mm_srli_epi32(raised, 7), _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry.mask)))};
}
inline void prefetch(const std::byte* at) { _mm_prefetch(reinterpret_cast<const char*>(at), _MM_HINT_T0); }

/// Values by vertex, in memory: there is no permutation over several registers.
template <unsigned groups>
struct Table {
    alignas(16) float value[groups * lanes] = {};
    void set(unsigned number, Floats a) { _mm_store_ps(value + lanes * number, a.v); }
    [[nodiscard]] Floats look_up(Ints index) const {
        const __m128i vertex = _mm_and_si128(index.v, _mm_set1_epi32(groups * lanes - 1));
        const auto at = [&](int lane) { return value[lane]; };
        return {_mm_setr_ps(at(_mm_extract_epi32(vertex, 0)), at(_mm_extract_epi32(vertex, 1)),
                            at(_mm_extract_epi32(vertex, 2)), at(_mm_extract_epi32(vertex, 3)))};
    }
};
/// Exactly as many entries as the numbers of the vertices can name.
template <class Function>
inline auto with_table_groups(unsigned vertex_count, Function function) {
    if (vertex_count <= 8) return function(std::integral_constant<unsigned, 2>{});
    if (vertex_count <= 16) return function(std::integral_constant<unsigned, 4>{});
    return function(std::integral_constant<unsigned, 8>{});
}

/// The shifts of all three axes, each in the place of a float's exponent.
inline __m128i load_shifts(const FastNode& node) {
    // They lie in the low half of this word, 5 bits each.
    const __m128i word = _mm_set1_epi32(static_cast<int>(load_u32(node.bytes + format::fast_node::shifts_at)));
    const __m128i places = _mm_mullo_epi32(word, _mm_setr_epi32(1 << 23, 1 << 18, 1 << 13, 0));
    return _mm_and_si128(places, _mm_set1_epi32(31 << 23));
}
inline __m128 load_scales(const FastNode& node) {
    return _mm_castsi128_ps(_mm_add_epi32(load_shifts(node), _mm_set1_epi32(127 << 23)));
}
inline __m128 load_bases(const FastNode& node) {
    return _mm_cvtepi32_ps(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(node.bytes))));
}

/// The low corner of a child's box, seen from a point.
struct Corner {
    alignas(16) float at[4];
};
inline Corner load_low_corner(const FastNode& node, unsigned child, unsigned bits, const float* origin) {
    const std::uint32_t bytes = load_u8(node.low_planes(0) + child) | load_u8(node.low_planes(1) + child) << 8 |
                                load_u8(node.low_planes(2) + child) << 16;
    const __m128 planes = _mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(bytes))));
    const __m128 unit = _mm_set1_ps(power_of_two(bits > 16 ? static_cast<int>(bits) - 16 : 0));
    Corner corner;
    // Every step of it is exact: the corner is a lattice point, the origin near enough.
    _mm_store_ps(corner.at, _mm_add_ps(_mm_mul_ps(planes, load_scales(node)), _mm_sub_ps(_mm_mul_ps(load_bases(node), unit), _mm_load_ps(origin))));
    return corner;
}

/// A node's frame: plane * scale + base is a lattice coordinate, exactly.
struct Frame {
    Floats scale[3];
    Floats base[3];
};
inline Frame load_frame(const FastNode& node, unsigned bits) {
    const __m128 scale = load_scales(node);
    const __m128 base = _mm_mul_ps(load_bases(node), _mm_set1_ps(power_of_two(bits > 16 ? static_cast<int>(bits) - 16 : 0)));
    Frame frame;
    frame.scale[0] = {_mm_shuffle_ps(scale, scale, 0x00)};
    frame.scale[1] = {_mm_shuffle_ps(scale, scale, 0x55)};
    frame.scale[2] = {_mm_shuffle_ps(scale, scale, 0xAA)};
    frame.base[0] = {_mm_shuffle_ps(base, base, 0x00)};
    frame.base[1] = {_mm_shuffle_ps(base, base, 0x55)};
    frame.base[2] = {_mm_shuffle_ps(base, base, 0xAA)};
    return frame;
}

inline std::uint32_t first_triangle_in_lanes(const FastLeaf& leaf) { return first_triangle(leaf); }

/// The planes of a node as tau along a ray: plane * scale + offset. All three axes in one register, then spread.
struct SlabFrame {
    Floats scale[3];
    Floats near_offset[3];
    Floats far_offset[3];
};
inline SlabFrame load_slab_frame(const FastNode& node, const RayLanes& ray) {
    // Adding a shift to the exponent multiplies by its power of two.
    const __m128 scale = _mm_castsi128_ps(
        _mm_add_epi32(load_shifts(node), _mm_load_si128(reinterpret_cast<const __m128i*>(ray.inverse))));
    const __m128 slope = _mm_load_ps(ray.base_inverse);
    const __m128 bases = load_bases(node);
    const __m128 base = _mm_mul_ps(bases, slope);
    const __m128 near_offset = _mm_add_ps(base, _mm_load_ps(ray.near_offset));
    const __m128 far_offset = _mm_add_ps(base, _mm_load_ps(ray.far_offset));
    SlabFrame frame;
    frame.scale[0] = {_mm_shuffle_ps(scale, scale, 0x00)};
    frame.scale[1] = {_mm_shuffle_ps(scale, scale, 0x55)};
    frame.scale[2] = {_mm_shuffle_ps(scale, scale, 0xAA)};
    frame.near_offset[0] = {_mm_shuffle_ps(near_offset, near_offset, 0x00)};
    frame.near_offset[1] = {_mm_shuffle_ps(near_offset, near_offset, 0x55)};
    frame.near_offset[2] = {_mm_shuffle_ps(near_offset, near_offset, 0xAA)};
    frame.far_offset[0] = {_mm_shuffle_ps(far_offset, far_offset, 0x00)};
    frame.far_offset[1] = {_mm_shuffle_ps(far_offset, far_offset, 0x55)};
    frame.far_offset[2] = {_mm_shuffle_ps(far_offset, far_offset, 0xAA)};
    return frame;
}

}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
