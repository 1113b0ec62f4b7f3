// prepare_ray with all axes at once, in the ordinary case; the rounded ray has the same bits as the definition's in
// lattice_ray.hpp. Included by the x86 instruction sets, inside their namespaces. Relies on round-to-nearest, as that
// does.

/// What spread_ray writes, of all axes at once.
template <class Lanes>
inline void spread_in_lanes(const BlobData& blob, __m128 minus_origin, __m128 inverse, float slack_steps,
                            unsigned signs, Lanes& lanes_) {
    const float whole_slack = slack_steps + Lanes::box_slack(blob);
    const __m128 middle = _mm_mul_ps(minus_origin, inverse);
    const __m128 slack = _mm_mul_ps(_mm_andnot_ps(_mm_set1_ps(-0.0f), inverse), _mm_set1_ps(whole_slack));
    _mm_store_ps(lanes_.inverse, inverse);
    _mm_store_ps(lanes_.base_inverse, _mm_mul_ps(inverse, _mm_set1_ps(blob.base_unit)));
    _mm_store_ps(lanes_.near_offset, _mm_sub_ps(middle, slack));
    _mm_store_ps(lanes_.far_offset, _mm_add_ps(middle, slack));
    lanes_.tau_min = 0.0f;
    lanes_.planes = Lanes::plane_orders()[signs];
}
inline void spread_in_lanes(const BlobData& blob, __m128 minus_origin, __m128 inverse, float slack_steps,
                            unsigned signs, PlacedRayLanes& lanes_) {
    const __m128 placed_inverse = _mm_mul_ps(inverse, _mm_set1_ps(placed::steps_to_one(blob.bits)));
    const __m128 middle = _mm_sub_ps(_mm_mul_ps(minus_origin, inverse), placed_inverse);
    const float whole_slack = slack_steps + placed::slack_units * placed::unit(blob.bits);
    const __m128 slack = _mm_mul_ps(_mm_andnot_ps(_mm_set1_ps(-0.0f), inverse), _mm_set1_ps(whole_slack));
    _mm_store_ps(lanes_.inverse, placed_inverse);
    _mm_store_ps(lanes_.near_offset, _mm_sub_ps(middle, slack));
    _mm_store_ps(lanes_.far_offset, _mm_add_ps(middle, slack));
    lanes_.tau_min = 0.0f;
    lanes_.base_shift = placed::base_shift(blob.bits);
    lanes_.plane_shift = placed::plane_shift(blob.bits);
    lanes_.planes = packed_plane_orders[signs];
}

/// Coordinate 0 of each axis, times the inverse.
inline __m128 asset_low(const RayLanes&) { return _mm_setzero_ps(); }
inline __m128 asset_low(const PlacedRayLanes& lanes_) { return _mm_load_ps(lanes_.inverse); }
/// meets_asset, for a window from 0 on.
template <class Lanes>
[[gnu::always_inline]] inline bool meets_asset_in_lanes(const BlobData& blob, __m128 inverse, const Lanes& lanes_) {
    const __m128 low = asset_low(lanes_);
    const __m128 high = _mm_add_ps(_mm_mul_ps(_mm_load_ps(blob.extent_steps), inverse), low);
    const __m128 enter = _mm_add_ps(_mm_min_ps(low, high), _mm_load_ps(lanes_.near_offset));
    const __m128 leave = _mm_add_ps(_mm_max_ps(low, high), _mm_load_ps(lanes_.far_offset));
    const __m128 last_in = _mm_max_ss(_mm_max_ss(enter, _mm_movehdup_ps(enter)), _mm_movehl_ps(enter, enter));
    const __m128 first_out = _mm_min_ss(_mm_min_ss(leave, _mm_movehdup_ps(leave)), _mm_movehl_ps(leave, leave));
    return _mm_comile_ss(_mm_max_ss(last_in, _mm_setzero_ps()), first_out) != 0;
}

enum class Prepared : std::uint8_t {
    yes,
    misses,        ///< passes the asset's box by
    not_ordinary,  ///< an argument out of the domain, a subnormal direction, an origin from far away
};

