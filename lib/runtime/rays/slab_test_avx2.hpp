// Rays against the boxes of a packed node, AVX2: all children at once, planes as placed coordinates. AVX-512 takes it
// too.
#ifndef ESPALIER_RAYS_SLAB_TEST_AVX2_HPP
#define ESPALIER_RAYS_SLAB_TEST_AVX2_HPP

#include <runtime/lanes/avx2.hpp>
#include <runtime/lanes/set.hpp>

#if ESPALIER_LANES == 8
ESPALIER_BEGIN_SET

/// Stores the inverse direction as placed coordinates need it (see prepare_ray.hpp).
inline Axes set_inverse(const BlobData& blob, Axes of_step, PlacedRayLanes& ray_lanes) {
    const Axes inverse = of_step * placed::steps_to_one(blob.bits);
    store_axes(ray_lanes.inverse, inverse);
    ray_lanes.base_shift = placed::base_shift(blob.bits);
    ray_lanes.plane_shift = placed::plane_shift(blob.bits);
    return inverse;
}

/// A word of the blob in all lanes; as a float it is loaded and spread by one instruction.
inline __m256i splat_word_at(const std::byte* at) {
    float bits;
    ESPALIER_COPY_BYTES(&bits, at, sizeof bits);
    return _mm256_castps_si256(_mm256_set1_ps(bits));
}

/// What all lanes of a slab test have in common. In memory: as constants they would be kept on the stack, each in a
/// register's width.
struct SlabConstants {
    alignas(32) std::uint32_t field_mask[8], base_mask[8], one[8], least_shift[8];
    alignas(32) std::uint8_t on_top[32];  ///< of each lane one byte of eight, of all other bytes none
};
inline constexpr SlabConstants slab_constants = [] {
    SlabConstants constants{};
    for (unsigned lane = 0; lane < lanes; ++lane) {
        constants.field_mask[lane] = 31;
        constants.base_mask[lane] = 0xFFFF;
        constants.one[lane] = placed::one;
        constants.least_shift[lane] = placed::least_shift;
        for (unsigned byte = 0; byte < 4; ++byte)
            constants.on_top[4 * lane + byte] = static_cast<std::uint8_t>(byte == 3 ? lane : 0x80);
    }
    return constants;
}();

template <class Number>
inline __m256i load_lanes(const Number* from) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
}
/// Eight bytes of the blob in all halves of a register, loaded like a word.
inline __m256i splat_bytes_at(const std::byte* at) {
    long long bits;
    ESPALIER_COPY_BYTES(&bits, at, sizeof bits);
    return _mm256_set1_epi64x(bits);
}

/// The children whose slab interval, widened, meets [tau_min, limit], and where each begins (Kay and Kajiya 1986).
/// Floats are compared by their bits, as integers: neither end of the window is negative.
[[maybe_unused]] ESPALIER_ALWAYS_INLINE inline unsigned slab_test(const PackedNode& node,
                                                                  const PlacedRayLanes& ray_lanes, float limit,
                                                                  float* near) {
    const PlacedRayLanes& ray = *as_if_changed(&ray_lanes);
    const SlabConstants& all = *as_if_changed(&slab_constants);
    ESPALIER_AS_IF_CHANGED(limit, "x");  // as if it could change: spread ahead of a loop it would need 32 bytes
    const __m256i shifts = splat_word_at(node.bytes + format::packed_node::shifts_at);
    const __m256i plane_shift = _mm256_set1_epi32(static_cast<int>(ray.plane_shift));
    const __m256i base_shift = _mm256_set1_epi32(static_cast<int>(ray.base_shift));
    __m256i enter = _mm256_castps_si256(_mm256_set1_ps(ray.tau_min));
    __m256i leave = _mm256_castps_si256(_mm256_set1_ps(limit));
    for (int k = 0; k < 3; ++k) {
        const __m256i shift = _mm256_max_epi32(
            _mm256_sub_epi32(plane_shift,
                             _mm256_and_si256(_mm256_srli_epi32(shifts, 5 * k), load_lanes(all.field_mask))),
            load_lanes(all.least_shift));
        const std::byte* const base_at = node.bytes + format::packed_node::base_at + 2 * static_cast<std::size_t>(k);
        const __m256i steps =
            _mm256_sllv_epi32(_mm256_and_si256(splat_word_at(base_at), load_lanes(all.base_mask)), base_shift);
        const __m256i base = _mm256_add_epi32(steps, load_lanes(all.one));
        const __m256 inverse = _mm256_set1_ps(ray.inverse[k]);
        const auto tau = [&](unsigned at, float offset) ESPALIER_ALWAYS_INLINE_LAMBDA {
            const __m256i plane = _mm256_add_epi32(
                _mm256_srlv_epi32(_mm256_shuffle_epi8(splat_bytes_at(node.bytes + at), load_lanes(all.on_top)), shift),
                base);
            return _mm256_castps_si256(_mm256_fmadd_ps(_mm256_castsi256_ps(plane), inverse, _mm256_set1_ps(offset)));
        };
        enter = _mm256_max_epi32(tau(ray.planes.near_at[k], ray.near_offset[k]), enter);
        leave = _mm256_min_epi32(tau(ray.planes.far_at[k], ray.far_offset[k]), leave);
    }
    _mm256_storeu_ps(near, _mm256_castsi256_ps(enter));
    const __m256i is_beyond = _mm256_cmpgt_epi32(enter, leave);
    return ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_beyond))) & all_children(node);
}

ESPALIER_END_SET
#endif

#endif
