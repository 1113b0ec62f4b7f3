// prepare_ray with all axes at once, in the ordinary case; the rounded ray has the same bits as the definition's in
// lattice_ray.hpp. prepare_ray_x86.inl is the same for x86. Included inside the namespace.

/// x, y and z of a vector in memory; what follows it in its structure is the fourth element.
inline v128_t load_three(const float* at) { return wasm_v128_load(at); }

/// The largest of four integers, in every element.
inline v128_t largest_of(v128_t a) {
    const v128_t two = wasm_i32x4_max(a, wasm_i32x4_shuffle(a, a, 2, 3, 0, 1));
    return wasm_i32x4_max(two, wasm_i32x4_shuffle(two, two, 1, 0, 3, 2));
}

/// 2^(23 - e) for numbers in [2^e, 2^(e+1)): integers of 24 bits are left.
inline v128_t scale_to_24_bits(v128_t numbers) {
    return wasm_i32x4_sub(wasm_i32x4_const_splat((23 + 2 * 127) << 23),
                          wasm_v128_and(numbers, wasm_i32x4_const_splat(0x7F800000)));
}
inline v128_t round_to_integers(v128_t a) { return wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_nearest(a)); }

/// meets_asset, for a window from 0 on.
inline bool meets_asset_in_lanes(const BlobData& blob, v128_t inverse, v128_t near_offset, v128_t far_offset) {
    const v128_t zero = wasm_i32x4_const_splat(0);
    const v128_t span = wasm_f32x4_mul(wasm_v128_load(blob.extent_steps), inverse);
    const v128_t enter = wasm_f32x4_add(wasm_f32x4_pmin(span, zero), near_offset);
    const v128_t leave = wasm_f32x4_add(wasm_f32x4_pmax(span, zero), far_offset);
    // Compared as integers, like the slab test; the fourth elements of both are 0.
    const v128_t last_in = largest_of(wasm_i32x4_max(enter, zero));
    return !wasm_v128_any_true(wasm_i32x4_gt(last_in, wasm_i32x4_shuffle(leave, leave, 0, 1, 2, 2)));
}

enum class Prepared : std::uint8_t {
    yes,
    misses,        ///< passes the asset's box by
    not_ordinary,  ///< an argument out of the domain, a subnormal direction, an origin from far away
};

/// round_ray, spread_ray and meets_asset. What only leaves need comes last: many rays pass the box by.
template <class Lanes>
inline Prepared prepare_ordinary(const BlobData& blob, const Ray& world, LatticeRay& ray, Lanes& lanes_) {
    const v128_t magnitudes = wasm_i32x4_const(0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0);
    const v128_t xyz = wasm_i32x4_const(-1, -1, -1, 0);

    const v128_t direction = load_three(&world.direction.x);
    const v128_t lengths = wasm_v128_and(direction, magnitudes);
    const v128_t longest = largest_of(lengths);
    const v128_t scaled = wasm_f32x4_mul(direction, scale_to_24_bits(longest));
    const v128_t integers = wasm_v128_and(round_to_integers(scaled), xyz);
    const v128_t at_rest = wasm_i32x4_eq(integers, wasm_i32x4_const_splat(0));
    const v128_t divisor =
        wasm_v128_or(wasm_f32x4_convert_i32x4(integers), wasm_v128_and(at_rest, wasm_f32x4_const_splat(1.0f / still)));
    const v128_t inverse = wasm_f32x4_div(wasm_f32x4_const_splat(1.0f), divisor);

    const v128_t eye = load_three(&world.origin.x);
    const v128_t normal = wasm_i32x4_gt(wasm_v128_and(eye, magnitudes), wasm_i32x4_const_splat(0x007FFFFF));
    const v128_t origin = wasm_f32x4_mul(wasm_f32x4_sub(wasm_v128_and(eye, normal), wasm_v128_load(blob.origin)),
                                         wasm_f32x4_splat(blob.steps_per_unit));
    const v128_t to_high = wasm_f32x4_sub(wasm_v128_load(blob.extent_steps), origin);
    const v128_t reach =
        largest_of(wasm_i32x4_max(wasm_v128_and(origin, magnitudes), wasm_v128_and(to_high, magnitudes)));
    const v128_t fraction_scale = wasm_i32x4_min(scale_to_24_bits(reach), wasm_i32x4_const_splat((6 + 127) << 23));
    const v128_t fine = round_to_integers(wasm_f32x4_mul(origin, fraction_scale));

    const int exponent = (wasm_i32x4_extract_lane(longest, 0) >> 23) - 127;
    const int fraction_bits = (wasm_i32x4_extract_lane(fraction_scale, 0) >> 23) - 127;
    const auto t_min = std::bit_cast<std::uint32_t>(world.t_min);
    const auto t_max = std::bit_cast<std::uint32_t>(world.t_max);
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

    const float reach_steps = wasm_f32x4_extract_lane(reach, 0);
    const v128_t one_unit = wasm_i32x4_sub(wasm_i32x4_const_splat(2 * 127 << 23), fraction_scale);
    const v128_t minus_origin = wasm_f32x4_neg(wasm_f32x4_mul(wasm_f32x4_convert_i32x4(fine), one_unit));
    const v128_t middle = wasm_f32x4_mul(minus_origin, inverse);
    const float slack_steps = slab_slack(reach_steps) + Lanes::box_slack(blob);
    const v128_t slack = wasm_f32x4_mul(wasm_f32x4_abs(inverse), wasm_f32x4_splat(slack_steps));
    const v128_t near_offset = wasm_f32x4_sub(middle, slack), far_offset = wasm_f32x4_add(middle, slack);
    if (!meets_asset_in_lanes(blob, inverse, wasm_v128_and(near_offset, xyz), far_offset)) return Prepared::misses;

    wasm_v128_store(lanes_.inverse, inverse);
    wasm_v128_store(lanes_.base_inverse, wasm_f32x4_mul(inverse, wasm_f32x4_splat(blob.base_unit)));
    wasm_v128_store(lanes_.near_offset, near_offset);
    wasm_v128_store(lanes_.far_offset, far_offset);
    lanes_.tau_min = 0.0f;
    lanes_.planes = Lanes::plane_orders()[wasm_i32x4_bitmask(integers)];

    wasm_v128_store(ray.zero, minus_origin);
    ray.tau_offset = 0.0f;
    // Each fills its register together with the number behind it.
    wasm_v128_store(ray.direction, wasm_i32x4_replace_lane(integers, 3, t_exponent));
    wasm_v128_store(ray.origin, wasm_i32x4_replace_lane(fine, 3, fraction_bits));
    // Where rounding makes two components equally long this may choose the other one, which only changes the filter.
    const auto axis = static_cast<unsigned>(std::countr_zero(wasm_i32x4_bitmask(wasm_i32x4_eq(lengths, longest))));
    set_longest_axis(ray, axis);
    set_shear(ray, lanes_.inverse[axis], reach_steps);
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