/// round_ray, spread_ray and meets_asset. What only leaves need comes last: many rays pass the box by.
template <class Lanes>
[[gnu::always_inline]] inline Prepared prepare_ordinary(const BlobData& blob, const Ray& world, LatticeRay& ray,
                                                        Lanes& lanes_) {
    const __m128i magnitudes = _mm_setr_epi32(0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0);
    const __m128i xyz = _mm_setr_epi32(-1, -1, -1, 0);
    const auto three = [](const float* at) { return _mm_loadu_ps(at); };  // what follows in the structure is masked off
    const auto largest_of = [](__m128i a) {                               // in every element
        const __m128i two = _mm_max_epi32(a, _mm_shuffle_epi32(a, 0x4E));
        return _mm_max_epi32(two, _mm_shuffle_epi32(two, 0xB1));
    };
    // 2^(23 - e) for numbers in [2^e, 2^(e+1)): integers of 24 bits are left.
    const auto to_24_bits = [](__m128i bits) {
        return _mm_sub_epi32(_mm_set1_epi32((23 + 2 * 127) << 23), _mm_and_si128(bits, _mm_set1_epi32(0x7F800000)));
    };

    const __m128 direction = three(&world.direction.x);
    const __m128i lengths = _mm_and_si128(_mm_castps_si128(direction), magnitudes);
    const __m128i longest = largest_of(lengths);
    const __m128 scaled = _mm_mul_ps(direction, _mm_castsi128_ps(to_24_bits(longest)));
    const __m128i integers = _mm_and_si128(_mm_cvtps_epi32(scaled), xyz);
    const __m128 rounded = _mm_cvtepi32_ps(integers);
    const __m128 at_rest = _mm_castsi128_ps(_mm_cmpeq_epi32(integers, _mm_setzero_si128()));
    const __m128 divisor = _mm_or_ps(rounded, _mm_and_ps(at_rest, _mm_set1_ps(1.0f / still)));  // see or_if_zero
    const __m128 inverse = _mm_div_ps(_mm_set1_ps(1.0f), divisor);

    const __m128 corner = _mm_load_ps(blob.origin);
    const __m128 eye = three(&world.origin.x);
    const __m128i normal =
        _mm_cmpgt_epi32(_mm_and_si128(_mm_castps_si128(eye), magnitudes), _mm_set1_epi32(0x007FFFFF));
    const __m128 origin =
        _mm_mul_ps(_mm_sub_ps(_mm_and_ps(eye, _mm_castsi128_ps(normal)), corner), _mm_set1_ps(blob.steps_per_unit));
    const __m128 extent = _mm_load_ps(blob.extent_steps);
    const __m128i reaches = _mm_max_epi32(_mm_and_si128(_mm_castps_si128(origin), magnitudes),
                                          _mm_and_si128(_mm_castps_si128(_mm_sub_ps(extent, origin)), magnitudes));
    const __m128i reach = largest_of(reaches);
    const __m128i fraction_scale = _mm_min_epi32(to_24_bits(reach), _mm_set1_epi32((6 + 127) << 23));
    const __m128i fine = _mm_cvtps_epi32(_mm_mul_ps(origin, _mm_castsi128_ps(fraction_scale)));

    const int exponent = (_mm_cvtsi128_si32(longest) >> 23) - 127;
    const int fraction_bits = (_mm_cvtsi128_si32(fraction_scale) >> 23) - 127;
    const std::uint32_t t_min = std::bit_cast<std::uint32_t>(world.t_min);
    const std::uint32_t t_max = std::bit_cast<std::uint32_t>(world.t_max);
    if (exponent < -100 || exponent > 127 || fraction_bits <= 0 || t_min != 0 || t_max > infinity_bits)
        return Prepared::not_ordinary;

    // A finite t_max is scaled in its exponent, while that stays in the middle of its range.
    const int t_exponent = blob.step_exponent - exponent + 23;
    ray.tau_min = 0.0f;
    ray.tau_max = world.t_max;
    if (t_max != infinity_bits) {
        const int biased = static_cast<int>(t_max >> 23) - t_exponent;
        if (t_max < 0x00800000u || biased < 64 || biased > 250) return Prepared::not_ordinary;
        ray.tau_max = std::bit_cast<float>((static_cast<std::uint32_t>(biased) << 23) | (t_max & 0x007FFFFFu));
    }

    const float reach_steps = _mm_cvtss_f32(_mm_castsi128_ps(reach));
    const __m128 one_unit = _mm_castsi128_ps(_mm_sub_epi32(_mm_set1_epi32(2 * 127 << 23), fraction_scale));
    const __m128 minus_origin = _mm_xor_ps(_mm_mul_ps(_mm_cvtepi32_ps(fine), one_unit), _mm_set1_ps(-0.0f));
    const auto signs = static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(integers)));
    spread_in_lanes(blob, minus_origin, inverse, slab_slack(reach_steps), signs, lanes_);
    if (!meets_asset_in_lanes(blob, inverse, lanes_)) return Prepared::misses;

    _mm_storeu_ps(ray.zero, minus_origin);  // less aligned on i686
    ray.tau_offset = 0.0f;
    // Each fills its register together with the number behind it.
    _mm_store_si128(reinterpret_cast<__m128i*>(ray.direction), _mm_insert_epi32(integers, t_exponent, 3));
    _mm_store_si128(reinterpret_cast<__m128i*>(ray.origin), _mm_insert_epi32(fine, fraction_bits, 3));
    // Where rounding makes two components equally long this may choose the other one, which only changes the filter.
    const __m128 longest_axes = _mm_castsi128_ps(_mm_cmpeq_epi32(lengths, longest));
    const auto axis = static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(_mm_movemask_ps(longest_axes))));
    set_longest_axis(ray, axis);
    alignas(16) float steps[4];
    _mm_store_ps(steps, inverse);
    set_shear(ray, steps[axis], reach_steps);
    ray.faces = world.faces;
    return Prepared::yes;
}

template <class Lanes>
[[gnu::noinline]] bool prepare(const BlobData& blob, const Ray& world, PreparedRayIn<Lanes>& prepared) {
    const Prepared result = prepare_ordinary(blob, world, prepared.ray, prepared.in_lanes);
    return result == Prepared::not_ordinary ? prepare_ray(blob, world, prepared) : result == Prepared::yes;
}
template <class Lanes>
[[gnu::noinline]] bool prepare(const BlobData& blob, const RayOnLattice& given, PreparedRayIn<Lanes>& prepared) {
    return prepare_ray(blob, given, prepared);
}
