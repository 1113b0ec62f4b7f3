// prepare_ray with all axes at once, in the ordinary case; the rounded ray has the same bits as the definition's in
// lattice_ray.hpp. Included by the x86 instruction sets, inside their namespaces. Relies on round-to-nearest, as that
// does.

/// False when the case is not ordinary: an argument out of the domain, a subnormal direction, an origin from far away.
inline bool round_ordinary_ray(const BlobData& blob, const Ray& world, LatticeRay& ray, RaySlope& slope) {
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
    if (exponent < -100 || exponent > 127 || fraction_bits <= 0 || t_min != 0 || t_max > infinity_bits) return false;

    // A finite t_max is scaled in its exponent, while that stays in the middle of its range.
    const int t_exponent = blob.step_exponent - exponent + 23;
    ray.tau_min = 0.0f;
    ray.tau_max = world.t_max;
    if (t_max != infinity_bits) {
        const int biased = static_cast<int>(t_max >> 23) - t_exponent;
        if (t_max < 0x00800000u || biased < 64 || biased > 250) return false;
        ray.tau_max = std::bit_cast<float>((static_cast<std::uint32_t>(biased) << 23) | (t_max & 0x007FFFFFu));
    }
    ray.tau_offset = 0.0f;

    // Each fills its register together with the number behind it.
    _mm_store_si128(reinterpret_cast<__m128i*>(ray.direction), _mm_insert_epi32(integers, t_exponent, 3));
    _mm_store_si128(reinterpret_cast<__m128i*>(ray.origin), _mm_insert_epi32(fine, fraction_bits, 3));
    _mm_store_ps(slope.inverse, inverse);
    // Where rounding makes two components equally long this may choose the other one: only the filter sees it.
    const __m128 longest_axes = _mm_castsi128_ps(_mm_cmpeq_epi32(lengths, longest));
    set_longest_axis(ray,
                     static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(_mm_movemask_ps(longest_axes)))));
    set_shear(ray, slope, _mm_cvtss_f32(_mm_castsi128_ps(reach)));
    ray.faces = world.faces;
    return true;
}

/// spread_ray.
inline RayLanes spread_in_lanes(const BlobData& blob, const LatticeRay& ray, const RaySlope& slope) {
    RayLanes result;
    const __m128 inverse = _mm_load_ps(slope.inverse);
    const __m128 away = _mm_xor_ps(_mm_mul_ps(load_origin_steps(ray), inverse), _mm_set1_ps(-0.0f));
    const __m128 slack = _mm_mul_ps(_mm_andnot_ps(_mm_set1_ps(-0.0f), inverse), _mm_set1_ps(slope.slack_steps));
    _mm_store_ps(result.inverse, inverse);
    _mm_store_ps(result.base_inverse, _mm_mul_ps(inverse, _mm_set1_ps(blob.base_unit)));
    _mm_store_ps(result.near_offset, _mm_sub_ps(away, slack));
    _mm_store_ps(result.far_offset, _mm_add_ps(away, slack));
    result.tau_min = ray.tau_min;
    const int signs =
        _mm_movemask_ps(_mm_castsi128_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(ray.direction))));
    result.planes = &plane_orders[static_cast<unsigned>(signs) & 7u];
    return result;
}

/// meets_asset.
inline bool meets_asset_in_lanes(const BlobData& blob, const LatticeRay& ray, const RayLanes& lanes_) {
    const __m128 span = _mm_mul_ps(_mm_load_ps(blob.extent_steps), _mm_load_ps(lanes_.inverse));
    const __m128 enter = _mm_add_ps(_mm_min_ps(span, _mm_setzero_ps()), _mm_load_ps(lanes_.near_offset));
    const __m128 leave = _mm_add_ps(_mm_max_ps(span, _mm_setzero_ps()), _mm_load_ps(lanes_.far_offset));
    const __m128 last_in = _mm_max_ss(_mm_max_ss(enter, _mm_movehdup_ps(enter)), _mm_movehl_ps(enter, enter));
    const __m128 first_out = _mm_min_ss(_mm_min_ss(leave, _mm_movehdup_ps(leave)), _mm_movehl_ps(leave, leave));
    return _mm_comile_ss(_mm_max_ss(last_in, _mm_set_ss(ray.tau_min)), first_out) != 0;
}

[[gnu::noinline]] inline bool prepare(const BlobData& blob, const Ray& world, PreparedRay& prepared) {
    RaySlope slope;
    if (!round_ordinary_ray(blob, world, prepared.ray, slope)) return prepare_ray(blob, world, prepared);
    prepared.in_lanes = spread_in_lanes(blob, prepared.ray, slope);
    return meets_asset_in_lanes(blob, prepared.ray, prepared.in_lanes);
}
[[gnu::noinline]] inline bool prepare(const BlobData& blob, const RayOnLattice& given, PreparedRay& prepared) {
    return prepare_ray(blob, given, prepared);
}
