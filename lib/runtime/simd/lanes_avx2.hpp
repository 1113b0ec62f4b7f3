// The vocabulary of the lanes for AVX2: eight lanes.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/codec_indexed.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/ray_lanes.hpp>
#include <runtime/simd/target.hpp>
#include <runtime/simd/unpack_table.hpp>

#define ESPALIER_AVX2 "avx2,fma,bmi,bmi2,lzcnt,popcnt"

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {

inline constexpr unsigned lanes = 8;
struct Floats {
    __m256 v;
};
struct Ints {
    __m256i v;
};

inline Floats splat(float x) { return {_mm256_set1_ps(x)}; }
inline void store(float* to, Floats a) { _mm256_storeu_ps(to, a.v); }
inline Floats add(Floats a, Floats b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return {_mm256_fmsub_ps(a.v, b.v, c.v)}; }
inline Floats negate(Floats a) { return {_mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f))}; }
inline Floats smaller(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline unsigned at_most(Floats a, Floats b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
inline Floats bytes_to_floats(const std::byte* at) {
    return {_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))))};
}
inline Floats to_floats(Ints a) { return {_mm256_cvtepi32_ps(a.v)}; }
inline Ints corner_of(Ints triangles, unsigned corner, unsigned width) {
    return {_mm256_srl_epi32(triangles.v, _mm_cvtsi32_si128(static_cast<int>(corner * width)))};
}
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const std::byte* at = stream + first / 8 * width;
    const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
    const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at + width / 2));
    const UnpackEntry& entry = unpack_table[width];
    const __m256i spread = _mm256_shuffle_epi8(_mm256_set_m128i(high, low),
                                               _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.shuffle)));
    const __m256i shifted =
        _mm256_srlv_epi32(spread, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.shift)));
    return {_mm256_and_si256(shifted, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry.mask)))};
}
inline void prefetch(const std::byte* at) { _mm_prefetch(reinterpret_cast<const char*>(at), _MM_HINT_T0); }

/// Values by vertex, in registers.
template <unsigned groups>
struct Table {
    __m256 group[groups];
    void set(unsigned number, Floats a) { group[number] = a.v; }
    /// By the low bits of each index; bits above those that number the vertices are ignored.
    [[nodiscard]] Floats look_up(Ints index) const {
        const auto pick = [&](unsigned low, unsigned high) {
            return _mm256_blendv_ps(_mm256_permutevar8x32_ps(group[low], index.v),
                                    _mm256_permutevar8x32_ps(group[high], index.v),
                                    _mm256_castsi256_ps(_mm256_slli_epi32(index.v, 28)));
        };
        if constexpr (groups == 1) return {_mm256_permutevar8x32_ps(group[0], index.v)};
        else if constexpr (groups == 2) return {pick(0, 1)};
        else if constexpr (groups == 3)
            return {_mm256_blendv_ps(pick(0, 1), _mm256_permutevar8x32_ps(group[2], index.v),
                                     _mm256_castsi256_ps(_mm256_slli_epi32(index.v, 27)))};
        else return {_mm256_blendv_ps(pick(0, 1), pick(2, 3), _mm256_castsi256_ps(_mm256_slli_epi32(index.v, 27)))};
    }
};
template <class Function>
inline auto with_table_groups(unsigned vertex_count, Function function) {
    if (vertex_count <= 8) return function(std::integral_constant<unsigned, 1>{});
    if (vertex_count <= 16) return function(std::integral_constant<unsigned, 2>{});
    if (vertex_count <= 24) return function(std::integral_constant<unsigned, 3>{});
    return function(std::integral_constant<unsigned, 4>{});
}

/// first_triangle, all descriptors at once.
inline std::uint32_t first_triangle_in_lanes(const IndexedLeaf& leaf) {
    const __m256i descriptors = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(leaf.descriptors()));
    const __m256i counts = _mm256_add_epi32(
        _mm256_and_si256(_mm256_srli_epi32(descriptors, format::indexed_leaf::triangles_shift), _mm256_set1_epi32(15)),
        _mm256_set1_epi32(1));
    const __m256i before =
        _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(leaf.number)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    const __m256i sums = _mm256_sad_epu8(_mm256_and_si256(counts, before), _mm256_setzero_si256());
    const __m128i pair = _mm_add_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
    const __m128i sum = _mm_add_epi32(pair, _mm_unpackhi_epi64(pair, pair));
    return load_u32(leaf.block) + static_cast<std::uint32_t>(_mm_cvtsi128_si32(sum));
}

inline __m128 multiply_add(__m128 a, __m128 b, __m128 c) { return _mm_fmadd_ps(a, b, c); }
/// The three elements of a vector to all lanes each.
inline void spread(__m128 a, Floats* to) {
    to[0] = {_mm256_broadcastss_ps(a)};
    to[1] = {_mm256_broadcastss_ps(_mm_movehdup_ps(a))};
    to[2] = {_mm256_broadcastss_ps(_mm_unpackhi_ps(a, a))};
}
/// A word of the blob, shifted left by each count.
template <int x, int y, int z>
inline __m128i shift_left_each(const std::byte* word) {
    float bits;  // never calculated with; as a float it is loaded and spread by one instruction
    __builtin_memcpy(&bits, word, sizeof bits);
    return _mm_sllv_epi32(_mm_castps_si128(_mm_set1_ps(bits)), _mm_setr_epi32(x, y, z, z));
}

#include <runtime/simd/frames_x86.inl>

}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET
